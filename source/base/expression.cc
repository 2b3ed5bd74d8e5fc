#include <deal.II/base/utilities.h>

#include <boost/container/small_vector.hpp>

#include <mortise/base/error.h>
#include <mortise/base/expression.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Operation = Expression::Operation;
    using Node      = Expression::Node;
    using Jet       = Expression::Jet;

    /// a^n; small integers by multiplication, which is faster than std::pow.
    double
    power(const double a, const double n)
    {
      if (!(std::fabs(n) <= 16.) || n != std::floor(n))
        return std::pow(a, n);
      double result = 1., square = a;
      for (unsigned int k = static_cast<unsigned int>(std::fabs(n)); k > 0;
           k /= 2)
        {
          if (k % 2 == 1)
            result *= square;
          square *= square;
        }
      return n < 0 ? 1. / result : result;
    }

    /// First and second derivative of a function of one variable.
    struct Derivatives
    {
      double first, second;
    };

    /// Derivatives at @p u, where the function has the value @p f.
    Derivatives
    differentiate(const Operation operation, const double u, const double f)
    {
      // clang-format off
      switch (operation)
        {
          case Operation::minus:  return {-1., 0.};
          case Operation::sin:    return {std::cos(u), -f};
          case Operation::cos:    return {-std::sin(u), -f};
          case Operation::tan:    return {1. + f * f, 2. * f * (1. + f * f)};
          case Operation::asin:
          case Operation::acos:
            {
              const double sign = operation == Operation::asin ? 1. : -1.;
              const double g    = 1. / std::sqrt((1. - u) * (1. + u));
              return {sign * g, sign * u * g * g * g};
            }
          case Operation::atan:
            {
              const double g = 1. / (1. + u * u);
              return {g, -2. * u * g * g};
            }
          case Operation::sinh:   return {std::cosh(u), f};
          case Operation::cosh:   return {std::sinh(u), f};
          case Operation::tanh:
            {
              const double g = 1. / std::cosh(u);
              return {g * g, -2. * f * g * g};
            }
          case Operation::exp:    return {f, f};
          case Operation::log:    return {1. / u, -1. / (u * u)};
          case Operation::sqrt:   return {0.5 / f, -0.25 / (u * f)};
          case Operation::abs:    return {u < 0. ? -1. : 1., 0.};
          case Operation::negate: return {0., 0.};
          default:                break;
        }
      // clang-format on
      Assert(false, ExcInternalError());
      return {};
    }

    /// Derivatives of a function f(a, b) at a point.
    struct Partials
    {
      double a, b, aa, ab, bb;
    };

    /// The jet of f(a(x), b(x)) by the chain rule.
    Jet
    combine(const Jet &a, const Jet &b, const double f, const Partials &d)
    {
      Jet r;
      r.value    = f;
      r.gradient = d.a * a.gradient + d.b * b.gradient;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          r.hessian[i][j] = d.a * a.hessian[i][j] + d.b * b.hessian[i][j] +
                            d.aa * a.gradient[i] * a.gradient[j] +
                            d.ab * (a.gradient[i] * b.gradient[j] +
                                    b.gradient[i] * a.gradient[j]) +
                            d.bb * b.gradient[i] * b.gradient[j];
      return r;
    }

    /// The jet of f(a(x)).
    Jet
    compose(const Jet &a, const double f, const Derivatives &d)
    {
      Jet r;
      r.value    = f;
      r.gradient = d.first * a.gradient;
      r.hessian  = d.first * a.hessian;
      if (d.second != 0.)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = i; j < 3; ++j)
            r.hessian[i][j] += d.second * a.gradient[i] * a.gradient[j];
      return r;
    }

    Jet
    combine_power(const Jet &a, const Jet &b, const double f)
    {
      const double n = b.value;
      // An exponent that does not vary must not meet log(a), which a negative
      // base does not have; coefficients 0 must not meet a negative power of 0.
      const double first = n == 0. ? 0. : n * power(a.value, n - 1.);
      const double second =
        n == 0. || n == 1. ? 0. : n * (n - 1.) * power(a.value, n - 2.);
      if (b.gradient.norm_square() == 0. && b.hessian.norm() == 0.)
        return compose(a, f, {first, second});
      const double l = std::log(a.value);
      return combine(a,
                     b,
                     f,
                     {first,
                      f * l,
                      second,
                      power(a.value, n - 1.) * (1. + n * l),
                      f * l * l});
    }

    Jet
    apply(const Operation operation, const Jet &a, const Jet &b, const Jet &c)
    {
      const double f = Expression::apply(operation, a.value, b.value, c.value);
      switch (operation)
        {
          case Operation::add:
            return {f, a.gradient + b.gradient, a.hessian + b.hessian};
          case Operation::subtract:
            return {f, a.gradient - b.gradient, a.hessian - b.hessian};
          case Operation::multiply:
            return combine(a, b, f, {b.value, a.value, 0., 1., 0.});
          case Operation::divide:
            {
              const double q = 1. / b.value;
              return combine(a, b, f, {q, -f * q, 0., -q * q, 2. * f * q * q});
            }
          case Operation::power:
            return combine_power(a, b, f);
          case Operation::atan2:
            {
              const double s = 1. / (a.value * a.value + b.value * b.value);
              const double u = a.value * s, v = b.value * s;
              return combine(a,
                             b,
                             f,
                             {v, -u, -2. * u * v, u * u - v * v, 2. * u * v});
            }
          case Operation::min:
            return a.value <= b.value ? a : b;
          case Operation::max:
            return a.value >= b.value ? a : b;
          case Operation::select:
            return a.value != 0. ? b : c;
          default:
            if (Expression::n_operands(operation) == 2) // comparisons
              return {f, {}, {}};
            return compose(a, f, differentiate(operation, a.value, f));
        }
    }

    double
    apply(const Operation operation,
          const double    a,
          const double    b,
          const double    c)
    {
      return Expression::apply(operation, a, b, c);
    }

    void
    set(double &leaf, const double value, const int)
    {
      leaf = value;
    }

    /// A constant (@p direction < 0) or a coordinate.
    void
    set(Jet &leaf, const double value, const int direction)
    {
      leaf       = Jet();
      leaf.value = value;
      if (direction >= 0)
        leaf.gradient[direction] = 1.;
    }

    /// Value of the last of @p nodes, by one walk over them in their order.
    template <typename Number>
    Number
    evaluate(const std::vector<Node> &nodes, const Point<3> &p)
    {
      boost::container::small_vector<Number, 24> results(nodes.size());
      Number                                    *result = results.data();
      for (const Node &node : nodes)
        {
          const int direction =
            static_cast<int>(node.operation) - static_cast<int>(Operation::x);
          if (direction < 3)
            set(*result,
                direction < 0 ? node.constant : p[direction],
                direction);
          else // operands that do not exist point to the first result
            *result = apply(node.operation,
                            results[node.operands[0]],
                            results[node.operands[1]],
                            results[node.operands[2]]);
          ++result;
        }
      return results.back();
    }
  } // namespace

  Expression::Expression()
    : nodes(1)
  {}

  Expression::Expression(const std::string &text,
                         const std::string &where,
                         const double       time)
  {
    parse(text, where, time);
  }

  unsigned int
  Expression::n_operands(const Operation operation)
  {
    return operation < Operation::minus  ? 0 :
           operation < Operation::add    ? 1 :
           operation < Operation::select ? 2 :
                                           3;
  }

  double
  Expression::apply(const Operation operation,
                    const double    a,
                    const double    b,
                    const double    c)
  {
    // clang-format off
    switch (operation)
      {
        case Operation::minus:         return -a;
        case Operation::negate:        return a == 0.;
        case Operation::sin:           return std::sin(a);
        case Operation::cos:           return std::cos(a);
        case Operation::tan:           return std::tan(a);
        case Operation::asin:          return std::asin(a);
        case Operation::acos:          return std::acos(a);
        case Operation::atan:          return std::atan(a);
        case Operation::sinh:          return std::sinh(a);
        case Operation::cosh:          return std::cosh(a);
        case Operation::tanh:          return std::tanh(a);
        case Operation::exp:           return std::exp(a);
        case Operation::log:           return std::log(a);
        case Operation::sqrt:          return std::sqrt(a);
        case Operation::abs:           return std::fabs(a);
        case Operation::add:           return a + b;
        case Operation::subtract:      return a - b;
        case Operation::multiply:      return a * b;
        case Operation::divide:        return a / b;
        case Operation::power:         return power(a, b);
        case Operation::atan2:         return std::atan2(a, b);
        case Operation::min:           return std::min(a, b);
        case Operation::max:           return std::max(a, b);
        case Operation::less:          return a < b;
        case Operation::less_equal:    return a <= b;
        case Operation::greater:       return a > b;
        case Operation::greater_equal: return a >= b;
        case Operation::equal:         return a == b;
        case Operation::not_equal:     return a != b;
        case Operation::both:          return a != 0. && b != 0.;
        case Operation::either:        return a != 0. || b != 0.;
        case Operation::select:        return a != 0. ? b : c;
        default:                       break;
      }
    // clang-format on
    Assert(false, ExcInternalError());
    return 0.;
  }

  double
  Expression::value(const Point<3> &p) const
  {
    return evaluate<double>(nodes, p);
  }

  Tensor<1, 3>
  Expression::gradient(const Point<3> &p) const
  {
    return jet(p).gradient;
  }

  SymmetricTensor<2, 3>
  Expression::hessian(const Point<3> &p) const
  {
    return jet(p).hessian;
  }

  Expression::Jet
  Expression::jet(const Point<3> &p) const
  {
    return evaluate<Jet>(nodes, p);
  }

  VectorExpression::VectorExpression(const std::string &text,
                                     const std::string &where,
                                     const double       time)
  {
    const std::vector<std::string> parts =
      Utilities::split_string_list(text, ';');
    if (parts.size() != 3)
      throw InputError(
        (where.empty() ? "" : where + ": ") +
        "a vector needs 3 expressions separated by ';', as in \"0; 0; 2*x\"; got " +
        std::to_string(parts.size()) + " in " + in_quotes(text));
    for (unsigned int c = 0; c < 3; ++c)
      components[c] = Expression(parts[c], where, time);
  }
} // namespace mortise
