// Proves what laws that are not linear do at points: stresses of simple shear
// to ten digits, tangents against differences of the nominal stress at random
// states of three sizes, symmetry, no stress after rotations by any angle, in
// mixed form the same stresses with the pressure that belongs to the
// deformation, radial return onto the yield surface, and the mathematics below
// them: logarithms, exponentials, eigensystems, also of equal eigenvalues.
#include <mortise/base/rigid_motion.h>
#include <mortise/material/factory.h>
#include <mortise/material/invariant_laws.h>
#include <mortise/material/kinematics.h>
#include <mortise/material/voigt.h>
#include <verdict.h>

#include <cmath>
#include <random>

using namespace mortise;
using V = DoubleBatch;

namespace
{
  constexpr unsigned int width = Batch<double>::size, n_history = 7;

  std::mt19937 generator(5);

  double
  any()
  {
    return std::uniform_real_distribution<>(-1., 1.)(generator);
  }

  V
  any_batch(const double size)
  {
    V result;
    for (unsigned int l = 0; l < width; ++l)
      result[l] = size * any();
    return result;
  }

  struct Matrix
  {
    V a[3][3] = {};
  };

  Matrix
  any_matrix(const double size)
  {
    Matrix result;
    for (auto &row : result.a)
      for (V &entry : row)
        entry = any_batch(size);
    return result;
  }

  double
  largest(const V &x)
  {
    double result = 0.;
    for (unsigned int l = 0; l < width; ++l)
      if (!(std::fabs(x[l]) <= result)) // also what is no number
        result = std::fabs(x[l]);
    return result;
  }

  struct History
  {
    V numbers[n_history] = {};
  };

  Matrix
  stress(const NonlinearLaw &law, const Matrix &h, const History &before)
  {
    Matrix tau;
    law.stress(h.a, before.numbers, nullptr, tau.a);
    return tau;
  }

  /// tau F^{-T}, or the stress at small strain.
  Matrix
  nominal(const NonlinearLaw &law, const Matrix &s, const Matrix &h)
  {
    if (!is_finite(law.form()))
      return s;
    V inverse[3][3];
    invert_gradient(h.a, V(1. + dilatation(h.a)), inverse);
    Matrix P;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          P.a[i][j] += s.a[i][k] * inverse[j][k];
    return P;
  }

  template <TangentForm form>
  Matrix
  product(const V *data, const Matrix &h)
  {
    Matrix s;
    TangentAt<double, form>{data}.tangent(0, h.a, s.a);
    return s;
  }

  /// dP in the direction @p w by the tangent.
  Matrix
  tangent_product(const NonlinearLaw &law,
                  const Matrix       &h,
                  const Matrix       &w,
                  const History      &before)
  {
    V data[27];
    law.tangent(h.a, before.numbers, data);
    if (law.form() == TangentForm::rank_one)
      return product<TangentForm::rank_one>(data, w);
    const Matrix tau = stress(law, h, before);
    for (unsigned int k = 0; k < 6; ++k)
      data[n_moduli(law.form()) + k] =
        tau.a[voigt_pairs[k][0]][voigt_pairs[k][1]];
    V inverse[3][3];
    invert_gradient(h.a, V(1. + dilatation(h.a)), inverse);
    Matrix spatial;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          spatial.a[i][j] += w.a[i][k] * inverse[k][j];
    return nominal(law,
                   law.form() == TangentForm::full_finite ?
                     product<TangentForm::full_finite>(data, spatial) :
                     product<TangentForm::isotropic_finite>(data, spatial),
                   h);
  }

  /// The same by differences of the fourth order.
  Matrix
  difference_product(const NonlinearLaw &law,
                     const Matrix       &h,
                     const Matrix       &w,
                     const History      &before,
                     const double        step)
  {
    Matrix sum;
    for (const auto &[at, weight] : {std::pair(1., 2. / 3.),
                                     std::pair(-1., -2. / 3.),
                                     std::pair(2., -1. / 12.),
                                     std::pair(-2., 1. / 12.)})
      {
        Matrix moved = h;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            moved.a[i][j] += at * step * w.a[i][j];
        const Matrix P = nominal(law, stress(law, moved, before), moved);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            sum.a[i][j] += weight / step * P.a[i][j];
      }
    return sum;
  }

  V
  product(const Matrix &a, const Matrix &b)
  {
    V sum = {};
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        sum += a.a[i][j] * b.a[i][j];
    return sum;
  }

  double
  relative_difference(const Matrix &a, const Matrix &b)
  {
    Matrix d;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        d.a[i][j] = a.a[i][j] - b.a[i][j];
    return std::sqrt(largest(product(d, d) / product(b, b)));
  }

  /// Plastic strains without change of volume, and hardening.
  History
  any_history()
  {
    History result;
    for (V &number : result.numbers)
      number = any_batch(0.02);
    result.numbers[2] = -result.numbers[0] - result.numbers[1];
    result.numbers[6] *= result.numbers[6];
    return result;
  }

  std::shared_ptr<const NonlinearLaw>
  make(const std::string &name,
       const bool         mixed  = false,
       const double       nu     = 0.3,
       const bool         finite = true)
  {
    const double       mu = 10. / (2. * (1. + nu));
    MaterialParameters given;
    given.law           = name;
    given.poisson_ratio = nu;
    if (finite && (name == "linear elastic" || name == "J2 plasticity"))
      given.strain = StrainMeasure::finite;
    if (name == "Mooney-Rivlin")
      {
        given.c10 = 0.4 * mu;
        given.c01 = 0.1 * mu;
      }
    else if (name == "Ogden")
      given.ogden_terms = {{1.6 * mu / 1.3, 1.3}, {0.4 * mu / -2., -2.}};
    else
      given.young_modulus = 10.;
    if (name == "J2 plasticity")
      {
        given.hardening.yield_stress        = 0.3;
        given.hardening.modulus             = 0.5;
        given.hardening.saturation_stress   = 0.6;
        given.hardening.saturation_exponent = 4.;
        given.hardening.kinematic_modulus   = 0.2;
      }
    return make_material(given,
                         mixed,
                         [](const std::string &where) { return where; })
      .nonlinear();
  }

  void
  check_tangent(const std::string &name, const NonlinearLaw &law)
  {
    // of the strain below its bound differences are less exact, since those of
    // the stress are beside a modulus of ten
    for (const auto &[size, allowed] :
         {std::pair(1e-3, 1e-8), std::pair(0.1, 1e-9), std::pair(0.3, 1e-9)})
      {
        double tangent = 0., symmetry = 0.;
        for (unsigned int k = 0; k < 10; ++k)
          {
            const Matrix h = any_matrix(size), w = any_matrix(1.),
                         v = any_matrix(1.);
            const History before =
              law.n_history() > 0 ? any_history() : History();
            const Matrix of_w = tangent_product(law, h, w, before);
            tangent =
              std::max(tangent,
                       relative_difference(
                         difference_product(law, h, w, before, 1e-5), of_w));
            const V there = product(of_w, v),
                    back  = product(tangent_product(law, h, v, before), w);
            symmetry      = std::max(symmetry, largest((there - back) / 100.));
          }
        const std::string where = name + ", gradients of " +
                                  (size < 0.01 ? "0.001" :
                                   size < 0.2  ? "0.1" :
                                                 "0.3");
        verdict(where + ": tangent by differences", tangent, allowed);
        verdict(where + ": tangent symmetric", symmetry, 1e-12);
      }
  }

  void
  check_shear(const std::string           &name,
              const NonlinearLaw          &law,
              const std::array<double, 4> &expected)
  {
    Matrix h;
    h.a[0][1]        = V{} + 0.8;
    const Matrix tau = stress(law, h, {});
    const V found[4] = {tau.a[0][1], tau.a[0][0], tau.a[1][1], tau.a[2][2]};
    double  error    = 0.;
    for (unsigned int i = 0; i < 4; ++i)
      error = std::max(error, largest(found[i] - expected[i]));
    verdict(name + ": simple shear by 0.8, all components", error, 1e-9);
  }

  /// The work of a closed cycle of gradients through a random plane of them;
  /// the trapezoidal rule is exact to rounding, since the cycle is smooth.
  void
  check_cycle(const std::string &name, const NonlinearLaw &law)
  {
    constexpr unsigned int n     = 128;
    double                 worst = 0.;
    for (unsigned int k = 0; k < 5; ++k)
      {
        const Matrix a = any_matrix(0.15), b = any_matrix(0.15);
        V            work = {}, size = {};
        for (unsigned int step = 0; step < n; ++step)
          {
            const double angle = 2. * dealii::numbers::PI * step / n,
                         c = std::cos(angle), s = std::sin(angle);
            Matrix h, rate;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                {
                  h.a[i][j]    = s * a.a[i][j] + (1. - c) * b.a[i][j];
                  rate.a[i][j] = c * a.a[i][j] + s * b.a[i][j];
                }
            const V power =
              product(nominal(law, stress(law, h, {}), h), rate) / double(n);
            work += power;
            size += fabs(power);
          }
        worst = std::max(worst, largest(work / size));
      }
    verdict(name + ": work of a closed cycle", worst, 1e-10);
  }

  void
  check_rotations(const std::string &name, const NonlinearLaw &law)
  {
    double worst = 0.;
    for (const double angle : {1e-6, 1., 90., 135., 180.})
      {
        const auto R =
          RigidMotion({{angle, 0.3 * angle, -0.5 * angle}}, {}).rotation;
        Matrix h;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            h.a[i][j] = V{} + (R[i][j] - (i == j ? 1. : 0.));
        const Matrix tau = stress(law, h, {});
        for (const auto &row : tau.a)
          for (const V &entry : row)
            worst = std::max(worst, largest(entry));
      }
    verdict(name + ": rotations without stress", worst, 1e-13);
  }

  /// Mooney and Rivlin's law is that of Ogden with the exponents 2 and -2.
  void
  check_invariants()
  {
    const double mu = 10. / 2.6;
    for (const bool mixed : {false, true})
      {
        const LinearElastic small{10., 0.3, mixed};
        const VolumetricLaw volume(small);
        const MooneyRivlin  by_invariants(volume, 0.4 * mu, 0.1 * mu);
        const Ogden by_stretches(volume, {{0.8 * mu, 2.}, {-0.2 * mu, -2.}});
        double      of_stress = 0., of_tangent = 0.;
        for (unsigned int k = 0; k < 20; ++k)
          {
            const Matrix h = any_matrix(k < 10 ? 1e-6 : 0.3),
                         w = any_matrix(1.);
            of_stress =
              std::max(of_stress,
                       relative_difference(stress(by_invariants, h, {}),
                                           stress(by_stretches, h, {})));
            of_tangent = std::max(
              of_tangent,
              relative_difference(tangent_product(by_invariants, h, w, {}),
                                  tangent_product(by_stretches, h, w, {})));
          }
        const std::string name =
          mixed ? "invariants, mixed form" : "invariants";
        verdict(name + ": stress", of_stress, 1e-13);
        verdict(name + ": tangent", of_tangent, 1e-11);
      }
  }

  void
  check_mixed(const std::string &name)
  {
    const double nu    = 0.3;
    const auto   whole = make(name, false, nu), part = make(name, true, nu);
    double       worst = 0., difference = 0.;
    for (unsigned int k = 0; k < 10; ++k)
      {
        const Matrix h   = any_matrix(0.1);
        const V      ln  = log1p(dilatation(h.a));
        const Matrix tau = stress(*whole, h, {}), of_u = stress(*part, h, {});
        // the pressure is what the mixed form lacks
        const V p   = of_u.a[0][0] - tau.a[0][0];
        Matrix  sum = of_u;
        for (unsigned int i = 0; i < 3; ++i)
          sum.a[i][i] -= p;
        V value, slope;
        part->dilatation_of_pressure(p, value, slope);
        worst =
          std::max({worst, relative_difference(sum, tau), largest(value - ln)});
        V above, below, unused;
        part->dilatation_of_pressure(p + 1e-4, above, unused);
        part->dilatation_of_pressure(p - 1e-4, below, unused);
        difference =
          std::max(difference, largest((above - below) / 2e-4 / slope - 1.));
      }
    verdict(name + ": mixed form with its pressure", worst, 1e-12);
    verdict(name + ": derivative of its dilatation", difference, 1e-6);
  }

  void
  check_plasticity()
  {
    const auto law    = make("J2 plasticity", false, 0.3, false);
    double     beyond = 0., dissipation = 0., volume = 0., again = 0.;
    for (unsigned int k = 0; k < 20; ++k)
      {
        const Matrix  h      = any_matrix(0.1);
        const History before = any_history();
        History       after;
        Matrix        s;
        law->stress(h.a, before.numbers, after.numbers, s.a);
        const V mean   = (s.a[0][0] + s.a[1][1] + s.a[2][2]) / 3.;
        V       square = {}, work = {};
        for (unsigned int i = 0; i < 6; ++i)
          {
            const auto [a, b]  = voigt_pairs[i];
            const double times = i < 3 ? 1. : 2.;
            // less the back stress
            const V xi = s.a[a][b] - (i < 3 ? mean : V{}) -
                         2. / 3. * 0.2 * after.numbers[i];
            square += times * xi * xi;
            work += times * xi * (after.numbers[i] - before.numbers[i]);
          }
        const V alpha = after.numbers[6];
        const V yield = 0.3 + 0.5 * alpha - 0.3 * expm1(-4. * alpha);
        beyond        = std::max(beyond,
                          largest(sqrt(1.5 * square) > yield ?
                                    sqrt(1.5 * square) - yield :
                                    V{}));
        dissipation   = std::max(dissipation, largest(work < 0. ? work : V{}));
        volume        = std::max(volume,
                          largest(after.numbers[0] + after.numbers[1] +
                                  after.numbers[2]));
        Matrix  same;
        History later;
        law->stress(h.a, after.numbers, later.numbers, same.a);
        again = std::max(again, relative_difference(same, s));
      }
    verdict("J2 plasticity: nothing beyond the yield surface", beyond, 1e-14);
    verdict("J2 plasticity: dissipation is not negative", dissipation, 0.);
    verdict("J2 plasticity: no plastic change of volume", volume, 1e-16);
    verdict("J2 plasticity: the same stress again", again, 1e-14);
  }

  void
  check_table()
  {
    Hardening hardening;
    hardening.table = {{0., 1.}, {0.1, 3.}, {0.3, 4.}};
    double worst    = 0.;
    for (const auto &[alpha, value, slope] :
         {std::array<double, 3>{{0., 1., 20.}},
          std::array<double, 3>{{0.05, 2., 20.}},
          std::array<double, 3>{{0.2, 3.5, 5.}},
          std::array<double, 3>{{0.4, 4., 0.}}})
      {
        V found, found_slope;
        hardening.evaluate(V{} + alpha, found, found_slope);
        worst = std::max(
          {worst, largest(found - value), largest(found_slope - slope)});
      }
    verdict("hardening table", worst, 1e-13);
  }

  void
  check_mathematics()
  {
    double logarithms = 0., exponentials = 0.;
    for (const double size : {1e-8, 1e-3, 0.2, 0.9})
      for (unsigned int k = 0; k < 100; ++k)
        {
          const V x = any_batch(size);
          V       ln, power;
          for (unsigned int l = 0; l < width; ++l)
            {
              ln[l]    = std::log1p(x[l]);
              power[l] = std::expm1(20. * x[l]);
            }
          logarithms = std::max(logarithms, largest((log1p(x) - ln) / ln));
          exponentials =
            std::max(exponentials, largest((expm1(20. * x) - power) / power));
        }
    verdict("log1p", logarithms, 1e-15);
    verdict("expm1", exponentials, 5e-15);
    verdict(std::isnan(log1p(V{} - 1.5)[0]), "log1p of less than -1");

    double worst = 0.;
    for (const double apart : {1., 1e-7, 1e-14, 0.})
      {
        const auto   R         = RigidMotion({{20., 30., 40.}}, {}).rotation;
        const double values[3] = {2., 2. + apart, -1.};
        Matrix       a;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int k = 0; k < 3; ++k)
              a.a[i][j] += values[k] * R[i][k] * R[j][k];
        Matrix copy = a, axes;
        V      found[3];
        eigensystem(copy.a, found, axes.a);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              V sum = {};
              for (unsigned int k = 0; k < 3; ++k)
                sum += found[k] * axes.a[i][k] * axes.a[j][k];
              worst = std::max(worst, largest(sum - a.a[i][j]));
            }
      }
    verdict("eigensystem", worst, 1e-14);
  }
} // namespace

int
main()
{
  check_mathematics();
  const std::vector<std::pair<std::string, std::array<double, 4>>> shears = {
    {"neo-Hookean", {{3.076923077, 2.461538462, 0., 0.}}},
    {"linear elastic", {{2.785682331, 1.114272932, -1.114272932, 0.}}},
    {"St. Venant-Kirchhoff",
     {{6.523076923, 9.526153846, 4.307692308, 1.846153846}}},
    {"Mooney-Rivlin",
     {{3.076923077, 1.476923077, -0.9846153846, -0.4923076923}}},
    {"Ogden", {{2.940657085, 1.301431402, -1.051094266, -0.2503371353}}}};
  for (const auto &[name, expected] : shears)
    {
      const auto law = make(name);
      check_shear(name, *law, expected);
      check_rotations(name, *law);
      check_cycle(name, *law);
      check_tangent(name, *law);
    }
  for (const std::string name :
       {"neo-Hookean", "linear elastic", "Mooney-Rivlin", "Ogden"})
    {
      check_mixed(name);
      check_tangent(name + " in mixed form, nu = 0.5", *make(name, true, 0.5));
    }
  check_tangent("J2 plasticity", *make("J2 plasticity", false, 0.3, false));
  check_tangent("J2 plasticity at finite strain", *make("J2 plasticity"));
  check_rotations("J2 plasticity at finite strain", *make("J2 plasticity"));
  check_invariants();
  check_plasticity();
  check_table();
}
