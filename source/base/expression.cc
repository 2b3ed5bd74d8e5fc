#include <deal.II/base/utilities.h>

#include <boost/container/small_vector.hpp>

#include <mortise/base/derivatives.h>
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

    bool
    varies(const double)
    {
      return false;
    }

    template <typename Number>
    bool
    varies(const Sacado::Fad::SFad<Number, 3> &a)
    {
      bool result = varies(a.val());
      for (int i = 0; i < 3; ++i)
        result = result || value_of(a.dx(i)) != 0. || varies(a.dx(i));
      return result;
    }

    double
    raise(const double, const double, const double *powers)
    {
      return powers[0];
    }

    /// a^n, where powers[k] = value_of(a)^(n - k).
    template <typename Number>
    Sacado::Fad::SFad<Number, 3>
    raise(const Sacado::Fad::SFad<Number, 3> &a,
          const double                        n,
          const double                       *powers)
    {
      Sacado::Fad::SFad<Number, 3> result(raise(a.val(), n, powers));
      const Number slope = n * raise(a.val(), n - 1., powers + 1);
      for (int i = 0; i < 3; ++i)
        result.fastAccessDx(i) = slope * a.dx(i);
      return result;
    }

    /// a^b; small integers by multiplication, which is faster than std::pow and
    /// has derivatives at zero and of negative bases.
    template <typename Number>
    Number
    power(const Number &a, const Number &b)
    {
      using std::pow;
      const double n = value_of(b);
      if (varies(b))
        return pow(a, b);
      if (!(std::fabs(n) <= 16.) || n != std::floor(n))
        {
          constexpr unsigned int order = std::is_same_v<Number, double> ? 0 :
                                         std::is_same_v<Number, WithGradient> ?
                                                                          1 :
                                                                          2;
          double                 powers[order + 1];
          for (unsigned int k = 0; k <= order; ++k)
            powers[k] = std::pow(value_of(a), n - k);
          return raise(a, n, powers);
        }
      Number result = 1., square = a;
      for (unsigned int k = static_cast<unsigned int>(std::fabs(n)); k > 0;
           k /= 2)
        {
          if (k % 2 == 1)
            result *= square;
          square *= square;
        }
      return n < 0 ? Number(1. / result) : result;
    }

    template <typename Number>
    Number
    apply_to(const Operation operation,
             const Number   &a,
             const Number   &b,
             const Number   &c)
    {
      using namespace std;
      const double u = value_of(a), v = value_of(b);
      // clang-format off
      switch (operation)
        {
          case Operation::minus:         return -a;
          case Operation::negate:        return u == 0.;
          case Operation::sin:           return sin(a);
          case Operation::cos:           return cos(a);
          case Operation::tan:           return tan(a);
          case Operation::asin:          return asin(a);
          case Operation::acos:          return acos(a);
          case Operation::atan:          return atan(a);
          case Operation::sinh:          return sinh(a);
          case Operation::cosh:          return cosh(a);
          case Operation::tanh:          return tanh(a);
          case Operation::exp:           return exp(a);
          case Operation::log:           return log(a);
          case Operation::sqrt:          return sqrt(a);
          case Operation::abs:           return u < 0. ? Number(-a) : a;
          case Operation::add:           return a + b;
          case Operation::subtract:      return a - b;
          case Operation::multiply:      return a * b;
          case Operation::divide:        return a / b;
          case Operation::power:         return power(a, b);
          case Operation::atan2:         return atan2(a, b);
          case Operation::min:           return v < u ? b : a;
          case Operation::max:           return u < v ? b : a;
          case Operation::less:          return u < v;
          case Operation::less_equal:    return u <= v;
          case Operation::greater:       return u > v;
          case Operation::greater_equal: return u >= v;
          case Operation::equal:         return u == v;
          case Operation::not_equal:     return u != v;
          case Operation::both:          return u != 0. && v != 0.;
          case Operation::either:        return u != 0. || v != 0.;
          case Operation::select:        return u != 0. ? b : c;
          default:                       break;
        }
      // clang-format on
      Assert(false, ExcInternalError());
      return 0.;
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
          if (direction < 0)
            *result = node.constant;
          else if (direction < 3)
            set_coordinate(*result, p[direction], direction);
          else // operands that do not exist point to the first result
            *result = apply_to(node.operation,
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
    return apply_to(operation, a, b, c);
  }

  double
  Expression::value(const Point<3> &p) const
  {
    return evaluate<double>(nodes, p);
  }

  Tensor<1, 3>
  Expression::gradient(const Point<3> &p) const
  {
    return gradient_of(evaluate<WithGradient>(nodes, p));
  }

  SymmetricTensor<2, 3>
  Expression::hessian(const Point<3> &p) const
  {
    return symmetrize(hessian_of(evaluate<WithHessian>(nodes, p)));
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
