#include <mortise/body/elements/simplex_basis.h>
#include <mortise/mortar/nodal_block.h>
#include <mortise/operators/levels/multigrid_level.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    IndexSet
    nodes_of_interfaces(const std::vector<Coupling> &couplings,
                        const unsigned int           number,
                        const IndexSet              &owned)
    {
      std::vector<NodalSpace::Index> nodes;
      for (const Coupling &coupling : couplings)
        {
          for (const FaceTrace &trace : coupling.interface->slave().traces)
            nodes.insert(nodes.end(),
                         trace.nodes[number].nodes.begin(),
                         trace.nodes[number].nodes.end());
          for (const FaceTrace &trace : coupling.interface->master_traces())
            nodes.insert(nodes.end(),
                         trace.nodes[number].nodes.begin(),
                         trace.nodes[number].nodes.end());
        }
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      IndexSet result(owned.size());
      result.add_indices(nodes.begin(), nodes.end());
      return result;
    }

    /// Components of @p space that hang, or are prescribed on the finest level: on
    /// vertices, lines and faces of the cells.
    std::vector<unsigned int>
    find_constrained(const NodalSpace                  &space,
                     const Utilities::MPI::Partitioner &layout,
                     const FieldNumbering              &numbering,
                     const AffineConstraints<double>   &constraints)
    {
      std::vector<char> constrained(layout.locally_owned_size());
      std::vector<types::global_dof_index> dofs;
      space.for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          const auto        &fe = cell->get_fe();
          const unsigned int p = fe.degree, q = space.degree(body, cell);
          dofs.resize(fe.n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          // An entity is prescribed as a whole: look at its first mode. One
          // that is tied to a neighbour's has an entry; one that is above the
          // degree of the entity is where all nodes hang.
          const auto copy = [&](const unsigned int mode,
                                const unsigned int node,
                                const unsigned int n) {
            for (unsigned int c = 0; c < dim; ++c)
              if (const auto dof =
                    numbering(body.index,
                              dofs[fe.component_to_system_index(c, mode)]);
                  constraints.is_constrained(dof) &&
                  constraints.get_constraint_entries(dof)->empty())
                for (unsigned int i = node; i < node + n; ++i)
                  if (const auto index = dim * nodes[i] + c;
                      layout.in_local_range(index))
                    constrained[layout.global_to_local(index)] = true;
          };
          unsigned int mode = 0, node = 0;
          const auto   advance = [&](const unsigned int n_entities,
                                   const unsigned int n_modes,
                                   const unsigned int n_nodes) {
            for (unsigned int e = 0; e < n_entities; ++e)
              {
                if (n_nodes > 0)
                  copy(mode, node, n_nodes);
                mode += n_modes;
                node += n_nodes;
              }
          };
          advance(cell->n_vertices(), 1, 1);
          advance(cell->n_lines(), p - 1, q - 1);
          if (body.mesh.tetrahedra)
            advance(cell->n_faces(), n_face_modes(p), n_face_modes(q));
          else
            advance(cell->n_faces(), (p - 1) * (p - 1), (q - 1) * (q - 1));
        });
      for (const auto &line : space.hanging_nodes().get_lines())
        for (unsigned int c = 0; c < dim; ++c)
          if (const auto index = dim * line.index + c;
              layout.in_local_range(index))
            constrained[layout.global_to_local(index)] = true;
      std::vector<unsigned int> indices;
      for (unsigned int i = 0; i < constrained.size(); ++i)
        if (constrained[i])
          indices.push_back(i);
      return indices;
    }
  } // namespace

  MultigridLevel
  make_multigrid_level(std::shared_ptr<const NodalSpace> space,
                       const FieldNumbering             &numbering,
                       const AffineConstraints<double>  &constraints,
                       const MPI_Comm                    comm)
  {
    MultigridLevel level;
    level.layout = std::make_shared<const Utilities::MPI::Partitioner>(
      displacement_indices(space->owned_nodes()),
      displacement_indices(space->relevant_nodes()),
      comm);
    level.constrained =
      find_constrained(*space, *level.layout, numbering, constraints);
    level.space = std::move(space);
    return level;
  }

  std::shared_ptr<const Utilities::MPI::Partitioner>
  interface_layout(const MultigridLevel        &level,
                   const unsigned int           number,
                   const std::vector<Coupling> &couplings)
  {
    const IndexSet &owned = level.space->owned_nodes();
    return std::make_shared<const Utilities::MPI::Partitioner>(
      displacement_indices(owned),
      displacement_indices(nodes_of_interfaces(couplings, number, owned)),
      level.layout->get_mpi_communicator());
  }

  LevelVector<double>
  constrained_components(
    const MultigridLevel                                     &level,
    const std::shared_ptr<const Utilities::MPI::Partitioner> &layout)
  {
    LevelVector<double> constrained(layout);
    for (const unsigned int index : level.constrained)
      constrained.local_element(index) = 1.;
    constrained.update_ghost_values();
    return constrained;
  }

  template <typename Number>
  LevelOperator<Number>::LevelOperator(const MultigridLevel &level,
                                       const bool            with_penalty,
                                       const PressureNodes  *pressures)
    : level(level)
    , stiffness(*level.space, *level.layout, pressures)
    , hanging(*level.space, *level.layout)
  {
    if (level.linearisation)
      stiffness.take_tangent(level.linearisation->finest,
                             level.linearisation->has_initial_stress);
    if (with_penalty && level.penalties)
      penalty = std::make_unique<PenaltyProduct<Number>>(level.penalties);
  }

  template <typename Number>
  void
  LevelOperator<Number>::vmult_free(LevelVector<Number>       &dst,
                                    const LevelVector<Number> &src) const
  {
    complete(src);
    dst = 0;
    stiffness.add_product(src.begin(), dst.begin());
    release(src);
    gather(dst);
    if (penalty)
      penalty->add(src.begin(), dst.begin());
  }

  template <typename Number>
  void
  LevelOperator<Number>::diagonal(LevelVector<Number> &diagonal) const
  {
    initialize(diagonal);
    Number *out = diagonal.begin();
    stiffness.add_diagonal(out);
    hanging.collect_diagonal(out);
    diagonal.compress(VectorOperation::add);
    if (penalty)
      penalty->add_diagonal(out);
    for (const unsigned int index : level.constrained)
      diagonal.local_element(index) = 1;
  }

  template class LevelOperator<float>;
  template class LevelOperator<double>;
} // namespace mortise
