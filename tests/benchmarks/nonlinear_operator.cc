// Products with tangents and residuals of nonlinear laws beside products with
// Hooke's law. Not a test: it serves nonlinear.py.
//
//   nonlinear_operator [DOFS]
//
// prints, for curved hexahedra and tetrahedra of each degree from 2 to 6, the
// time of a product with Hooke's law, in nanoseconds per displacement and core,
// and beside it the ratios of the product with the tangent in double and single
// precision, of the residual, and of the linearisation (with that of the coarse
// levels), for laws of each form.
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/material/factory.h>
#include <mortise/operators/matrix_free/matrix_free_elasticity.h>

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
  using LayoutVector = dealii::LinearAlgebra::distributed::Vector<Number>;

  struct Scene
  {
    Scene(const std::string &cells,
          const unsigned int p,
          const double       n_dofs,
          const Material    &material)
      : body("body", 0, material)
    {
      MeshParameters mesh;
      mesh.source = "shell octant";
      mesh.cells  = cells;
      mesh.extent = {1., 2.};
      const unsigned int n =
        std::max(1., std::round(std::cbrt(n_dofs / 3. / 1.5) / p));
      mesh.subdivisions = {n, (n + 1) / 2};
      body.create_mesh(mesh, MPI_COMM_WORLD, "");
      body.create_space(p, {}, "");
      space = std::make_unique<NodalSpace>(
        std::vector<const Body *>{&body},
        [](const Body &, const unsigned int degree) { return degree; },
        MPI_COMM_WORLD);
      layout = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
        displacement_indices(space->owned_nodes()),
        displacement_indices(space->relevant_nodes()),
        MPI_COMM_WORLD);
    }

    /// Small enough for all laws.
    template <typename Number>
    LayoutVector<Number>
    field() const
    {
      LayoutVector<Number> u(layout);
      for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
        u.local_element(i) = 1e-3 * std::sin(1. + i);
      u.update_ghost_values();
      return u;
    }

    Body                                                       body;
    std::unique_ptr<NodalSpace>                                space;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
  };

  template <typename Number>
  double
  product_time(const Scene                        &scene,
               const MatrixFreeElasticity<Number> &stiffness)
  {
    const auto           u = scene.field<Number>();
    LayoutVector<Number> v(scene.layout);
    return median_time([&]() {
      v = 0.;
      stiffness.add_product(u.begin(), v.begin());
    });
  }

  Material
  material(const std::string &law)
  {
    MaterialParameters given;
    given.law           = law;
    given.young_modulus = 1.;
    if (law == "Mooney-Rivlin")
      {
        given.young_modulus.reset();
        given.c10 = 0.15;
        given.c01 = 0.05;
      }
    else if (law == "J2 plasticity")
      given.hardening.yield_stress = 0.01;
    else if (law == "J2, finite")
      {
        given.law                    = "J2 plasticity";
        given.strain                 = StrainMeasure::finite;
        given.hardening.yield_stress = 0.01;
      }
    else if (law == "Hencky")
      {
        given.law    = "linear elastic";
        given.strain = StrainMeasure::finite;
      }
    return make_material(given, false, [](const std::string &name) {
      return name;
    });
  }

  void
  report(const std::string &cells,
         const unsigned int p,
         const double       n_dofs,
         const std::string &law)
  {
    const Scene linear(cells, p, n_dofs, LinearElastic{1., 0.3}),
      scene(cells, p, n_dofs, material(law));
    const MatrixFreeElasticity<double> hooke(*linear.space, *linear.layout);
    const MatrixFreeElasticity<float>  single(*linear.space, *linear.layout);
    MatrixFreeElasticity<double>       K(*scene.space, *scene.layout);
    MatrixFreeElasticity<float>        level(*scene.space, *scene.layout);
    const double                       time = product_time(linear, hooke);

    auto                 u = scene.field<double>();
    LayoutVector<double> f(scene.layout);
    const auto           before    = K.no_history();
    auto                 after     = before;
    const double         residual  = median_time([&]() {
      f = 0.;
      K.add_residual({u.begin(), nullptr}, before, after, {f.begin(), nullptr});
    });
    const double         linearise = median_time([&]() {
      K.linearise({u.begin(), nullptr}, before);
    });
    const double         levels = median_time([&]() { level.take_tangent(K); });
    std::cout << cells << " " << p << " " << u.size() << " " << law << " "
              << time / u.locally_owned_size() * 1e9 << " "
              << product_time(scene, K) / time << " "
              << product_time(scene, level) / product_time(linear, single)
              << " " << residual / time << " " << linearise / time << " "
              << levels / time << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const double n_dofs = argc > 1 ? std::atof(argv[1]) : 3e5;
  std::cout << std::setprecision(3);
  for (const std::string cells : {"hexahedra", "tetrahedra"})
    for (const std::string law : {"neo-Hookean",
                                  "Mooney-Rivlin",
                                  "Hencky",
                                  "J2 plasticity",
                                  "J2, finite"})
      for (const unsigned int p : {2, 3, 4, 5, 6})
        report(cells, p, n_dofs, law);
}
