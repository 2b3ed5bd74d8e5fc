// Elasticity as a plain program of deal.II solves it: the thick sphere of
// prm/thick_sphere_conforming.prm and nothing else. It shares no code with
// Mortise. Not a test: it serves plain.py.
//
//   plain_elasticity assembled|matrix_free DEGREE AROUND RADIAL
//
// assembled: a sparse matrix and conjugate gradients with algebraic multigrid
// (step-8, step-40). matrix_free: conjugate gradients with multigrid in the
// degree, Chebyshev smoothers and algebraic multigrid at degree one (step-37,
// step-75). Both end at a relative residual of 1e-8. Prints numbers as JSON.
#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/timer.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q_cache.h>

#include <deal.II/grid/manifold.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <deal.II/multigrid/mg_coarse.h>
#include <deal.II/multigrid/mg_matrix.h>
#include <deal.II/multigrid/mg_smoother.h>
#include <deal.II/multigrid/mg_transfer_global_coarsening.h>
#include <deal.II/multigrid/multigrid.h>

#include <deal.II/numerics/vector_tools.h>

#include <Teuchos_ParameterList.hpp>

#include <iostream>
#include <map>

#include "plain_multigrid.h"
#include "plain_scene.h"

using namespace plain;

namespace
{
  constexpr double tolerance = 1e-8;

  class PlainElasticity
  {
  public:
    PlainElasticity(const unsigned int degree)
      : triangulation(MPI_COMM_WORLD)
      , mapping(degree)
      , degree(degree)
    {}

    void
    run(const std::string &variant, unsigned int n, unsigned int m);

  private:
    void
    assemble(const Space &space, TrilinosWrappers::SparseMatrix &matrix) const;

    template <typename VectorType>
    void
    assemble_load(VectorType &load) const;

    void
    set_up_amg(const Space                          &space,
               const TrilinosWrappers::SparseMatrix &matrix,
               TrilinosWrappers::PreconditionAMG    &amg) const;

    void
    solve_assembled();

    void
    solve_matrix_free();

    template <typename VectorType>
    void
    compute_errors(const VectorType &solution);

    /// Ends a stage.
    void
    lap(const std::string &stage)
    {
      MPI_Barrier(MPI_COMM_WORLD);
      seconds.emplace_back(stage, timer.wall_time());
      timer.restart();
    }

    parallel::distributed::Triangulation<3>     triangulation;
    MappingQCache<3>                            mapping;
    const unsigned int                          degree;
    std::unique_ptr<Space>                      space;
    Timer                                       timer;
    std::vector<std::pair<std::string, double>> seconds;
    unsigned int                                iterations = 0;
    double                                      l2 = 0., energy = 0.;
  };

  void
  PlainElasticity::assemble(const Space                    &space,
                            TrilinosWrappers::SparseMatrix &matrix) const
  {
    const IndexSet        &owned = space.dof_handler.locally_owned_dofs();
    DynamicSparsityPattern pattern(space.relevant);
    DoFTools::make_sparsity_pattern(space.dof_handler,
                                    pattern,
                                    space.constraints,
                                    false);
    SparsityTools::distribute_sparsity_pattern(pattern,
                                               owned,
                                               MPI_COMM_WORLD,
                                               space.relevant);
    matrix.reinit(owned, owned, pattern, MPI_COMM_WORLD);
    pattern.reinit(0, 0);

    const auto                          &fe = space.fe;
    const unsigned                       n  = fe.n_dofs_per_cell();
    FEValues<3>                          values(mapping,
                       fe,
                       QGauss<3>(fe.degree + 1),
                       update_gradients | update_JxW_values);
    FullMatrix<double>                   local(n, n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          local = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int i = 0; i < n; ++i)
              {
                const unsigned int a = fe.system_to_component_index(i).first;
                const Tensor<1, 3> g = values.JxW(q) * values.shape_grad(i, q);
                for (unsigned int j = 0; j <= i; ++j)
                  {
                    const unsigned int b =
                      fe.system_to_component_index(j).first;
                    const Tensor<1, 3> &h = values.shape_grad(j, q);
                    local(i, j) += lame_lambda * g[a] * h[b] +
                                   lame_mu * g[b] * h[a] +
                                   (a == b ? lame_mu * (g * h) : 0.);
                  }
              }
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < i; ++j)
              local(j, i) = local(i, j);
          cell->get_dof_indices(dofs);
          space.constraints.distribute_local_to_global(local, dofs, matrix);
        }
    matrix.compress(VectorOperation::add);
  }

  template <typename VectorType>
  void
  PlainElasticity::assemble_load(VectorType &load) const
  {
    FEFaceValues<3>                      values(mapping,
                           space->fe,
                           QGauss<2>(degree + 1),
                           update_values | update_normal_vectors |
                             update_JxW_values);
    const unsigned int                   n = space->fe.n_dofs_per_cell();
    Vector<double>                       local(n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : space->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && cell->face(f)->boundary_id() == 0)
            {
              values.reinit(cell, f);
              local = 0.;
              for (const unsigned int q : values.quadrature_point_indices())
                for (unsigned int i = 0; i < n; ++i)
                  local[i] -=
                    pressure * values.JxW(q) * values.shape_value(i, q) *
                    values.normal_vector(
                      q)[space->fe.system_to_component_index(i).first];
              cell->get_dof_indices(dofs);
              space->constraints.distribute_local_to_global(local, dofs, load);
            }
    load.compress(VectorOperation::add);
  }

  /// Smoothed aggregation that knows the six rigid motions.
  void
  PlainElasticity::set_up_amg(const Space                          &space,
                              const TrilinosWrappers::SparseMatrix &matrix,
                              TrilinosWrappers::PreconditionAMG    &amg) const
  {
    std::map<types::global_dof_index, Point<3>> points;
    DoFTools::map_dofs_to_support_points(mapping, space.dof_handler, points);
    const IndexSet         &owned = space.dof_handler.locally_owned_dofs();
    const auto              n     = owned.n_elements();
    std::vector<double>     modes(6 * n);
    const std::vector<bool> all;
    std::vector<IndexSet>   components(3);
    for (unsigned int c = 0; c < 3; ++c)
      {
        ComponentMask mask(3, false);
        mask.set(c, true);
        const unsigned int d = (c + 1) % 3, e = (c + 2) % 3;
        for (const auto dof : DoFTools::extract_dofs(space.dof_handler, mask))
          {
            const auto i           = owned.index_within_set(dof);
            const auto x           = points.at(dof);
            modes[c * n + i]       = 1.;
            modes[(3 + d) * n + i] = x[e];
            modes[(3 + e) * n + i] = -x[d];
          }
      }
    TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.higher_order_elements = space.fe.degree > 1;
    data.smoother_sweeps       = 2;
    data.aggregation_threshold = 0.02;
    Teuchos::ParameterList              parameters;
    std::unique_ptr<Epetra_MultiVector> constant_modes;
    data.set_parameters(parameters, constant_modes, matrix);
    parameters.set("null space: type", "pre-computed");
    parameters.set("null space: dimension", 6);
    parameters.set("null space: vectors", modes.data());
    if (space.fe.degree <= 2) // where dofs come in threes
      parameters.set("PDE equations", 3);
    amg.initialize(matrix, parameters);
  }

  void
  PlainElasticity::solve_assembled()
  {
    using Vector          = TrilinosWrappers::MPI::Vector;
    const IndexSet &owned = space->dof_handler.locally_owned_dofs();
    TrilinosWrappers::SparseMatrix    matrix;
    TrilinosWrappers::PreconditionAMG amg;
    assemble(*space, matrix);
    Vector u(owned, MPI_COMM_WORLD), load(u);
    assemble_load(load);
    set_up_amg(*space, matrix, amg);
    lap("setup");

    ReductionControl control(1000, 0., tolerance);
    SolverCG<Vector> solver(control);
    solver.solve(matrix, u, load, amg);
    iterations = control.last_step();
    space->constraints.distribute(u);
    lap("solve");

    Vector ghosted(owned, space->relevant, MPI_COMM_WORLD);
    ghosted = u;
    compute_errors(ghosted);
    lap("postprocess");
  }

  void
  PlainElasticity::solve_matrix_free()
  {
    using Vector = LinearAlgebra::distributed::Vector<double>;
    std::vector<std::unique_ptr<Space>> coarser;
    for (unsigned int p = degree / 2; p > 0; p /= 2)
      coarser.push_back(std::make_unique<Space>(triangulation, p));
    std::vector<const Space *> levels = {space.get()};
    for (const auto &level : coarser)
      levels.push_back(level.get());
    lap("spaces");

    TrilinosWrappers::SparseMatrix    vertices;
    TrilinosWrappers::PreconditionAMG amg;
    assemble(*levels.back(), vertices);
    set_up_amg(*levels.back(), vertices, amg);
    DegreeMultigrid            multigrid(mapping, levels, amg);
    InterfaceStiffness<double> stiffness;
    stiffness.reinit(mapping, space->dof_handler, space->constraints);
    Vector u, load;
    stiffness.initialize(u);
    stiffness.initialize(load);
    assemble_load(load);
    lap("setup");

    ReductionControl control(1000, 0., tolerance);
    SolverCG<Vector> solver(control);
    solver.solve(stiffness, u, load, multigrid);
    iterations = control.last_step();
    space->constraints.distribute(u);
    lap("solve");

    Vector ghosted(space->dof_handler.locally_owned_dofs(),
                   space->relevant,
                   MPI_COMM_WORLD);
    ghosted = u;
    ghosted.update_ghost_values();
    compute_errors(ghosted);
    lap("postprocess");
  }

  /// Relative errors in L2 and energy.
  template <typename VectorType>
  void
  PlainElasticity::compute_errors(const VectorType &solution)
  {
    FEValues<3>                        values(mapping,
                       space->fe,
                       QGauss<3>(degree + 3),
                       update_values | update_gradients |
                         update_quadrature_points | update_JxW_values);
    const FEValuesExtractors::Vector   displacement(0);
    std::vector<Tensor<1, 3>>          u(values.n_quadrature_points);
    std::vector<SymmetricTensor<2, 3>> strain(values.n_quadrature_points);
    std::array<double, 4>              sums{};
    const auto twice_energy = [](const SymmetricTensor<2, 3> &e) {
      return lame_lambda * trace(e) * trace(e) + 2. * lame_mu * (e * e);
    };
    for (const auto &cell : space->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          values[displacement].get_function_values(solution, u);
          values[displacement].get_function_symmetric_gradients(solution,
                                                                strain);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const Point<3> &x       = values.quadrature_point(q);
              const auto      exact   = Exact::displacement(x);
              const auto      strains = Exact::strain(x);
              sums[0] += values.JxW(q) * (u[q] - exact).norm_square();
              sums[1] += values.JxW(q) * exact.norm_square();
              sums[2] += values.JxW(q) * twice_energy(strain[q] - strains);
              sums[3] += values.JxW(q) * twice_energy(strains);
            }
        }
    for (double &sum : sums)
      sum = Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    l2     = std::sqrt(sums[0] / sums[1]);
    energy = std::sqrt(sums[2] / sums[3]);
  }

  void
  PlainElasticity::run(const std::string &variant,
                       const unsigned int n,
                       const unsigned int m)
  {
    const Timer whole;
    make_mesh(triangulation, n, m);
    lap("mesh");
    mapping.initialize(MappingQ<3>(degree), triangulation);
    space = std::make_unique<Space>(triangulation, degree);
    if (variant == "assembled")
      {
        lap("spaces");
        solve_assembled();
      }
    else
      solve_matrix_free();

    Utilities::System::MemoryStats stats;
    Utilities::System::get_memory_stats(stats);
    const double memory =
      Utilities::MPI::sum(stats.VmHWM / 1024., MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    std::cout << "{\"dofs\": " << space->dof_handler.n_dofs()
              << ", \"iterations\": " << iterations
              << ", \"displacement_l2\": " << std::setprecision(12) << l2
              << ", \"energy\": " << energy
              << ", \"peak_sum_over_ranks\": " << memory
              << ", \"timings_s\": {\"total\": " << whole.wall_time();
    for (const auto &[stage, time] : seconds)
      std::cout << ", \"" << stage << "\": " << time;
    std::cout << "}}" << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 5)
    {
      std::cerr
        << "usage: plain_elasticity assembled|matrix_free DEGREE AROUND RADIAL\n";
      return 2;
    }
  PlainElasticity(std::atoi(argv[2]))
    .run(argv[1], std::atoi(argv[3]), std::atoi(argv[4]));
}
