// Expressions: values, exact first and second derivatives, folding, and
// messages for bad input.

#include <mortise/base/error.h>
#include <mortise/base/expression.h>
#include <verdict.h>

#include <cmath>
#include <functional>
#include <iostream>

using namespace mortise;
using dealii::Point;

namespace
{
  struct Case
  {
    std::string                                         text;
    std::function<double(double x, double y, double z)> value;
  };

  const std::vector<Case> cases = {
    {"1 + 2*x - y/3 + z",
     [](double x, double y, double z) { return 1 + 2 * x - y / 3 + z; }},
    {"-x^2 + 2^-y + 2^y^z",
     [](double x, double y, double z) {
       return -x * x + std::pow(2, -y) + std::pow(2, std::pow(y, z));
     }},
    {"x - y - z / x / y",
     [](double x, double y, double z) { return x - y - z / x / y; }},
    {"sin(x*y) * cos(pi*z) + tan(x/2)",
     [](double x, double y, double z) {
       return std::sin(x * y) * std::cos(dealii::numbers::PI * z) +
              std::tan(x / 2);
     }},
    {"asin(x/3) + acos(y/3)*atan(z)",
     [](double x, double y, double z) {
       return std::asin(x / 3) + std::acos(y / 3) * std::atan(z);
     }},
    {"sinh(x)*cosh(y) - tanh(x*z)",
     [](double x, double y, double z) {
       return std::sinh(x) * std::cosh(y) - std::tanh(x * z);
     }},
    {"exp(-x*x) * log(y + z) / sqrt(x + y*z)",
     [](double x, double y, double z) {
       return std::exp(-x * x) * std::log(y + z) / std::sqrt(x + y * z);
     }},
    {"atan2(y - 2*x, x*z) + pow(x + y, 2.5) + x^y",
     [](double x, double y, double z) {
       return std::atan2(y - 2 * x, x * z) + std::pow(x + y, 2.5) +
              std::pow(x, y);
     }},
    {"abs(x - y) * max(x, z*y) + min(x^3, y^-2)",
     [](double x, double y, double z) {
       return std::fabs(x - y) * std::max(x, z * y) +
              std::min(x * x * x, 1 / (y * y));
     }},
    {"x < y ? x*x*z : y > z && !(x > 1) ? sin(z) : cos(x)",
     [](double x, double y, double z) {
       return x < y ? x * x * z : y > z && !(x > 1) ? std::sin(z) : std::cos(x);
     }},
    {"if(x >= 0.8 || y <= 0.7, x*y*z, 1.5e-1*x^4) + (x == x) + (y != y) * .5",
     [](double x, double y, double z) {
       return (x >= 0.8 || y <= 0.7 ? x * y * z : 0.15 * x * x * x * x) + 1;
     }},
    {"(2 - 7)*x^17 + x^(1/3)",
     [](double x, double, double) {
       return -5 * std::pow(x, 17) + std::cbrt(x);
     }},
  };

  std::vector<Point<3>>
  points()
  {
    return {{0.31, 0.72, 1.13},
            {0.97, 0.55, 0.41},
            {1.21, 1.37, 0.29},
            {0.62, 0.15, 0.93},
            {0.85, 1.9, 0.6}};
  }

  /// Central difference of order four.
  template <typename Value, typename F>
  Value
  difference(const F &f, const Point<3> &p, const unsigned int direction)
  {
    const double h  = 5e-4;
    const auto   at = [&](const double steps) {
      Point<3> q = p;
      q[direction] += steps * h;
      return f(q);
    };
    return (8. * (at(1.) - at(-1.)) - (at(2.) - at(-2.))) / (12. * h);
  }

  void
  check_derivatives()
  {
    double value_error = 0., gradient_error = 0., hessian_error = 0.;
    for (const Case &c : cases)
      {
        const Expression e(c.text);
        for (const Point<3> &p : points())
          {
            const double exact = c.value(p[0], p[1], p[2]);
            value_error =
              std::max(value_error,
                       std::fabs(e.value(p) - exact) / (1. + std::fabs(exact)));
            const auto gradient = e.gradient(p);
            const auto hessian  = e.hessian(p);
            for (unsigned int i = 0; i < 3; ++i)
              {
                const double d = difference<double>(
                  [&](const Point<3> &q) { return e.value(q); }, p, i);
                gradient_error =
                  std::max(gradient_error,
                           std::fabs(gradient[i] - d) / (1. + std::fabs(d)));
                const auto dd = difference<dealii::Tensor<1, 3>>(
                  [&](const Point<3> &q) { return e.gradient(q); }, p, i);
                for (unsigned int j = 0; j < 3; ++j)
                  hessian_error = std::max(hessian_error,
                                           std::fabs(hessian[i][j] - dd[j]) /
                                             (1. + std::fabs(dd[j])));
              }
          }
      }
    verdict("values of all operators and functions: 1e-14", value_error, 1e-14);
    verdict("gradients against differences: 1e-7", gradient_error, 1e-7);
    verdict("Hessians against differences: 1e-7", hessian_error, 1e-7);
  }

  void
  check_numbers()
  {
    const std::vector<std::pair<std::string, double>> constants = {
      {"-2^2", -4.},
      {"2^3^2", 512.},
      {"2^-1", 0.5},
      {"-2^-2", -0.25},
      {"8/4/2", 1.},
      {"1-2-3", -4.},
      {"2+3*4^2/8", 8.},
      {"--3", 3.},
      {"1 < 2 == 1", 1.},
      {"1 ? 2 : 0 ? 3 : 4", 2.},
      {"0*x + 0 ? 1 : 2", 2.},
      {"1 > 2 ? 1/x : 7", 7.},
      {" .5e1 ", 5.},
      {"cos(pi)", -1.}};
    bool good = true, folded = true;
    for (const auto &[text, value] : constants)
      {
        const Expression e(text);
        good = good && e.value(Point<3>(1., 2., 3.)) == value;
        folded =
          folded && e.is_constant() == (text.find("0*x") == std::string::npos);
      }
    verdict(good, "precedence and grouping: exact");
    verdict(folded && !Expression("x").is_constant(), "constants are folded");

    const Point<3> origin;
    bool           zero =
      Expression("x^2").hessian(origin)[0][0] == 2. &&
      Expression("x^1").gradient(origin)[0] == 1. &&
      Expression("x^1 + pow(y,0)").hessian(origin).norm() == 0. &&
      Expression("(x-1)^3").hessian(origin)[0][0] == -6. &&
      Expression("x == 0 ? y : y*sin(x)/x").gradient(origin)[1] == 1. &&
      Expression("(x-1)^if(y>1,2,3)").gradient(origin)[0] == 3.;
    verdict(zero, "derivatives of powers at zero and of negative bases: exact");

    const VectorExpression v("x*y; 2; z^2");
    verdict(v.value({2., 3., 4.})[0] == 6. &&
              v.gradient({2., 3., 4.})[2][2] == 8. &&
              v.gradient({2., 3., 4.})[0][1] == 2. &&
              v.hessian({2., 3., 4.})[0][0][1] == 1. && !v.is_constant() &&
              VectorExpression("1;2;3").is_constant() &&
              VectorExpression("0;0;1-1").is_zero() &&
              VectorExpression().is_zero(),
            "vectors: exact");
  }

  /// t is a number from the start.
  void
  check_time()
  {
    const Expression moving("x * t^2", "", 3.), factor("2 * t", "", 3.);
    const Point<3>   p(5., 0., 0.);
    verdict(moving.value(p) == 45. && moving.gradient(p)[0] == 9. &&
              moving.depends_on_time() && !moving.is_constant() &&
              factor.is_constant() && factor.depends_on_time() &&
              factor.value(p) == 6. && !Expression("x").depends_on_time() &&
              VectorExpression("t; 0; x", "", 0.5).value(p)[0] == 0.5 &&
              Expression("t").value(p) == 0.,
            "time: exact");
  }

  /// A sum of many terms is parsed and evaluated like a short one.
  void
  check_long_sum()
  {
    std::string text = "0*x";
    for (unsigned int i = 0; i < 300000; ++i)
      text += "+x";
    const double error =
      std::fabs(Expression(text).value(Point<3>(0.5, 0., 0.)) - 150000.);
    verdict(error == 0., "a sum of 300000 terms: exact", error);
  }

  /// @p text must be refused with a message that holds all of @p fragments.
  void
  refused(const std::string              &text,
          const std::vector<std::string> &fragments,
          const std::size_t               longest = 100000)
  {
    const std::string message = message_of([&] {
      if (text.find(';') != std::string::npos)
        VectorExpression(text, "Body force");
      else
        Expression(text, "Body force");
    });
    bool good = message.find("Body force: ") == 0 && message.size() <= longest;
    for (const std::string &fragment : fragments)
      good = good && message.find(fragment) != std::string::npos;
    verdict(good, "refused: " + text.substr(0, 30), message);
  }
} // namespace

int
main()
{
  check_derivatives();
  check_numbers();
  check_time();
  check_long_sum();
  refused("", {"character 1", "the end", "a number, a name"});
  refused("2*", {"character 3", "the end"});
  refused("sin(x", {"character 6", "')' is expected"});
  refused(
    "sine(x)",
    {"character 1", "'sine' is not known", "did you mean 'sin'", "atan2"});
  refused("x + w", {"character 5", "'w' is not known", "x, y, z, t, pi"});
  refused("2 x", {"character 3", "an operator or the end"});
  refused("x)", {"character 2"});
  refused("atan2(x)", {"character 8", "2 arguments"});
  refused("min(x,y,z)", {"character 8", "2 arguments"});
  refused("x ? y", {"':' is expected"});
  refused("x + 1/0", {"character 6", "not a finite number"});
  refused("log(-1)", {"character 1", "not a finite number"});
  refused("1e999", {"character 1"});
  for (const std::string number : {"1e-400", "1e-310"})
    refused("x + " + number,
            {"character 5 ('" + number + "')", "too small", "2.2e-308"});
  refused("x + " + std::string(100000, 'y'),
          {"\"x + yyyy", "yyy...\" (100004 characters)", "'yyyy"},
          1000);
  refused("x = 2", {"character 3"});
  refused("sin x", {"character 5", "'(' is expected"});
  refused(std::string(300, '(') + "x", {"200 deep"});
  refused("x; y; 2*", {"character 3"});
  refused("x; y; z; x", {"3 expressions", "got 4"});
}
