#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/body/face_topology.h>
#include <mortise/mortar/multiplier_faces.h>
#include <mortise/mortar/multiplier_space.h>
#include <mortise/mortar/stranded_vertices.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What the faces around one dof say about its multiplier.
    struct Record
    {
      bool kept         = true;  ///< not above the reduced degree of a face
      bool on_full_face = false; ///< some face around it is well covered
      bool vertex       = false;
      bool on_rim       = false; ///< vertices: end of an edge across a rim ...
      bool across_kept  = false; ///< ... that has modes left
      bool can_follow =
        false; ///< the other side of some face around it is free
      std::set<types::global_dof_index>
        neighbours; ///< across the rim, off all rims
      std::set<types::global_dof_index>
        diagonal; ///< other vertices, off all rims
      std::set<types::global_dof_index> merged; ///< must have the same value

      /// A vertex on a rim that finds no free one on the faces around it to
      /// take its value from.
      bool
      is_stranded() const
      {
        return vertex && on_rim && !across_kept && neighbours.empty() &&
               merged.empty() && diagonal.empty();
      }
    };
    using Records = std::map<types::global_dof_index, Record>;

    /// Rules for the modes of one face and component.
    class FaceRules
    {
    public:
      FaceRules(const MultiplierFace &face,
                const unsigned int    c,
                Records              &records)
        : face(face)
        , c(c)
        , records(records)
        , n(face.degree + 1)
      {
        for (unsigned int a = 0; a < 2; ++a)
          rims[a] = face.rim[c][a][0] + face.rim[c][a][1];
      }

      void
      apply()
      {
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            {
              Record &record = records[dof(i, j)];
              record.on_full_face |=
                face.status == MultiplierFace::Status::full;
              record.can_follow |= face.can_follow[c];
              if (i < 2 && j < 2)
                vertex(i, j, record);
              else if (j < 2)
                edge(0, i, j, record);
              else if (i < 2)
                edge(1, j, i, record);
              else if (i + rims[0] > face.quad_degree ||
                       j + rims[1] > face.quad_degree)
                record.kept = false;
            }
      }

    private:
      types::global_dof_index
      dof(const unsigned int i, const unsigned int j) const
      {
        return face.dofs[c][i + n * j];
      }

      /// Highest mode of the edge along @p a at @p side, reduced; -1: nothing at all.
      int
      reduced_degree(const unsigned int a, const unsigned int side) const
      {
        return static_cast<int>(face.edge_degree[a][side]) -
               static_cast<int>(rims[a]);
      }

      void
      edge(const unsigned int a,
           const unsigned int mode,
           const unsigned int side,
           Record            &record)
      {
        if (static_cast<int>(mode) > reduced_degree(a, side))
          record.kept = false;
        // two rims and nothing but a constant between them: both edges carry
        // one function
        const unsigned int b = 1 - a;
        if (rims[b] == 2 && reduced_degree(b, 0) == 0 &&
            reduced_degree(b, 1) == 0)
          record.merged.insert(a == 0 ? dof(mode, 1 - side) :
                                        dof(1 - side, mode));
      }

      void
      vertex(const unsigned int i, const unsigned int j, Record &record)
      {
        record.vertex = true;
        for (unsigned int a = 0; a < 2; ++a)
          if (face.rim[c][a][a == 0 ? i : j])
            {
              record.on_rim        = true;
              const unsigned int k = a == 0 ? 1 - i : i, l = a == 0 ? j : 1 - j;
              const int          left = reduced_degree(a, a == 0 ? j : i);
              if (left >= 1)
                record.across_kept = true;
              else if (left == 0 && rims[a] == 2)
                record.merged.insert(dof(k, l));
              else if (left == 0 && !face.blocked_vertex[c][k + 2 * l])
                record.neighbours.insert(dof(k, l));
            }
        for (unsigned int v = 0; v < 4; ++v)
          if (v != i + 2 * j && !face.blocked_vertex[c][v])
            record.diagonal.insert(dof(v % 2, v / 2));
      }

      const MultiplierFace &face;
      const unsigned int    c;
      Records              &records;
      const unsigned int    n;
      unsigned int          rims[2];
    };

    /// The smallest dof among those that are merged with @p dof, directly or through others.
    types::global_dof_index
    representative(const types::global_dof_index dof, const Records &records)
    {
      std::set<types::global_dof_index>    group = {dof};
      std::vector<types::global_dof_index> open  = {dof};
      while (!open.empty())
        {
          const auto record = records.find(open.back());
          open.pop_back();
          if (record != records.end())
            for (const auto other : record->second.merged)
              if (group.insert(other).second)
                open.push_back(other);
        }
      return *group.begin();
    }

    void
    add_mean(const types::global_dof_index            dof,
             const std::set<types::global_dof_index> &of,
             AffineConstraints<double>               &reduction)
    {
      reduction.add_line(dof);
      for (const auto other : of)
        reduction.add_entry(dof, other, 1. / of.size());
    }

    /// The line of one dof without conformity constraints; none if it is a
    /// multiplier.
    void
    add_reduction(const types::global_dof_index dof,
                  const Records                &records,
                  const StrandedVertices       &stranded,
                  AffineConstraints<double>    &reduction)
    {
      const auto found = records.find(dof);
      if (found == records.end() || !found->second.kept ||
          (!found->second.vertex && !found->second.on_full_face))
        {
          reduction.add_line(dof);
          return;
        }
      const Record &record = found->second;
      if (record.is_stranded())
        {
          const auto constant = stranded.representative(dof);
          if (!constant)
            reduction.add_line(dof);
          else if (*constant != dof)
            add_mean(dof, {*constant}, reduction);
          return;
        }
      if (record.vertex && record.on_rim && !record.across_kept)
        {
          if (!record.neighbours.empty())
            return add_mean(dof, record.neighbours, reduction);
          if (record.merged.empty())
            return add_mean(dof, record.diagonal, reduction);
        }
      const auto same = representative(dof, records);
      if (same != dof)
        add_mean(dof, {same}, reduction);
    }
  } // namespace

  MultiplierSpace::MultiplierSpace(const Body                      &body,
                                   const types::boundary_id         boundary,
                                   const BodySurface               &slave,
                                   const std::vector<PartnerState> &partners,
                                   const std::vector<bool>         &blocked)
    : body(body)
  {
    const std::vector<MultiplierFace> faces =
      collect_multiplier_faces(body, boundary, slave, partners, blocked);

    Records                           records;
    std::set<types::global_dof_index> on_surface;
    for (const MultiplierFace &face : faces)
      for (unsigned int c = 0; c < dim; ++c)
        {
          on_surface.insert(face.dofs[c].begin(), face.dofs[c].end());
          if (face.status != MultiplierFace::Status::none)
            FaceRules(face, c, records).apply();
        }

    std::map<types::global_dof_index, bool> may_follow;
    for (const auto &[dof, record] : records)
      if (record.is_stranded() && !body.conformity.is_constrained(dof))
        may_follow.emplace(dof, record.can_follow);
    const StrandedVertices stranded(body, faces, may_follow);
    IndexSet               known = body.relevant_dofs;
    stranded.add_representatives(known);
    reduction.reinit(known);
    for (const auto dof : on_surface)
      if (!body.conformity.is_constrained(dof) &&
          body.dof_handler.locally_owned_dofs().is_element(dof))
        {
          add_reduction(dof, records, stranded, reduction);
          if (!reduction.is_constrained(dof))
            owned_dofs.push_back(dof);
        }
    complete_constraints(body.dof_handler, reduction);
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      for (const auto &component :
           face_dofs(body, slave.cells[s], slave.face_numbers[s]))
        for (const auto dof : component)
          if (body.conformity.is_constrained(dof) &&
              !reduction.is_constrained(dof))
            {
              reduction.add_line(dof);
              for (const auto &entry :
                   *body.conformity.get_constraint_entries(dof))
                reduction.add_entry(dof, entry.first, entry.second);
            }
    reduction.close();
  }

  void
  MultiplierSpace::number(const BodySurface &slave, const Index first)
  {
    LinearAlgebra::distributed::Vector<double> numbers(
      body.dof_handler.locally_owned_dofs(),
      reduction.get_local_lines(),
      body.triangulation.get_communicator());
    for (unsigned int i = 0; i < owned_dofs.size(); ++i)
      numbers(owned_dofs[i]) = first + i;
    numbers.update_ghost_values();

    face_rows.clear();
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      {
        FaceRows   rows;
        const auto dofs =
          face_dofs(body, slave.cells[s], slave.face_numbers[s]);
        rows.begin     = {0};
        const auto add = [&](const Index dof, const double weight) {
          rows.index.push_back(static_cast<Index>(numbers(dof)));
          rows.weight.push_back(weight);
        };
        for (unsigned int c = 0; c < dim; ++c)
          for (const auto dof : dofs[c])
            {
              if (!reduction.is_constrained(dof))
                add(dof, 1.);
              else
                for (const auto &entry : *reduction.get_constraint_entries(dof))
                  add(entry.first, entry.second);
              rows.begin.push_back(rows.index.size());
            }
        face_rows.push_back(std::move(rows));
      }
  }
} // namespace mortise
