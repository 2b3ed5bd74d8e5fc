// Proves the seam of laws that are not linear, on affine and curved hexahedra
// and tetrahedra: Hooke's and an orthotropic law give the internal force, the
// product and the diagonal of the kernels for linear laws; of a law that is
// cubic in the strain and hardens, the product with the tangent is the
// derivative of the internal force by differences, which are exact for it, and
// symmetric, and the matrices of cells and the diagonal are those of the
// product; histories belong to their points. At finite strain the product is
// the derivative of the internal force too, and an initial stress that goes on
// linearly from another state is right to first order. The same on every number
// of ranks.
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/material/invariant_laws.h>
#include <mortise/operators/boundary_nodes.h>
#include <mortise/operators/matrix_free/matrix_free_elasticity.h>

#include <cmath>

#include "../scenes/scene.h"

namespace mortise::testing
{
  using namespace dealii;

  using Law = NonlinearLaw;
  using V   = Law::V;

  /// Hooke's.
  class LinearLaw : public Law
  {
  public:
    explicit LinearLaw(const LinearElastic &small)
      : law(small.law<double>())
    {}

    TangentForm
    form() const override
    {
      return TangentForm::rank_one;
    }

    void
    stress(const V (&h)[3][3], const V *, V *, V (&s)[3][3]) const override
    {
      law.stress(h, s);
    }

    void
    tangent(const V (&)[3][3], const V *, V *moduli) const override
    {
      std::fill_n(moduli, n_moduli(form()), V{});
      moduli[0] = V{} + law.mu;
      moduli[1] = V{} + law.lambda;
    }

  private:
    const IsotropicLaw<double> law;
  };

  /// s = lambda tr(e) I + 2 (1 + beta e:e + alpha) e with the strain e, after
  /// which alpha is larger by e:e; beta <= 0.
  class CubicLaw : public Law
  {
  public:
    explicit CubicLaw(const double beta)
      : beta(beta)
    {}

    TangentForm
    form() const override
    {
      return TangentForm::rank_one;
    }

    unsigned int
    n_history() const override
    {
      return 1;
    }

    void
    stress(const V (&h)[3][3],
           const V *before,
           V       *after,
           V (&s)[3][3]) const override
    {
      V e[3][3], square = {};
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          {
            e[c][d] = (h[c][d] + h[d][c]) / 2.;
            square += e[c][d] * e[c][d];
          }
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          s[c][d] = 2. * (1. + beta * square + before[0]) * e[c][d];
      for (unsigned int c = 0; c < 3; ++c)
        s[c][c] += lambda * (h[0][0] + h[1][1] + h[2][2]);
      after[0] = before[0] + square;
    }

    void
    tangent(const V (&h)[3][3], const V *before, V *moduli) const override
    {
      const V e[6]   = {h[0][0],
                        h[1][1],
                        h[2][2],
                        (h[1][2] + h[2][1]) / 2.,
                        (h[2][0] + h[0][2]) / 2.,
                        (h[0][1] + h[1][0]) / 2.};
      V       square = {};
      for (unsigned int i = 0; i < 6; ++i)
        square += (i < 3 ? 1. : 2.) * e[i] * e[i];
      moduli[0] = 1. + beta * square + before[0];
      moduli[1] = V{} + lambda;
      for (unsigned int i = 0; i < 6; ++i)
        moduli[2 + i] = 2. * std::sqrt(-beta) * e[i];
    }

  private:
    static constexpr double lambda = 1.5;
    const double            beta;
  };

  using Field = LinearAlgebra::distributed::Vector<double>;

  struct Scene
  {
    Scene(const std::string &kind, const unsigned int degree, const Material &m)
      : body("body", 0, m)
    {
      MeshParameters mesh;
      if (kind.find("tetrahedra") != std::string::npos)
        mesh.cells = "tetrahedra";
      if (kind.find("curved") == 0)
        {
          mesh.source       = "shell octant";
          mesh.extent       = {1., 2.};
          mesh.subdivisions = {1, 1};
        }
      else
        {
          mesh.source       = "box";
          mesh.extent       = {0., 0., 0., 1., 2., 3.};
          mesh.subdivisions = {3, 1, 1};
          mesh.rotate       = {{20., 30., 40.}};
        }
      body.create_mesh(mesh, MPI_COMM_WORLD, "");
      body.create_space(degree, {}, "");
      space = std::make_unique<NodalSpace>(
        std::vector<const Body *>{&body},
        [](const Body &, const unsigned int p) { return p; },
        MPI_COMM_WORLD);
      layout = std::make_shared<const Utilities::MPI::Partitioner>(
        displacement_indices(space->owned_nodes()),
        displacement_indices(space->relevant_nodes()),
        MPI_COMM_WORLD);
    }

    MatrixFreeElasticity<double>
    stiffness() const
    {
      return {*space, *layout};
    }

    Field
    random_field(const unsigned int seed) const
    {
      Field result(layout);
      for (const auto i : layout->locally_owned_range())
        {
          const double x =
            std::sin(12.9898 * (i + 1.) + 78.233 * seed) * 43758.5;
          result(i) = 0.1 * (x - std::floor(x) - 0.5);
        }
      result.update_ghost_values();
      return result;
    }

    Body                                               body;
    std::unique_ptr<NodalSpace>                        space;
    std::shared_ptr<const Utilities::MPI::Partitioner> layout;
  };

  using Operator = MatrixFreeElasticity<double>;
  using History  = PointHistory;

  template <typename Add>
  Field
  sum_of(const Scene &scene, const Add &add)
  {
    Field result(scene.layout);
    add(result.begin());
    result.compress(VectorOperation::add);
    return result;
  }

  Field
  product(const Scene &scene, const Operator &K, const Field &u)
  {
    return sum_of(scene, [&](double *dst) { K.add_product(u.begin(), dst); });
  }

  Field
  diagonal(const Scene &scene, const Operator &K)
  {
    return sum_of(scene, [&](double *dst) { K.add_diagonal(dst); });
  }

  struct Response
  {
    Field   force;
    History after;
  };

  Response
  respond(const Scene    &scene,
          const Operator &K,
          const Field    &u,
          const History  &before)
  {
    History after = before;
    Field   force = sum_of(scene, [&](double *dst) {
      K.add_residual({const_cast<double *>(u.begin()), nullptr},
                     before,
                     after,
                       {dst, nullptr});
    });
    return {force, after};
  }

  double
  difference(Field a, const Field &b)
  {
    a.zero_out_ghost_values();
    a -= b;
    return a.l2_norm() / b.l2_norm();
  }

  void
  check_hooke(const std::string &name,
              const std::string &kind,
              const unsigned int p)
  {
    const LinearElastic hooke{2., 0.3};
    const Scene         scene(kind, p, hooke);
    const Scene         same(
      kind, p, Material(LinearElastic(), std::make_shared<LinearLaw>(hooke)));
    const Field    u      = scene.random_field(1);
    const Operator linear = scene.stiffness();
    Operator       K      = same.stiffness();
    const History  none   = K.no_history();
    K.linearise({const_cast<double *>(u.begin()), nullptr}, none);
    const Field expected = product(scene, linear, u);
    verdict(name + ", force",
            difference(respond(scene, K, u, none).force, expected),
            1e-12);
    verdict(name + ", product",
            difference(product(scene, K, u), expected),
            1e-12);
    verdict(name + ", diagonal",
            difference(diagonal(scene, K), diagonal(scene, linear)),
            1e-12);
  }

  void
  check_linear(const std::string &name,
               const std::string &kind,
               const unsigned int p,
               const Material    &material)
  {
    const Scene    scene(kind, p, material);
    const Field    u      = scene.random_field(1);
    const Operator linear = scene.stiffness();
    verdict(name + ", force by the linear kernel",
            difference(respond(scene, linear, u, linear.no_history()).force,
                       product(scene, linear, u)),
            1e-15);
  }

  Field
  scaled(Field a, const double factor)
  {
    a.zero_out_ghost_values();
    a *= factor;
    a.update_ghost_values();
    return a;
  }

  Field
  sum(Field a, const Field &b)
  {
    a.zero_out_ghost_values();
    a += b;
    a.update_ghost_values();
    return a;
  }

  /// df(u)/du w, exact for forces that are cubic in u.
  Field
  derivative(const Scene    &scene,
             const Operator &K,
             const Field    &u,
             const Field    &w,
             const History  &before)
  {
    const auto central = [&](const double step) {
      Field result = respond(scene, K, sum(u, scaled(w, step)), before).force;
      result -= respond(scene, K, sum(u, scaled(w, -step)), before).force;
      result /= 2. * step;
      return result;
    };
    Field result = central(0.5);
    result *= 4. / 3.;
    result.add(-1. / 3., central(1.));
    return result;
  }

  Operator::Fields
  fields(const Field &of) // only read
  {
    return {const_cast<double *>(of.begin()), nullptr};
  }

  struct Directions
  {
    const Field &u, &v, &w;
  };

  /// Linearises @p K at u and returns K w, which must be the derivative of the
  /// force and symmetric.
  Field
  check_tangent(const std::string &name,
                const Scene       &scene,
                Operator          &K,
                const Directions  &at,
                const History     &before,
                const double       allowed)
  {
    K.linearise(fields(at.u), before);
    const Field of_w = product(scene, K, at.w), of_v = product(scene, K, at.v);
    verdict(name + ", tangent by differences",
            difference(derivative(scene, K, at.u, at.w, before), of_w),
            allowed);
    verdict(name + ", tangent symmetric",
            std::fabs(of_w * at.v / (of_v * at.w) - 1.),
            1e-10);
    return of_w;
  }

  /// w.Kw by the matrices of cells.
  double
  by_matrices(const Operator &K, const Field &w)
  {
    double sum = 0.;
    K.for_each_cell_matrix([](const Operator::Cell &) { return true; },
                           [&](const Operator::Cell       &cell,
                               const Operator::CellMatrix &matrix) {
                             const auto &at = cell.displacements;
                             for (unsigned int i = 0; i < at.size(); ++i)
                               for (unsigned int j = 0; j < at.size(); ++j)
                                 sum += w.local_element(at[i]) *
                                        matrix.mixed(i, j) *
                                        w.local_element(at[j]);
                           });
    return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  void
  check_cubic(const std::string &name,
              const std::string &kind,
              const unsigned int p)
  {
    const auto law = [](const double beta) {
      return Material(LinearElastic(), std::make_shared<CubicLaw>(beta));
    };
    const Scene scene(kind, p, law(-2.)), other(kind, p, law(-1.));
    const Field u = scene.random_field(1), v = scene.random_field(2),
                w = scene.random_field(3);
    Operator K    = scene.stiffness();
    // the strains of another field, at the same points
    const History before = respond(scene, K, v, K.no_history()).after;
    const Field of_w = check_tangent(name, scene, K, {u, v, w}, before, 1e-11);
    verdict(name + ", matrices of cells",
            std::fabs(by_matrices(K, w) / (of_w * w) - 1.),
            1e-11);
    const Field of_u  = diagonal(scene, K);
    double      worst = 0.;
    for (types::global_dof_index i = 0; i < of_u.size();
         i += of_u.size() / 7 + 1)
      {
        Field unit(scene.layout);
        if (unit.in_local_range(i))
          unit(i) = 1.;
        unit.update_ghost_values();
        const Field column = product(scene, K, unit);
        if (unit.in_local_range(i))
          worst = std::max(worst, std::fabs(column(i) / of_u(i) - 1.));
      }
    verdict(name + ", diagonal",
            Utilities::MPI::max(worst, MPI_COMM_WORLD),
            1e-11);
    // hardening by the strain of the same points adds to beta
    const Operator more = other.stiffness();
    const History  own  = respond(scene, K, u, K.no_history()).after;
    verdict(name + ", history",
            difference(respond(scene, K, u, own).force,
                       respond(scene, more, u, more.no_history()).force),
            1e-13);
  }

  /// w.Kw in single precision, as preconditioners multiply, beside the exact
  /// one.
  double
  single_energy(const Scene &scene, const Operator &K, const Field &w)
  {
    using Single = LinearAlgebra::distributed::Vector<float>;
    MatrixFreeElasticity<float> level(*scene.space, *scene.layout);
    level.take_tangent(K);
    Single u(scene.layout), of_u(scene.layout);
    u = w;
    u.update_ghost_values();
    level.add_product(u.begin(), of_u.begin());
    of_u.compress(VectorOperation::add);
    u.zero_out_ghost_values();
    return of_u * u / (product(scene, K, w) * w);
  }

  /// A deformation without change of volume must not feel what few digits leave
  /// of the volumetric modulus.
  void
  check_few_digits(const std::string &name,
                   const std::string &kind,
                   const unsigned int p)
  {
    const Scene scene(kind,
                      p,
                      Material(LinearElastic(),
                               std::make_shared<StVenantKirchhoff>(1e4, 1.)));
    Operator    K = scene.stiffness();
    K.linearise(fields(Field(scene.layout)), K.no_history());
    MultigridLevel level;
    level.space  = {std::shared_ptr<void>(), scene.space.get()};
    level.layout = scene.layout;
    Field all(scene.layout);
    all           = 1.;
    const Field x = node_positions(level, scene.body, all);
    Field       w(scene.layout);
    for (unsigned int i = 0; i < x.locally_owned_size(); i += dim)
      {
        const double xi = x.local_element(i), eta = x.local_element(i + 1),
                     zeta      = x.local_element(i + 2);
        w.local_element(i)     = xi + 2. * eta;
        w.local_element(i + 1) = eta - zeta;
        w.local_element(i + 2) = xi - 2. * zeta;
      }
    w.update_ghost_values();
    verdict(name, std::fabs(single_energy(scene, K, w) - 1.), 0.01);
  }

  void
  check_finite(const std::string                  &name,
               const std::string                  &kind,
               const unsigned int                  p,
               const std::shared_ptr<NonlinearLaw> law)
  {
    const Scene  scene(kind, p, Material(LinearElastic(), law));
    const double strain = 0.1 / (p * p); // by the random values of nodes
    const Field  u      = scaled(scene.random_field(1), strain),
                v       = scene.random_field(2),
                w       = scaled(scene.random_field(3), 1e-3 * strain),
                d       = scaled(scene.random_field(4), strain);
    Operator      K     = scene.stiffness();
    const History none  = K.no_history();
    // tangents are kept in single precision
    const double single = 2e-7;
    const Field  of_w = check_tangent(name, scene, K, {u, v, w}, none, single);
    // the linear change of the stress is exact to first order
    const auto change = [&](const double length) {
      const Field from = sum(u, scaled(d, length));
      K.linearise(fields(from), none);
      K.linearise(fields(u), none, {}, fields(from));
      return difference(product(scene, K, w), of_w);
    };
    verdict(name + ", from the same state", change(0.), single);
    const double whole = change(4e-2), half = change(2e-2);
    verdict(name + ", of second order", std::fabs(whole / half - 4.), 0.05);
  }
} // namespace mortise::testing

int
main(int argc, char **argv)
{
  using namespace mortise::testing;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const mortise::Orthotropic               wood{{{10., 1., 0.5}},
                                                {{0.35, 0.6, 0.02}},
                                                {{0.7, 0.05, 0.8}},
                                                {{20., -35., 70.}}};
  for (const std::string kind : {"affine hexahedra",
                                 "curved hexahedra",
                                 "affine tetrahedra",
                                 "curved tetrahedra"})
    for (const unsigned int p : {1, 2, 3, 6})
      {
        const std::string name = kind + ", p = " + std::to_string(p) + ": ";
        check_hooke(name + "Hooke", kind, p);
        check_linear(name + "Hooke", kind, p, mortise::LinearElastic{2., 0.3});
        check_linear(name + "orthotropic", kind, p, wood);
        check_cubic(name + "cubic", kind, p);
        check_few_digits(name + "nearly incompressible, single precision",
                         kind,
                         p);
        check_finite(name + "neo-Hookean",
                     kind,
                     p,
                     std::make_shared<mortise::NeoHookean>(1.5, 1.));
        check_finite(name + "St. Venant-Kirchhoff",
                     kind,
                     p,
                     std::make_shared<mortise::StVenantKirchhoff>(1.5, 1.));
      }
}
