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
        , blocked(face.blocked_vertex[c])
        , dofs(face.dofs[c])
        , records(records)
        , n_rims(std::count(rim, rim + basis.n_edges(), true))
      {}

      void
      apply(const bool can_follow)
      {
        for (unsigned int k = 0; k < basis.size(); ++k)
          {
            const TraceBasis::Function &f      = basis.functions[k];
            MultiplierRecord           &record = records[dofs[k]];
            record.on_full_face |= face.cover == Cover::full;
            record.can_follow |= can_follow;
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
        const unsigned int less = !is_triangle() ? rims_across(e / 2) :
                                  rim[e]         ? n_rims :
                                           blocked[ends[0]] + blocked[ends[1]];
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
        record.blocked |= blocked[v];
        for (unsigned int e = 0; e < basis.n_edges(); ++e)
          {
            const auto ends = basis.edge_vertices(e);
            if (ends[0] != v && ends[1] != v)
              continue;
            const unsigned int other = ends[0] == v ? ends[1] : ends[0];
            if (is_triangle() ? blocked[v] && !rim[e] : is_rim_across(v, e))
              across_rim(e, other, record);
          }
        if (is_triangle() && blocked[v])
          {
            record.on_rim = true;
            if (is_between_rims(v))
              corner(v, record);
          }
        for (unsigned int w = 0; w < basis.n_vertices(); ++w)
          if (w != v && !blocked[w])
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
          is_triangle() ? blocked[other] : rims_across(e / 2) == 2;
        if (left >= 1)
          record.across_kept = true;
        else if (left == 0 && both_ends)
          record.merged.insert(vertex_dof(other));
        else if (left == 0 && !blocked[other])
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
      const bool                                 *rim, *blocked;
      const std::vector<types::global_dof_index> &dofs;
      MultiplierRecords                          &records;
      const unsigned int                          n_rims;
    };
  } // namespace

  void
  make_up_for_blocked_vertices(const MultiplierFace &face,
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
        if (!vertex.is_alone())
          continue;
        vertex.made_up |= face.face_degree > 1;
        for (unsigned int k = 0; k < basis.size(); ++k)
          if (is_last(basis.functions[k]))
            records[dofs[k]].kept = false;
        for (unsigned int e = 0; e < basis.n_edges(); ++e)
          if (const auto ends = basis.edge_vertices(e);
              ends[0] == v || ends[1] == v)
            if (const auto other = ends[0] == v ? ends[1] : ends[0];
                !face.blocked_vertex[c][other])
              vertex.neighbours.insert(dofs[basis.vertex_function(other)]);
      }
  }

  void
  apply_multiplier_rules(const MultiplierFace &face,
                         const unsigned int    c,
                         MultiplierRecords    &records)
  {
    FaceRules(face, c, records).apply(face.can_follow[c]);
  }
} // namespace mortise
