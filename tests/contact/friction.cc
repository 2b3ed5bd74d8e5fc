// Proves the law of friction at a node: iterates on a spring come to |t| <= F
// with slip along t where it slips and none where it sticks, for a given bound
// and for one of Coulomb; the law that is linearised has the derivatives of t -
// min(1, F / |t + c s|) (t + c s); when a node begins to slip and to stick;
// what violates the law at a point; and that none of it depends on the axes.
#include <deal.II/lac/full_matrix.h>

#include <deal.II/physics/transformations.h>

#include <mortise/contact/friction.h>
#include <mortise/contact/interface_law.h>
#include <mortise/solvers/pseudo_random.h>
#include <verdict.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace mortise;

namespace
{
  using Vec = dealii::Tensor<1, 3>;

  constexpr double rounding = 1e-13;

  /// Draws of numbers between -1 and 1.
  class Draws
  {
  public:
    explicit Draws(const unsigned int number)
      : next(100 * number)
    {}

    double
    operator()()
    {
      return pseudo_random(next++);
    }

    Vec
    vector()
    {
      Vec result;
      for (unsigned int c = 0; c < 3; ++c)
        result[c] = (*this)();
      return result;
    }

  private:
    unsigned int next;
  };

  /// Two tangents and the normal.
  std::array<Vec, 3>
  frame(Draws &draw)
  {
    Vec n = draw.vector();
    n[0] += 0.01;
    n /= n.norm();
    Vec a = cross_product_3d(n, draw.vector() + Vec({0., 0.013, 0.}));
    a /= a.norm();
    return {{a, cross_product_3d(n, a), n}};
  }

  Vec
  tangent(const std::array<Vec, 3> &axes, Draws &draw)
  {
    const double a = draw(), b = draw();
    return a * axes[0] + b * axes[1];
  }

  /// t - min(1, F / |t + c s|) (t + c s)
  Vec
  law(const FrictionBound &bound, const FrictionPoint &at)
  {
    const Vec    trial = at.traction + at.c * at.slip;
    const double F     = bound.of(at.pressure);
    return at.traction - std::min(1., F / trial.norm()) * trial;
  }

  FrictionBound
  coulomb(const double coefficient, const double given = 0.)
  {
    return {coefficient, given, coefficient};
  }

  /// What Newton's method for law() asks of the next iterate, next_friction()
  /// has: with t = F(p) d + b across d and s = any d + compliance b, linear
  /// terms from differences add up to zero. A node that sticks has s = 0.
  void
  check_linearisation(const std::string &what, const bool is_coulomb)
  {
    double       worst = 0., of_error = 0., of_stick = 0.;
    unsigned int n_slip = 0, n_stick = 0;
    for (unsigned int number = 0; number < 500; ++number)
      {
        Draws               draw(number);
        const auto          axes = frame(draw);
        const FrictionBound bound =
          is_coulomb ? coulomb(0.9, 0.2 + 0.1 * draw()) : coulomb(0., 1.2);
        FrictionPoint at;
        at.traction      = tangent(axes, draw);
        at.slip          = tangent(axes, draw);
        at.pressure      = 1.1 + draw();
        at.c             = 2. + draw();
        const Vec  trial = at.traction + at.c * at.slip;
        const auto differs =
          [&](const Vec &traction, const Vec &slip, const double pressure) {
            // a difference between both sides
            constexpr double step = 1e-5;
            FrictionPoint    ends[2];
            for (unsigned int k = 0; k < 2; ++k)
              {
                const double by = k == 0 ? step : -step;
                ends[k]         = at;
                ends[k].traction += by * traction;
                ends[k].slip += by * slip;
                ends[k].pressure += by * pressure;
              }
            return 0.5 / step * (law(bound, ends[0]) - law(bound, ends[1]));
          };
        const double F = bound.of(at.pressure);
        if (std::fabs(trial.norm() / F - 1.) < 0.02)
          continue; // the function has a kink there
        Friction now;
        if (trial.norm() > F)
          now.status = NodeStatus::slip; // along the trial traction
        now.direction = trial / trial.norm();
        now.direction *= now.status == NodeStatus::slip ? 1. : 0.;
        if (at.slip * now.direction < 0.)
          now = Friction();
        const Friction next = next_friction(now, bound, at, rounding);
        if (next.status == NodeStatus::stick)
          {
            ++n_stick;
            const Vec slip = tangent(axes, draw), to = -1. * at.slip;
            of_stick =
              std::max({of_stick,
                        (law(bound, at) + differs(slip, to, draw())).norm(),
                        next.bound,
                        next.compliance,
                        next.error});
            continue;
          }
        ++n_slip;
        const Vec    across = cross_product_3d(axes[2], next.direction);
        const double b = draw(), along = draw(), pressure = 1.1 + draw();
        const Vec traction = bound.of(pressure) * next.direction + b * across;
        const Vec slip = along * next.direction + next.compliance * b * across;
        const Vec left = law(bound, at) + differs(traction - at.traction,
                                                  slip - at.slip,
                                                  pressure - at.pressure);
        worst          = std::max(worst, left.norm());
        of_error       = std::max({of_error,
                                   std::fabs(next.error - law(bound, at).norm()),
                                   std::fabs(next.bound - F)});
      }
    verdict(what + ": linearised at slip, 1e-7", worst, 1e-7);
    verdict(what + ": linearised at stick, 1e-7", of_stick, 1e-7);
    verdict(what + ": violation and bound at slip, 1e-13", of_error, 1e-13);
    verdict(std::min(n_slip, n_stick) > 50,
            what + ": many of either kind",
            std::to_string(n_slip) + " and " + std::to_string(n_stick));
  }

  /// A node on a spring that is drawn by g: s = g - C t with C of @p stiffness
  /// in two directions; the pressure p + q . t follows the traction.
  struct Spring
  {
    std::array<Vec, 3> axes;
    double             compliance[2];
    Vec                g, q;
    double             p;

    Vec
    yields(const Vec &t) const
    {
      return compliance[0] * (axes[0] * t) * axes[0] +
             compliance[1] * (axes[1] * t) * axes[1];
    }

    /// The next iterate with the law @p next.
    void
    solve(const Friction      &next,
          const FrictionBound &bound,
          FrictionPoint       &at) const
    {
      Vec t;
      if (next.status == NodeStatus::stick)
        t = (axes[0] * g) / compliance[0] * axes[0] +
            (axes[1] * g) / compliance[1] * axes[1];
      else
        {
          // t = (f + mu (p + q . t)) d + b e, e . (g - C t) = compliance b
          const Vec &d = next.direction, e = cross_product_3d(axes[2], d);
          dealii::FullMatrix<double> A(2, 2);
          const double               mu = bound.coefficient;
          A(0, 0)                       = 1. - mu * (q * d);
          A(0, 1)                       = -mu * (q * e);
          A(1, 0)                       = e * yields(d);
          A(1, 1)                       = e * yields(e) + next.compliance;
          A.gauss_jordan();
          const double of_bound = bound.given + mu * p;
          t                     = (A(0, 0) * of_bound + A(0, 1) * (e * g)) * d +
              (A(1, 0) * of_bound + A(1, 1) * (e * g)) * e;
        }
      at.traction = t;
      at.slip     = g - yields(t);
      at.pressure = p + q * t;
    }
  };

  void
  check_law(const std::string &what, const bool is_coulomb)
  {
    double       bounds = 0., slips = 0., sticks = 0., most = 0.;
    unsigned int n[2] = {0, 0};
    for (unsigned int number = 0; number < 500; ++number)
      {
        Draws               draw(1000 + number);
        const FrictionBound bound =
          is_coulomb ? coulomb(0.4) : coulomb(0., 0.4);
        Spring spring;
        spring.axes          = frame(draw);
        spring.compliance[0] = 1.5 + draw();
        spring.compliance[1] = 1.5 + draw();
        spring.g             = tangent(spring.axes, draw);
        spring.q             = 0.3 * tangent(spring.axes, draw);
        spring.p             = 1.1 + 0.5 * draw();
        FrictionPoint at;
        at.c        = 1.;
        at.pressure = spring.p;
        Friction now;
        // a draw of either start
        if (draw() > 0.)
          {
            now.status    = NodeStatus::slip;
            now.direction = tangent(spring.axes, draw);
            now.direction /= now.direction.norm();
            now.bound = bound.of(at.pressure);
          }
        unsigned int iterations = 0;
        for (bool goes_on = true; goes_on && iterations < 100; ++iterations)
          {
            spring.solve(now, bound, at);
            const Friction next = next_friction(now, bound, at, rounding);
            goes_on = next.status != now.status || next.error > 1e-11;
            now     = next;
          }
        most           = std::max(most, double(iterations));
        const double F = bound.of(at.pressure);
        bounds         = std::max(bounds, at.traction.norm() - F);
        ++n[now.status == NodeStatus::slip];
        if (now.status == NodeStatus::slip)
          slips = std::max({slips,
                            (at.slip.norm() * at.traction - F * at.slip).norm(),
                            -(at.slip * at.traction)});
        else
          sticks = std::max(sticks, at.slip.norm());
      }
    verdict(what + ": |t| <= F, 1e-10", bounds, 1e-10);
    verdict(what + ": t |s| = F s, 1e-10", slips, 1e-10);
    verdict(what + ": no slip where it sticks, 1e-14", sticks, 1e-14);
    verdict(what + ": iterations", most, 10.);
    verdict(std::min(n[0], n[1]) > 50,
            what + ": many of either kind",
            std::to_string(n[1]) + " and " + std::to_string(n[0]));
  }

  /// What violates the law at a point of an interface, as adaptivity sees it.
  void
  check_violation()
  {
    constexpr double c    = 3.;
    double           none = 0., beyond = 0., open = 0., moved = 0., back = 0.;
    bool             tells = true;
    for (unsigned int number = 0; number < 200; ++number)
      {
        Draws        draw(5000 + number);
        const auto   axes = frame(draw);
        const Vec   &n    = axes[2];
        InterfaceLaw law;
        law.law         = Law::contact;
        law.constrained = ConstrainedDirections::all;
        InterfacePoint point;
        point.normal               = n;
        point.friction.coefficient = 0.4 + 0.2 * draw();
        const double p = 1.1 + draw(), F = point.friction.coefficient * p;
        Vec          along = tangent(axes, draw);
        along /= along.norm();
        const double within = 0.5 * (1. + draw()), far = 1.1 + draw();
        const auto   violation = [&](const Vec &tangential, const Vec &slip) {
          point.traction = p * n + tangential;
          point.jump     = -slip; // of the master against the slave
          return law.violation(point, c);
        };
        none  = std::max({none,
                          violation(within * F * along, Vec()),
                          violation(F * along, far * along)});
        tells = tells && !law.sticks(point, c);
        violation(within * F * along, Vec());
        tells              = tells && law.sticks(point, c);
        beyond             = std::max(beyond,
                          std::fabs(violation((F + far) * along, Vec()) -
                                    far * far / c));
        const double small = 0.9 * F / c;
        moved              = std::max(moved,
                         std::fabs(violation(Vec(), small * along) -
                                   c * small * small));
        back               = std::max(back,
                        std::fabs(violation(F * along, -small * along) -
                                  c * small * small));
        point.offset = 0.5; // pressed, and tangentially as well, across a gap
        open         = std::max(open,
                        std::fabs(violation(Vec(), Vec()) -
                                  std::min(c * 0.25, p * p / c)));
      }
    verdict("no violation where it sticks or slips, 1e-13", none, 1e-13);
    verdict(tells, "tells which of both");
    verdict("a traction beyond the bound, 1e-12", beyond, 1e-12);
    verdict("slip without a traction, 1e-12", moved, 1e-12);
    verdict("slip against the traction, 1e-12", back, 1e-12);
    verdict("a pressure across a gap, 1e-12", open, 1e-12);
  }

  bool
  slips(const Friction &friction)
  {
    return friction.status == NodeStatus::slip;
  }

  void
  check_statuses()
  {
    FrictionBound bound;
    bound.coefficient        = 0.2;
    bound.static_coefficient = 0.3;
    FrictionPoint at;
    at.c        = 1.;
    at.pressure = 2.;
    const Vec  x({1., 0., 0.});
    const auto with = [&](const double t, const double s) {
      at.traction = t * x;
      at.slip     = s * x;
      return at;
    };
    Friction stick, slip;
    slip.status     = NodeStatus::slip;
    slip.direction  = x;
    slip.bound      = 0.4;
    const auto next = [&](const Friction &now, const double t, const double s) {
      return next_friction(now, bound, with(t, s), 1e-12);
    };
    verdict(!slips(next(stick, 0.59, 0.)) && !slips(next(stick, 0.6, 0.)),
            "sticks up to the static coefficient");
    verdict(slips(next(stick, 0.61, 0.)), "slips beyond it");
    verdict("then with the coefficient of slip",
            std::fabs(next(stick, 0.61, 0.).bound - 0.4),
            1e-15);
    verdict(!slips(next_friction(stick, bound, with(0.61, 0.), 0.02)),
            "rounding is no reason to slip");
    verdict(slips(next(slip, 0.5, 0.)),
            "goes on to slip between the coefficients");
    verdict(slips(next(slip, 0.4, 1e-13)) && slips(next(slip, 0.4, -1e-13)),
            "goes on to slip without motion");
    const Friction reversed = next(slip, 0.4, -0.1);
    verdict(!slips(reversed), "sticks once it moves back");
    verdict("which has neither bound nor direction",
            reversed.bound + reversed.compliance + reversed.direction.norm() +
              reversed.error,
            0.);
    verdict(!slips(next(slip, 0.4, -10.)), "however far it moves back");
    verdict(slips(next(reversed, -0.7, 0.)) &&
              next(reversed, -0.7, 0.).direction[0] == -1.,
            "then may slip the other way");
    verdict(
      "just over the bound it is held across",
      next_friction(slip, coulomb(0., 1.), with(1. + 1e-7, 0.), 0.).compliance,
      0.);
    verdict("a bound for its traction alone",
            std::fabs(
              next_friction(stick, coulomb(0., 0.5), with(3., 0.), 0.).bound -
              0.5),
            1e-15);

    const Friction none = next_friction(stick, {}, with(0.5, 1.), 1e-12);
    verdict(slips(none) && none.bound == 0. && none.direction.norm() == 0. &&
              none.compliance == 0.,
            "slips without a bound in any direction");
    verdict("all of its traction is in error",
            std::fabs(none.error - 0.5),
            1e-15);
    verdict(slips(next_friction(none, {}, with(0., -1.), 1e-12)),
            "and goes on, wherever it moves");
    verdict(!slips(next_friction(stick, {}, with(0., 0.), 1e-12)),
            "without a bound, traction and motion it sticks");
    at.pressure = -1.;
    verdict("no bound where it pulls",
            next(stick, 0.5, 0.).bound + bound.at_rest(-1.),
            0.);
  }

  /// Axes turned about any axis turn directions and change nothing else.
  void
  check_axes()
  {
    double       worst = 0.;
    unsigned int other = 0, n[2] = {0, 0};
    for (unsigned int number = 0; number < 500; ++number)
      {
        Draws      draw(2000 + number);
        const auto axes = frame(draw), about = frame(draw);
        const auto turn =
          dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
            about[2], 3. * draw());
        const FrictionBound bound = coulomb(0.5, 0.1);
        FrictionPoint       at;
        at.traction = tangent(axes, draw);
        at.slip     = tangent(axes, draw);
        at.pressure = 1. + draw();
        at.c        = 2. + draw();
        Friction now;
        if (draw() > 0.)
          {
            now.status    = NodeStatus::slip;
            now.direction = axes[0];
          }
        const Friction one = next_friction(now, bound, at, rounding);
        at.traction        = turn * at.traction;
        at.slip            = turn * at.slip;
        now.direction      = turn * now.direction;
        const Friction two = next_friction(now, bound, at, rounding);
        other += one.status == two.status ? 0 : 1;
        ++n[slips(one)];
        worst = std::max(
          {worst,
           (turn * one.direction - two.direction).norm(),
           std::fabs(one.bound - two.bound),
           std::fabs(one.compliance - two.compliance) / (1. + one.compliance),
           std::fabs(one.error - two.error)});
      }
    verdict("turned axes: statuses", other, 0.);
    verdict("turned axes: the law, 1e-13", worst, 1e-13);
    verdict(n[0] > 50 && n[1] > 50, "turned axes: many of either kind");
  }
} // namespace

int
main()
{
  for (const bool is_coulomb : {false, true})
    {
      const std::string what = is_coulomb ? "Coulomb" : "Tresca";
      check_linearisation(what, is_coulomb);
      check_law(what, is_coulomb);
    }
  check_statuses();
  check_violation();
  check_axes();
}
