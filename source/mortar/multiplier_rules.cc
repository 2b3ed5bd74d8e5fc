#include <mortise/mortar/multiplier_rules.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Rules for the modes of one face and component.
    class FaceRules
    {
    public:
      FaceRules(const MultiplierFace &face,
                const unsigned int    c,
                MultiplierRecords    &records)
        : face(face)
        , basis(*face.basis)
        , rim(face.rim[c])
        , constrained(face.constrained_vertex[c])
        , dofs(face.dofs[c])
        , records(records)
        , n_rims(std::count(rim, rim + basis.n_edges(), true))
      {}

      void
      apply(const bool has_free_displacement)
      {
        for (unsigned int k = 0; k < basis.size(); ++k)
          {
            const TraceBasis::Function &f      = basis.functions[k];
            MultiplierRecord           &record = records[dofs[k]];
            record.on_full_face |= face.cover == FaceCoverage::full;
            record.has_free_displacement |= has_free_displacement;
            if (f.dimension == 0)
              vertex(f.entity, record);
            else if (f.dimension == 1)
              edge(k, record);
            else if (!is_inside_kept(f))
              record.kept = false;
          }
      }

    private:
      bool
      is_triangle() const
      {
        return basis.shape == FaceShape::triangle;
      }

      /// Quadrilaterals: rims at the two ends of direction @p a.
      unsigned int
      rims_across(const unsigned int a) const
      {
        return rim[2 * (1 - a)] + rim[2 * (1 - a) + 1];
      }

      /// Highest mode of edge @p e, reduced; -1 and less: nothing at all.
      int
      reduced_degree(const unsigned int e) const
      {
        const auto         ends = basis.edge_vertices(e);
        const unsigned int less =
          !is_triangle() ? rims_across(e / 2) :
          rim[e]         ? n_rims :
                           constrained[ends[0]] + constrained[ends[1]];
        return static_cast<int>(face.edge_degree[e]) - static_cast<int>(less);
      }

      bool
      is_inside_kept(const TraceBasis::Function &f) const
      {
        if (is_triangle())
          return f.degree + n_rims <= face.face_degree;
        return f.modes[0] + rims_across(0) <= face.face_degree &&
               f.modes[1] + rims_across(1) <= face.face_degree;
      }

      types::global_dof_index
      vertex_dof(const unsigned int v) const
      {
        return dofs[basis.vertex_function(v)];
      }

      void
      edge(const unsigned int k, MultiplierRecord &record)
      {
        const TraceBasis::Function &f = basis.functions[k];
        if (static_cast<int>(f.degree) > reduced_degree(f.entity))
          record.kept = false;
        // two rims and nothing but a constant between them: both edges carry
        // one function
        if (is_triangle())
          return;
        const unsigned int a = f.entity / 2, b = 1 - a, side = f.entity % 2;
        if (rims_across(b) == 2 && reduced_degree(2 * b) == 0 &&
            reduced_degree(2 * b + 1) == 0)
          for (unsigned int l = 0; l < basis.size(); ++l)
            if (basis.functions[l].dimension == 1 &&
                basis.functions[l].entity == 2 * a + 1 - side &&
                basis.functions[l].degree == f.degree)
              record.merged.insert(dofs[l]);
      }

      void
      vertex(const unsigned int v, MultiplierRecord &record)
      {
        record.vertex = true;
        record.constrained |= constrained[v];
        for (unsigned int e = 0; e < basis.n_edges(); ++e)
          {
            const auto ends = basis.edge_vertices(e);
            if (ends[0] != v && ends[1] != v)
              continue;
            const unsigned int other = ends[0] == v ? ends[1] : ends[0];
            if (is_triangle() ? constrained[v] && !rim[e] : is_rim_across(v, e))
              across_rim(e, other, record);
          }
        if (is_triangle() && constrained[v])
          {
            record.on_rim = true;
            if (is_between_rims(v))
              corner(v, record);
          }
        for (unsigned int w = 0; w < basis.n_vertices(); ++w)
          if (w != v && !constrained[w])
            record.diagonal.insert(vertex_dof(w));
      }

      /// Quadrilaterals: whether the edge that meets @p e in @p v is a rim.
      bool
      is_rim_across(const unsigned int v, const unsigned int e) const
      {
        const unsigned int a = e / 2;
        return rim[2 * (1 - a) + (a == 0 ? v % 2 : v / 2)];
      }

      /// The vertex is on a rim, edge @p e leads away from it.
      void
      across_rim(const unsigned int e,
                 const unsigned int other,
                 MultiplierRecord  &record)
      {
        record.on_rim   = true;
        const int  left = reduced_degree(e);
        const bool both_ends =
          is_triangle() ? constrained[other] : rims_across(e / 2) == 2;
        if (left >= 1)
          record.across_kept = true;
        else if (left == 0 && both_ends)
          record.merged.insert(vertex_dof(other));
        else if (left == 0 && !constrained[other])
          record.neighbours.insert(vertex_dof(other));
      }

      bool
      is_between_rims(const unsigned int v) const
      {
        for (unsigned int e = 0; e < basis.n_edges(); ++e)
          {
            const auto ends = basis.edge_vertices(e);
            if ((ends[0] == v || ends[1] == v) && !rim[e])
              return false;
          }
        return true;
      }

      /// A triangle's vertex between two rims. Functions of degree p - r have
      /// a vertex function where this is 1 or more; a constant belongs to the
      /// whole triangle if all its edges are rims.
      void
      corner(const unsigned int v, MultiplierRecord &record)
      {
        const int left =
          static_cast<int>(face.face_degree) - static_cast<int>(n_rims);
        if (left >= 1)
          record.across_kept = true;
        else
          for (unsigned int w = 0; w < 3; ++w)
            if (w != v)
              (left == 0 && n_rims == 3 ? record.merged : record.beside)
                .insert(vertex_dof(w));
      }

      const MultiplierFace                       &face;
      const TraceBasis                           &basis;
      const bool                                 *rim, *constrained;
      const std::vector<types::global_dof_index> &dofs;
      MultiplierRecords                          &records;
      const unsigned int                          n_rims;
    };
  } // namespace

  void
  compensate_constrained_vertices(const MultiplierFace &face,
                                  const unsigned int    c,
                                  MultiplierRecords    &records)
  {
    const TraceBasis &basis   = *face.basis;
    const auto       &dofs    = face.dofs[c];
    const auto        is_last = [&](const TraceBasis::Function &f) {
      return f.dimension == 2 && f.modes[0] == face.face_degree &&
             f.modes[1] == face.face_degree;
    };
    for (unsigned int v = 0; v < basis.n_vertices(); ++v)
      {
        MultiplierRecord &vertex = records[dofs[basis.vertex_function(v)]];
        if (!vertex.has_no_rim())
          continue;
        vertex.compensated |= face.face_degree > 1;
        for (unsigned int k = 0; k < basis.size(); ++k)
          if (is_last(basis.functions[k]))
            records[dofs[k]].kept = false;
        for (unsigned int e = 0; e < basis.n_edges(); ++e)
          if (const auto ends = basis.edge_vertices(e);
              ends[0] == v || ends[1] == v)
            if (const auto other = ends[0] == v ? ends[1] : ends[0];
                !face.constrained_vertex[c][other])
              vertex.neighbours.insert(dofs[basis.vertex_function(other)]);
      }
  }

  void
  apply_multiplier_rules(const MultiplierFace &face,
                         const unsigned int    c,
                         MultiplierRecords    &records)
  {
    FaceRules(face, c, records).apply(face.has_free_displacement[c]);
  }

  namespace
  {
    using Index = types::global_dof_index;

    /// By dof that none of @p nodes_and_components has, and that edge @p e of @p face hangs
    /// on: the degree of its mode. A mode of part of an edge follows those of
    /// the whole edge that have its degree or a higher one.
    std::map<Index, unsigned int>
    modes_of_larger_edge(const MultiplierFace            &face,
                         const unsigned int               c,
                         const unsigned int               e,
                         const AffineConstraints<double> &conformity,
                         const NodesAndComponents        &nodes_and_components)
    {
      std::map<Index, unsigned int> degrees;
      for (unsigned int k = 0; k < face.basis->size(); ++k)
        if (const auto &f = face.basis->functions[k];
            f.dimension == 1 && f.entity == e &&
            conformity.is_constrained(face.dofs[c][k]))
          for (const auto &entry :
               *conformity.get_constraint_entries(face.dofs[c][k]))
            if (nodes_and_components.count(entry.first) == 0)
              {
                unsigned int &degree = degrees[entry.first];
                degree               = std::max(degree, f.degree);
              }
      return degrees;
    }

    /// The ends of edge @p e of @p face, by their dofs, where another edge is a
    /// rim.
    MultiplierRecord::Dofs
    ends_on_rims(const MultiplierFace &face,
                 const unsigned int    c,
                 const unsigned int    e)
    {
      MultiplierRecord::Dofs result;
      for (unsigned int other = 0; other < face.basis->n_edges(); ++other)
        if (other != e && face.rim[c][other])
          for (const unsigned int v : face.basis->edge_vertices(e))
            if (const auto ends = face.basis->edge_vertices(other);
                ends[0] == v || ends[1] == v)
              result.insert(face.dofs[c][face.basis->vertex_function(v)]);
      return result;
    }
  } // namespace

  void
  add_edges_of_larger_cells(const std::vector<MultiplierFace> &faces,
                            const unsigned int                 n_directions,
                            const bool                         one_sided,
                            const AffineConstraints<double>   &conformity,
                            NodesAndComponents &nodes_and_components,
                            MultiplierRecords  &records)
  {
    struct Mode
    {
      unsigned int           degree, of_edge;
      MultiplierRecord::Dofs rims; ///< at both ends of the edge
    };
    std::map<Index, Mode> modes;
    NodesAndComponents    found;
    for (const MultiplierFace &face : faces)
      for (unsigned int e = 0; e < face.basis->n_edges(); ++e)
        {
          std::map<unsigned int, Index> of_first; // by degree
          for (unsigned int c = 0; c < n_directions; ++c)
            {
              const auto degrees = modes_of_larger_edge(
                face, c, e, conformity, nodes_and_components);
              const auto   rims    = ends_on_rims(face, c, e);
              unsigned int highest = 0;
              for (const auto &[dof, degree] : degrees)
                highest = std::max(highest, degree);
              for (const auto &[dof, degree] : degrees)
                {
                  if (c == 0)
                    of_first[degree] = dof;
                  found.emplace(dof, std::make_pair(of_first.at(degree), c));
                  Mode &mode   = modes[dof];
                  mode.degree  = degree;
                  mode.of_edge = highest;
                  mode.rims.insert(rims.begin(), rims.end());
                  MultiplierRecord &record = records[dof];
                  record.on_full_face |= face.cover == FaceCoverage::full;
                  record.has_free_displacement |= face.has_free_displacement[c];
                }
            }
        }
    for (const auto &[dof, mode] : modes)
      records[dof].kept =
        !one_sided && mode.degree + mode.rims.size() <= mode.of_edge;
    nodes_and_components.insert(found.begin(), found.end());
  }
} // namespace mortise
