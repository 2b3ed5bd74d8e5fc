#include <deal.II/base/utilities.h>

#include <boost/serialization/vector.hpp>

#include <mortise/adapt/cell_changes.h>
#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/legendre_elements.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of a cell of @p degree, in any unit: within a quarter what products with
    /// the matrix-free operator take (doc/measurements/bulk.md).
    unsigned int
    work(const unsigned int degree)
    {
      return std::pow(degree + 1, 3);
    }

    /// Initial state of child @p child of a cell with @p state.
    CellState
    state_of_child(const CellState &state, const unsigned int child)
    {
      CellState result          = state;
      result.history.is_refined = true;
      result.history.is_split   = true;
      result.history.n_rises    = 0;
      result.history.fall       = 1.;
      result.history.error /= GeometryInfo<dim>::max_children_per_cell;
      for (const OfState part : {&CellState::coefficients, &CellState::dual})
        for (unsigned int c = 0; c < (result.*part).size(); ++c)
          (result.*part)[c] =
            embed_in_child(c < dim ? state.degree : state.degree - 1,
                           child,
                           (state.*part)[c]);
      return result;
    }
  } // namespace

  void
  lower(const ReferenceCell &cell, const unsigned int degree, CellState &state)
  {
    for (const OfState part : {&CellState::coefficients, &CellState::dual})
      for (unsigned int c = 0; c < (state.*part).size(); ++c)
        {
          const unsigned int  less = c < dim ? 0 : 1; // of the pressure
          std::vector<double> lower;
          for (const unsigned int mode :
               nested_modes(cell, degree - less, state.degree - less))
            lower.push_back((state.*part)[c][mode]);
          (state.*part)[c] = std::move(lower);
        }
    state.degree = state.history.degree = degree;
  }

  namespace
  {
    /// What @p of_child brings to @p coefficients of its parent, a hexahedron of @p degree.
    void
    add_child(const CellCoefficients &of_child,
              const unsigned int      degree_of_child,
              const unsigned int      child,
              const unsigned int      degree,
              CellCoefficients       &coefficients)
    {
      coefficients.resize(of_child.size());
      for (unsigned int c = 0; c < of_child.size(); ++c)
        {
          const unsigned int  less  = c < dim ? 0 : 1;
          const auto          modes = nested_modes(ReferenceCells::Hexahedron,
                                          degree_of_child - less,
                                          degree - less);
          std::vector<double> raised(
            Utilities::fixed_power<dim>(degree + 1 - less));
          for (unsigned int i = 0; i < modes.size(); ++i)
            raised[modes[i]] = of_child[c][i];
          const auto part = merge_from_child(degree - less, child, raised);
          coefficients[c].resize(part.size(), 0.);
          for (unsigned int i = 0; i < part.size(); ++i)
            coefficients[c][i] += part[i];
        }
    }

    /// Of a cell whose children have @p states, with the largest degree of them.
    CellState
    state_of_parent(const std::vector<CellState> &states)
    {
      CellState result;
      result.history       = states.front().history;
      CellHistory &history = result.history;
      history.change = history.error = history.violation = 0.;
      history.n_rises                                    = 0;
      history.fall                                       = 1.;
      for (const CellState &state : states)
        {
          const CellHistory &own = state.history;
          result.degree          = std::max(result.degree, state.degree);
          history.change += own.change;
          history.error += own.error;
          history.violation += own.violation;
          history.by_residual = std::max(history.by_residual, own.by_residual);
          history.ratio       = std::max(history.ratio, own.ratio);
          history.is_new |= own.is_new;
          history.at_free_boundary |= own.at_free_boundary;
        }
      history.degree = result.degree;
      for (const OfState part : {&CellState::coefficients, &CellState::dual})
        for (unsigned int c = 0; c < states.size(); ++c)
          add_child(
            states[c].*part, states[c].degree, c, result.degree, result.*part);
      return result;
    }
  } // namespace

  void
  change_cells(Body                    &body,
               const std::vector<bool> &split,
               const std::vector<bool> &merge,
               std::vector<CellState>  &states)
  {
    auto &triangulation =
      dynamic_cast<HexTriangulation &>(*body.mesh.triangulation);
    body.pressure.reset();
    // a handler follows the cells of its mesh, from deal.II 9.6 on without
    // dofs, too, which then fails
    static const Triangulation<dim> no_cells;
    body.dof_handler.reinit(no_cells);
    for (const auto &cell : triangulation.active_cell_iterators())
      if (const unsigned int k = cell->active_cell_index();
          cell->is_locally_owned())
        {
          if (split[k])
            cell->set_refine_flag();
          else if (merge[k])
            cell->set_coarsen_flag();
        }
    triangulation.prepare_coarsening_and_refinement();

    using Cell   = HexTriangulation::cell_iterator;
    using Status = HexTriangulation::CellStatus;
    // of a cell, or of those that become one
    const auto states_of = [&](const Cell &cell, const Status status) {
      if (status != HexTriangulation::CELL_COARSEN)
        return std::vector<CellState>{states[cell->active_cell_index()]};
      std::vector<CellState> result;
      for (unsigned int c = 0; c < cell->n_children(); ++c)
        result.push_back(states[cell->child(c)->active_cell_index()]);
      return result;
    };
    const auto balance = triangulation.signals.weight.connect(
      [&](const Cell &cell, const Status status) {
        const Cell one =
          status == HexTriangulation::CELL_COARSEN ? cell->child(0) : cell;
        return work(states[one->active_cell_index()].history.degree);
      });
    const unsigned int handle = triangulation.register_data_attach(
      [&](const Cell &cell, const Status status) {
        return Utilities::pack(states_of(cell, status), false);
      },
      true);
    triangulation.execute_coarsening_and_refinement();
    balance.disconnect();
    if (body.mesh.geometry != nullptr)
      body.mesh.geometry->place_vertices(triangulation);

    states.clear();
    states.resize(triangulation.n_active_cells());
    triangulation.notify_ready_to_unpack(
      handle, [&](const Cell &cell, const Status status, const auto &data) {
        const auto before =
          Utilities::unpack<std::vector<CellState>>(data.begin(),
                                                    data.end(),
                                                    false);
        if (status == HexTriangulation::CELL_REFINE)
          for (unsigned int c = 0; c < cell->n_children(); ++c)
            states[cell->child(c)->active_cell_index()] =
              state_of_child(before.front(), c);
        else
          states[cell->active_cell_index()] =
            status == HexTriangulation::CELL_COARSEN ? state_of_parent(before) :
                                                       before.front();
      });
    body.dof_handler.reinit(triangulation);
  }
} // namespace mortise
