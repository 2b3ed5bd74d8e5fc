// Products with the stiffness without a matrix. Not a test: it serves
// bulk_operator.py.
//
//   bulk_operator [DOFS]
//
// prints, for curved and straight cells of both shapes and each degree, million
// dofs per second and core in double and single precision, and what the core
// can do: Gflop/s of multiplications and additions in registers, and GB/s of
// a[i] = b[i] + s c[i] on as many bytes as a product of degree 4 on curved
// cells reads and writes and on those of its workspace, and the bytes of a
// register. Run it under mpirun to see all cores at once.
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/operators/matrix_free/matrix_free_elasticity.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "timing.h"

using namespace mortise;

namespace
{
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

  template <typename Number>
  double
  peak_gflops()
  {
    using V                        = typename Batch<Number>::Vector;
    constexpr unsigned int n_sums  = 12; // hides the latency, fits 16 registers
    constexpr unsigned int n_turns = 10000000;
    V                      a = {}, b = {};
    for (unsigned int l = 0; l < Batch<Number>::size; ++l)
      {
        a[l] = Number(0.999);
        b[l] = Number(0.001);
      }
    Number       total = 0;
    const double time  = median_time([&]() {
      V local[n_sums]; // in registers
      for (unsigned int i = 0; i < n_sums; ++i)
        local[i] = b * Number(1 + i); // equal ones would be computed once
      for (unsigned int turn = 0; turn < n_turns; ++turn)
#pragma GCC unroll 16
        for (unsigned int i = 0; i < n_sums; ++i)
          local[i] = a * local[i] + b;
      for (const V &sum : local)
        total += sum[0];
    });
    AssertThrow(total > 0,
                dealii::ExcInternalError()); // so that it is computed
    return 2. * n_sums * Batch<Number>::size * n_turns / time / 1e9;
  }

  double
  triad_bandwidth(const double bytes)
  {
    const std::size_t   n       = bytes / 3. / sizeof(double);
    const unsigned int  n_turns = std::max(1., 1e8 / bytes);
    std::vector<double> a(n), b(n, 1.), c(n, 2.);
    const double        time = median_time([&]() {
      for (unsigned int turn = 0; turn < n_turns; ++turn)
        {
          for (std::size_t i = 0; i < n; ++i)
            a[i] = b[i] + 3. * c[i];
          std::swap(a, b); // each turn needs the one before
        }
    });
    AssertThrow(b[n / 2] > 0., dealii::ExcInternalError());
    return 3. * n * sizeof(double) * n_turns / time / 1e9;
  }

  void
  report(const std::string &source,
         const std::string &cells,
         const unsigned int p,
         const double       n_dofs)
  {
    Body           body("body", 0, LinearElastic{1., 0.3});
    MeshParameters mesh;
    mesh.source = source;
    mesh.cells  = cells;
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
      std::cout << std::setw(28) << source + ", " + cells << std::setw(4) << p
                << std::setw(10) << 3 * space.owned_nodes().size() << std::fixed
                << std::setprecision(1) << std::setw(10) << in_double
                << std::setw(10) << in_float << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const double n_dofs = argc > 1 ? std::atof(argv[1]) : 3e5;
  for (const std::string cells : {"hexahedra", "tetrahedra"})
    for (const std::string source : {"shell octant", "box"})
      for (unsigned int p = 1; p <= max_degree; ++p)
        report(source, cells, p, n_dofs);
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  // of a batch of cells of degree 4: twelve arrays of numbers at their points
  const double workspace = 12. * 125. * register_width;
  const double peaks[]   = {peak_gflops<double>(),
                            peak_gflops<float>(),
                            triad_bandwidth(73. * n_dofs / n_ranks),
                            triad_bandwidth(workspace)};
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << "peak 0 0 " << peaks[0] << ' ' << peaks[1] << " triad "
              << peaks[2] << " caches " << peaks[3] << " registers "
              << register_width << std::endl;
}
