#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/body/elements/cell_face.h>
#include <mortise/mortar/coupling.h>
#include <mortise/mortar/isolated_vertices.h>
#include <mortise/mortar/multiplier_faces.h>
#include <mortise/mortar/multiplier_rules.h>
#include <mortise/mortar/multiplier_space.h>
#include <mortise/mortar/slave_frames.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What may stand in the line of a multiplier for @p dof: itself, or what it
    /// hangs on. Lines without hanging dofs cannot go round in circles, since
    /// each of these hangs on some of the others.
    MultiplierRecord::Dofs
    without_hanging(const types::global_dof_index    dof,
                    const AffineConstraints<double> &conformity)
    {
      if (!conformity.is_constrained(dof))
        return {dof};
      MultiplierRecord::Dofs result;
      for (const auto &entry : *conformity.get_constraint_entries(dof))
        result.insert(entry.first);
      return result;
    }

    /// Hanging edges cannot follow others: there is no one function between
    /// them and the edges across.
    bool
    is_merged_with_hanging_edge(const MultiplierRecord          &record,
                                const AffineConstraints<double> &conformity)
    {
      return !record.vertex &&
             std::any_of(record.merged.begin(),
                         record.merged.end(),
                         [&](const auto dof) {
                           return conformity.is_constrained(dof);
                         });
    }

    /// The smallest dof among those that are merged with @p dof, directly or through others.
    types::global_dof_index
    representative(const types::global_dof_index    dof,
                   const MultiplierRecords         &records,
                   const AffineConstraints<double> &conformity)
    {
      MultiplierRecord::Dofs               group = {dof};
      std::vector<types::global_dof_index> open  = {dof};
      while (!open.empty())
        {
          const auto record = records.find(open.back());
          open.pop_back();
          if (record == records.end())
            continue;
          for (const auto merged : record->second.merged)
            for (const auto other : without_hanging(merged, conformity))
              if (const auto found = records.find(other);
                  found != records.end() &&
                  found->second.vertex == record->second.vertex &&
                  group.insert(other).second)
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

    using DofSets = std::map<types::global_dof_index, MultiplierRecord::Dofs>;

    bool
    is_sliver(const MultiplierFace &face)
    {
      return face.cover == FaceCoverage::sliver;
    }

    /// Owned dofs of vertices that take the mean of others: those that are
    /// isolated but for others beside them on the rim, and those that are on
    /// slivers only.
    DofSets
    find_dependent_dofs(const Body                        &body,
                        const std::vector<MultiplierFace> &faces,
                        const unsigned int                 n_directions,
                        const MultiplierRecords           &records)
    {
      // the owner of a dof knows all faces around it
      const IndexSet &owned = body.dof_handler.locally_owned_dofs();
      LinearAlgebra::distributed::Vector<double> settled(
        owned, body.relevant_dofs, body.triangulation().get_communicator());
      for (const auto &[dof, record] : records)
        if (owned.is_element(dof) && record.vertex && !record.is_isolated() &&
            !body.conformity.is_constrained(dof))
          settled(dof) = 1.;
      settled.update_ghost_values();

      DofSets    dependent;
      const auto follow = [&](const auto dof, const auto vertex) {
        for (const auto other : without_hanging(vertex, body.conformity))
          if (settled(other) > 0.5)
            dependent[dof].insert(other);
      };
      for (const auto &[dof, record] : records)
        if (owned.is_element(dof) && record.is_isolated())
          for (const auto other : record.beside)
            follow(dof, other);
      for (const MultiplierFace &face : faces)
        for (unsigned int c = 0; c < n_directions && is_sliver(face); ++c)
          for (unsigned int v = 0; v < face.basis->n_vertices(); ++v)
            if (const auto dof = face.dofs[c][face.basis->vertex_function(v)];
                owned.is_element(dof) && records.count(dof) == 0)
              for (unsigned int w = 0; w < face.basis->n_vertices(); ++w)
                follow(dof, face.dofs[c][face.basis->vertex_function(w)]);
      return dependent;
    }

    /// By dof of the vertices that no other gives a value, those of slivers
    /// among them: whether any displacement can follow a multiplier there.
    std::map<types::global_dof_index, bool>
    find_isolated(const Body                        &body,
                  const std::vector<MultiplierFace> &faces,
                  const unsigned int                 n_directions,
                  const MultiplierRecords           &records,
                  const DofSets                     &dependent)
    {
      std::map<types::global_dof_index, bool> isolated;
      const auto add = [&](const types::global_dof_index dof,
                           const bool has_free_displacement) {
        if (!body.conformity.is_constrained(dof) && dependent.count(dof) == 0)
          isolated.emplace(dof, false).first->second |= has_free_displacement;
      };
      for (const auto &[dof, record] : records)
        if (record.is_isolated())
          add(dof, record.has_free_displacement);
      for (const MultiplierFace &face : faces)
        for (unsigned int c = 0; c < n_directions && is_sliver(face); ++c)
          for (unsigned int v = 0; v < face.basis->n_vertices(); ++v)
            if (const auto dof = face.dofs[c][face.basis->vertex_function(v)];
                records.count(dof) == 0)
              add(dof, face.has_free_displacement[c]);
      return isolated;
    }

    /// The line of one dof without conformity constraints; none if it is a
    /// multiplier.
    void
    add_reduction(const types::global_dof_index    dof,
                  const MultiplierRecords         &records,
                  const AffineConstraints<double> &conformity,
                  AffineConstraints<double>       &reduction)
    {
      const auto found = records.find(dof);
      if (found == records.end() || !found->second.kept ||
          (!found->second.vertex && !found->second.on_full_face) ||
          is_merged_with_hanging_edge(found->second, conformity))
        {
          reduction.add_line(dof);
          return;
        }
      const MultiplierRecord &record = found->second;
      if (record.vertex && record.on_rim && !record.across_kept)
        {
          if (!record.neighbours.empty())
            return add_mean(dof, record.neighbours, reduction);
          if (record.merged.empty())
            return add_mean(dof, record.diagonal, reduction);
        }
      if (record.has_no_rim() && !record.compensated &&
          !record.neighbours.empty())
        return add_mean(dof, record.neighbours, reduction);
      const auto same = representative(dof, records, conformity);
      if (same != dof)
        add_mean(dof, {same}, reduction);
    }
    /// The line of a hanging dof. @p vertex_values: above 0.5 where a vertex has
    /// a value. Vertices hang on those that have one, so that constants are
    /// reproduced: others are beyond what is covered, or on another boundary.
    void
    add_hanging(const types::global_dof_index                     dof,
                const bool                                        is_vertex,
                const AffineConstraints<double>                  &conformity,
                const LinearAlgebra::distributed::Vector<double> &vertex_values,
                AffineConstraints<double>                        &reduction)
    {
      const auto &entries = *conformity.get_constraint_entries(dof);
      double      sum     = 0.;
      for (const auto &[other, weight] : entries)
        if (vertex_values(other) > 0.5)
          sum += weight;
      reduction.add_line(dof);
      for (const auto &[other, weight] : entries)
        {
          const bool shares = is_vertex && vertex_values(other) > 0.5;
          reduction.add_entry(dof, other, shares ? weight / sum : weight);
        }
    }

    /// Has a normal several components?
    bool
    mixes_components(const std::vector<Frame> &frames)
    {
      constexpr double rounding = 1e-6;
      for (const Frame &frame : frames)
        for (unsigned int c = 0; c < dim; ++c)
          if (const double n = std::fabs(frame[0][c]);
              n > rounding && n < 1. - rounding)
            return true;
      return false;
    }
  } // namespace

  MultiplierSpace::MultiplierSpace(const Body                      &body,
                                   const Coupling                  &coupling,
                                   const std::vector<PartnerState> &partners,
                                   const std::vector<bool>         &constrained)
    : body(body)
    , frames(coupling.frames)
    , n_directions(
        coupling.law.constrained == ConstrainedDirections::all ? dim : 1)
    , one_sided(coupling.law.is_one_sided())
    , directed(coupling.is_directed())
  {
    if (coupling.is_turned)
      turn = coupling.placement.rotation;
    const BodySurface &slave = coupling.interface->slave();
    for (const PartnerState &partner : partners)
      {
        has_dual.push_back(partner.has_dual);
        along_normals.push_back(partner.along_normals);
      }
    for (const auto &of_face : frames)
      together.push_back(coupling.law.has_friction() &&
                         mixes_components(of_face));
    if (n_directions == dim)
      for (auto &of_face : frames)
        {
          normals.emplace_back();
          for (Frame &frame : of_face)
            {
              normals.back().push_back(frame[0]);
              frame = Frame(unit_symmetric_tensor<dim>());
            }
        }
    const std::vector<MultiplierFace> faces = collect_multiplier_faces(
      body,
      slave,
      partners,
      n_directions == dim ?
        constrained :
        constrained_normals(body, slave, frames, constrained));

    MultiplierRecords      records;
    NodesAndComponents     on_surface;
    MultiplierRecord::Dofs at_vertex;
    for (const MultiplierFace &face : faces)
      for (unsigned int c = 0; c < n_directions; ++c)
        {
          for (unsigned int k = 0; k < face.dofs[c].size(); ++k)
            {
              on_surface.emplace(face.dofs[c][k],
                                 std::make_pair(face.dofs[0][k], c));
              if (face.basis->functions[k].dimension == 0)
                at_vertex.insert(face.dofs[c][k]);
            }
          if (face.cover >= FaceCoverage::partial)
            apply_multiplier_rules(face, c, records);
        }
    add_edges_of_larger_cells(
      faces, n_directions, one_sided, body.conformity, on_surface, records);
    for (auto &[dof, record] : records)
      record.constrained &= !body.conformity.is_constrained(dof);
    for (const MultiplierFace &face : faces)
      for (unsigned int c = 0; c < n_directions; ++c)
        if (face.cover >= FaceCoverage::partial)
          compensate_constrained_vertices(face, c, records);

    const auto dependent =
      find_dependent_dofs(body, faces, n_directions, records);
    const auto any_free =
      find_isolated(body, faces, n_directions, records, dependent);
    const IsolatedVertices isolated(body, faces, any_free);
    IndexSet               known = body.relevant_dofs;
    isolated.add_representatives(known);
    reduction.reinit(known);
    LinearAlgebra::distributed::Vector<double> vertex_values(
      body.dof_handler.locally_owned_dofs(),
      body.relevant_dofs,
      body.triangulation().get_communicator());
    for (const auto &[dof, place] : on_surface)
      if (!body.conformity.is_constrained(dof) &&
          body.dof_handler.locally_owned_dofs().is_element(dof))
        {
          if (const auto found = dependent.find(dof); found != dependent.end())
            add_mean(dof, found->second, reduction);
          else if (any_free.count(dof) == 0)
            add_reduction(dof, records, body.conformity, reduction);
          else if (const auto constant = isolated.representative(dof);
                   !constant)
            reduction.add_line(dof);
          else if (*constant != dof)
            add_mean(dof, {*constant}, reduction);
          const auto *line = reduction.get_constraint_entries(dof);
          if (at_vertex.count(dof) > 0 && (line == nullptr || !line->empty()))
            vertex_values(dof) = 1.;
          if (line != nullptr)
            continue;
          owned_dofs.push_back(dof);
          nodes_and_components.push_back(place);
          const auto record = records.find(dof);
          at_vertices.push_back(record == records.end() ||
                                record->second.vertex);
        }
    vertex_values.update_ghost_values();
    complete_constraints(body.dof_handler, reduction);
    for (const auto &[cell, f] : slave.known)
      for (const auto &component : face_dofs(cell, f))
        for (unsigned int k = 0; k < component.size(); ++k)
          if (const auto dof = component[k];
              body.conformity.is_constrained(dof) &&
              !reduction.is_constrained(dof))
            add_hanging(dof,
                        CellFace(cell, f).basis->functions[k].dimension == 0,
                        body.conformity,
                        vertex_values,
                        reduction);
    reduction.close();
  }
} // namespace mortise
