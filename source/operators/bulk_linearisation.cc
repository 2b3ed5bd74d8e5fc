// Laws that are not linear: members of BulkSystem.
#include <deal.II/base/mpi.h>

#include <mortise/base/run_log.h>
#include <mortise/operators/block_system.h>
#include <mortise/operators/bulk_system.h>
#include <mortise/operators/cells/cell_geometry.h>
#include <mortise/operators/follower_pressures.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Calls @p visit(body, cell, group, number) for the owned cells of bodies
    /// whose law is not linear, with the number that a cell has in its group of
    /// CellBatches.
    template <typename Visit>
    void
    for_each_nonlinear_cell(const NodalSpace &space, const Visit &visit)
    {
      unsigned int group = 0;
      for (const Body *body : space.bodies())
        for (unsigned int element = 0; element < body->fe.size();
             ++element, ++group)
          {
            unsigned int number = 0;
            if (body->material.nonlinear())
              for (const auto &cell : body->dof_handler.active_cell_iterators())
                if (cell->is_locally_owned() &&
                    cell->active_fe_index() == element)
                  visit(*body, cell, group, number++);
          }
    }

    unsigned int
    n_indices(const NodalSpace &space)
    {
      unsigned int n = 0;
      for (const Body *body : space.bodies())
        n = std::max(n, body->index + 1);
      return n;
    }

    CellModuli
    moduli_by_cell(const NodalSpace                       &space,
                   const std::vector<std::vector<Moduli>> &by_group)
    {
      CellModuli result(n_indices(space));
      for (const Body *body : space.bodies())
        if (body->material.nonlinear())
          result[body->index].resize(body->triangulation().n_active_cells());
      for_each_nonlinear_cell(space,
                              [&](const Body        &body,
                                  const auto        &cell,
                                  const unsigned int group,
                                  const unsigned int number) {
                                result[body.index][cell->active_cell_index()] =
                                  by_group[group][number];
                              });
      return result;
    }
  } // namespace

  Vector
  BulkSystem::forces_of(const FollowerPressures &given,
                        const Vector            &u,
                        const Body              *body,
                        const types::boundary_id boundary) const
  {
    const Vector values(u);
    Vector       sum;
    initialize(sum);
    stiffness->complete(values);
    given.add_forces(values.begin(), sum.begin(), body, boundary);
    stiffness->gather(sum);
    return sum;
  }

  void
  BulkSystem::add_following_forces_free(Vector &dst, const Vector &src) const
  {
    if (!has_following_forces())
      return;
    Vector sum;
    initialize(sum);
    if (of_interfaces.m() > 0)
      {
        of_interfaces.vmult(sum, src);
        dst += sum;
        sum = 0.;
      }
    if (!follower)
      return;
    stiffness->complete(src);
    follower->add_product(src.begin(), sum.begin());
    stiffness->release(src);
    stiffness->gather(sum);
    dst += sum;
  }

  void
  BulkSystem::add_following_forces(Vector &dst, const Vector &src) const
  {
    if (!has_following_forces())
      return;
    add_following_forces_free(dst, src);
    stiffness->clear_constrained(dst);
  }

  bool
  BulkSystem::follower_is_symmetric() const
  {
    // by two fields that are as good as random
    constexpr double rounding = 1e-9;
    Vector           a, b, of_a, of_b;
    for (Vector *v : {&a, &b, &of_a, &of_b})
      initialize(*v);
    const auto range = all_levels.front().layout->local_range();
    for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
      {
        const double n     = static_cast<double>(range.first + i);
        a.local_element(i) = std::sin(12.9898 * n);
        b.local_element(i) = std::sin(78.233 * n + 1.);
      }
    stiffness->clear_constrained(a);
    stiffness->clear_constrained(b);
    add_following_forces(of_a, a);
    add_following_forces(of_b, b);
    return std::fabs(a * of_b - b * of_a) <=
           rounding *
             (of_a.l2_norm() * b.l2_norm() + of_b.l2_norm() * a.l2_norm());
  }

  bool
  BulkSystem::is_nonlinear() const
  {
    const auto &bodies = all_levels.front().space->bodies();
    return nonlinear ||
           std::any_of(bodies.begin(), bodies.end(), [](const Body *body) {
             return body->material.nonlinear() != nullptr;
           });
  }

  BulkSystem::Response
  BulkSystem::respond(const Vector       &u,
                      const Vector       &p,
                      const PointHistory &before,
                      const PointHistory &thermal) const
  {
    Response     result;
    const Vector values(u); // those of hanging nodes are not kept
    initialize(result.forces);
    stiffness->complete(values);
    if (pressures)
      {
        initialize_pressure(result.dilatation);
        pressures->complete(p);
      }
    const PointHistory  none = before.empty() ? no_history() : PointHistory();
    const PointHistory &from = before.empty() ? none : before;
    result.history           = from;
    // the first are only read
    result.least_of_rank = stiffness->elasticity().add_residual(
      {const_cast<double *>(values.begin()), const_cast<double *>(p.begin())},
      from,
      result.history,
      {result.forces.begin(), result.dilatation.begin()},
      thermal);
    stiffness->gather(result.forces);
    if (pressures)
      {
        pressures->release(p);
        pressures->gather(result.dilatation);
      }
    result.least_jacobian =
      Utilities::MPI::min(result.least_of_rank.value,
                          all_levels.front().layout->get_mpi_communicator());
    return result;
  }

  std::string
  BulkSystem::place_of_least_jacobian(const Response &response) const
  {
    const NodalSpace &space = *all_levels.front().space;
    const MPI_Comm    comm  = all_levels.front().layout->get_mpi_communicator();
    const LeastJacobian &least  = response.least_of_rank;
    const double         lowest = response.least_jacobian;
    const unsigned int   mine   = Utilities::MPI::this_mpi_process(comm);
    const unsigned int   rank =
      Utilities::MPI::min(least.value <= lowest ?
                            mine :
                            Utilities::MPI::n_mpi_processes(comm),
                          comm);
    const unsigned int number = least.batch * Batch<double>::size + least.lane;
    std::string        text;
    if (rank == mine)
      for_each_nonlinear_cell(space,
                              [&](const Body        &body,
                                  const auto        &cell,
                                  const unsigned int group,
                                  const unsigned int in_group) {
                                if (group != least.group || in_group != number)
                                  return;
                                const Point<dim> x = cell->center();
                                text = "body " + body.name + ", cell at (" +
                                       RunLog::number(x[0]) + ", " +
                                       RunLog::number(x[1]) + ", " +
                                       RunLog::number(x[2]) + ")";
                              });
    return Utilities::MPI::broadcast(
      comm, text, std::min(rank, Utilities::MPI::n_mpi_processes(comm) - 1));
  }

  std::vector<CellHistories>
  BulkSystem::by_cell(const PointHistory &history) const
  {
    constexpr unsigned int     width = Batch<double>::size;
    const NodalSpace          &space = *all_levels.front().space;
    std::vector<CellHistories> result(n_indices(space));
    if (history.empty())
      return result;
    for_each_nonlinear_cell(
      space,
      [&](const Body        &body,
          const auto        &cell,
          const unsigned int group,
          const unsigned int number) {
        const std::size_t n = body.material.nonlinear()->n_history() *
                              stiffness->cells()[group].n_points;
        auto &of_body = result[body.index];
        if (n == 0)
          return;
        of_body.resize(body.triangulation().n_active_cells());
        auto &numbers = of_body[cell->active_cell_index()];
        for (std::size_t i = 0; i < n; ++i)
          numbers.push_back(
            history[group][(number / width * n + i) * width + number % width]);
      });
    for (const Body *body : space.bodies())
      if (has_history(*body))
        update_ghosts(*body, result[body->index]);
    return result;
  }

  PointHistory
  BulkSystem::thermal_strains(const std::vector<ThermalStrain> &by_body) const
  {
    constexpr unsigned int width = Batch<double>::size;
    const NodalSpace      &space = *all_levels.front().space;
    if (std::none_of(
          space.bodies().begin(), space.bodies().end(), [&](const Body *body) {
            return body->material.nonlinear() && by_body[body->index];
          }))
      return {};
    PointHistory result(stiffness->cells().size());
    std::map<std::pair<unsigned int, unsigned int>, CellGeometry> geometries;
    for_each_nonlinear_cell(
      space,
      [&](const Body        &body,
          const auto        &cell,
          const unsigned int group,
          const unsigned int number) {
        if (!by_body[body.index])
          return;
        const auto   &cells   = stiffness->cells()[group];
        const auto    element = cell->active_fe_index();
        CellGeometry &geometry =
          geometries
            .try_emplace({body.index, element},
                         body,
                         body.fe[element].reference_cell(),
                         points_of_forces(body, element))
            .first->second;
        result[group].resize(std::size_t(cells.n_batches) * cells.n_points *
                             width);
        const auto &points = geometry.points(cell);
        for (unsigned int q = 0; q < points.size(); ++q)
          result[group]
                [(std::size_t(number / width) * points.size() + q) * width +
                 number % width] = by_body[body.index](points[q]);
      });
    return result;
  }

  PointHistory
  BulkSystem::by_point(const std::vector<CellHistories> &histories) const
  {
    constexpr unsigned int width  = Batch<double>::size;
    PointHistory           result = no_history();
    for_each_nonlinear_cell(
      *all_levels.front().space,
      [&](const Body        &body,
          const auto        &cell,
          const unsigned int group,
          const unsigned int number) {
        const std::size_t n = body.material.nonlinear()->n_history() *
                              stiffness->cells()[group].n_points;
        for (std::size_t i = 0; i < n; ++i)
          result[group][(number / width * n + i) * width + number % width] =
            histories[body.index][cell->active_cell_index()][i];
      });
    return result;
  }

  void
  BulkSystem::linearise_undeformed()
  {
    Vector u, p;
    initialize(u);
    if (pressures)
      initialize_pressure(p);
    stiffness->elasticity().linearise({u.begin(), p.begin()}, no_history());
    show_tangent(true);
  }

  void
  BulkSystem::show_tangent(const bool initial_stress)
  {
    const auto &elasticity    = stiffness->elasticity();
    const auto  linearisation = std::make_shared<const Linearisation>(
      Linearisation{elasticity,
                    moduli_by_cell(*all_levels.front().space,
                                   elasticity.average_moduli(initial_stress)),
                    initial_stress});
    for (MultigridLevel &level : all_levels)
      level.linearisation = linearisation;
  }

  void
  BulkSystem::linearise(const SystemVector      &x,
                        const SystemVector      *previous,
                        const PointHistory      &before,
                        const PointHistory      &thermal,
                        const FollowerPressures *given,
                        const bool               preconditioners)
  {
    Vector     values, of_pressure, earlier, earlier_pressure;
    const auto complete = [&](const SystemVector &of, Vector &u, Vector &p) {
      u = of.displacement;
      p = of.pressure;
      stiffness->complete(u);
      if (pressures)
        pressures->complete(p);
      return MatrixFreeElasticity<double>::Fields{u.begin(), p.begin()};
    };
    const auto fields = complete(x, values, of_pressure);
    follower.reset();
    of_interfaces = SparseMatrix();
    positive      = true;
    if (given != nullptr)
      {
        follower = std::make_unique<FollowerPressures>(*given);
        follower->linearise(values.begin());
        positive = follower_is_symmetric();
      }
    MatrixFreeElasticity<double>::Fields from;
    if (previous != nullptr)
      from = complete(*previous, earlier, earlier_pressure);
    stiffness->elasticity().linearise(fields, before, thermal, from);
    if (!preconditioners)
      return;
    stiffness->diagonal(stiffness_diagonal);
    show_tangent(true);
  }
} // namespace mortise
