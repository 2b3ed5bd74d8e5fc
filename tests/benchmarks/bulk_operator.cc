// Products with the stiffness of hexahedra without a matrix. Not a test: it
// serves bulk_operator.py.
//
//   bulk_operator [DOFS]
//
// prints, for curved and straight cells of each degree, million dofs per second
// and core in double and single precision. Run it under mpirun to see all cores
// at once.
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/operators/matrix_free_elasticity.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>

using namespace mortise;

namespace
{
  double
  seconds()
  {
    return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }

  /// Median of the seconds of @p task over some runs.
  template <typename Task>
  double
  median_time(const Task &task)
  {
    std::vector<double> times;
    for (unsigned int run = 0; run < 9; ++run)
      {
        const double start = seconds();
        task();
        times.push_back(seconds() - start);
      }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  }

  template <typename Number>
  double
  rate(const NodalSpace &space)
  {
    const auto layout =
      std::make_shared<const dealii::Utilities::MPI::Partitioner>(
        displacement_indices(space.owned_nodes()),
        displacement_indices(space.relevant_nodes()),
        MPI_COMM_WORLD);
    const MatrixFreeElasticity<Number> stiffness(space, *layout);
    dealii::LinearAlgebra::distributed::Vector<Number> u(layout), v(layout);
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      u.local_element(i) = std::sin(1. + i);
    u.update_ghost_values();
    const double time = median_time([&]() {
      v = 0.;
      stiffness.add_product(u.begin(), v.begin());
    });
    return u.locally_owned_size() / time / 1e6;
  }

  void
  report(const std::string &source, const unsigned int p, const double n_dofs)
  {
    Body           body("body", 0, {1., 0.3});
    MeshParameters mesh;
    mesh.source = source;
    unsigned int n =
      std::max(1.,
               std::round(
                 std::cbrt(n_dofs / 3. / (source == "box" ? 1. : 1.5)) / p));
    if (source == "box")
      {
        mesh.extent       = {0., 0., 0., 1., 1., 1.};
        mesh.subdivisions = {n, n, n};
      }
    else
      {
        mesh.extent       = {1., 2.};
        mesh.subdivisions = {n, std::max(1U, n / 2)};
      }
    body.create_mesh(mesh, MPI_COMM_WORLD, "");
    body.create_space(p, {}, "");
    const NodalSpace space(
      {&body},
      [](const Body &, const unsigned int degree) { return degree; },
      MPI_COMM_WORLD);
    const double in_double = rate<double>(space), in_float = rate<float>(space);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << std::setw(14) << source << std::setw(4) << p << std::setw(10)
                << 3 * space.owned_nodes().size() << std::fixed
                << std::setprecision(1) << std::setw(10) << in_double
                << std::setw(10) << in_float << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const double n_dofs = argc > 1 ? std::atof(argv[1]) : 3e5;
  for (const std::string source : {"shell octant", "box"})
    for (unsigned int p = 1; p <= max_degree; ++p)
      report(source, p, n_dofs);
}
