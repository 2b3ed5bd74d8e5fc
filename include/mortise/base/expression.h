// Expressions in x, y, z with exact first and second derivatives, at a fixed
// time t.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace mortise
{
  /// A scalar expression of the position. Grammar, from weak to strong binding:
  ///   c ? a : b    ||    &&    < <= > >= == !=    + -    * /    unary + - ! ^
  ///   (right to left)
  /// with numbers, parentheses, the variables x, y, z, the time t, the constant
  /// pi and the functions
  ///   sin cos tan asin acos atan sinh cosh tanh exp log sqrt abs   (one
  ///   argument) atan2 min max pow (two)   if(condition, then, else) (three;
  ///   the branch not taken may be undefined).
  /// -x^2 is -(x^2). Comparisons give 0 or 1. Constant parts are folded when
  /// parsing. At a kink (abs, min, max, a comparison) the derivatives are those
  /// of the branch taken.
  class Expression
  {
  public:
    /// The constant zero.
    Expression();

    /// Parse @p text, for the given time; @p where names the parameter in messages. Throws
    /// InputError with the position of the first character that is not
    /// understood and what is allowed there.
    explicit Expression(const std::string &text,
                        const std::string &where = "",
                        double             time  = 0.);

    double
    value(const dealii::Point<3> &p) const;

    /// Derivatives with respect to x, y, z.
    dealii::Tensor<1, 3>
    gradient(const dealii::Point<3> &p) const;

    dealii::SymmetricTensor<2, 3>
    hessian(const dealii::Point<3> &p) const;

    /// Whether the value is the same at every point (after folding).
    bool
    is_constant() const
    {
      return nodes.size() == 1 && nodes[0].operation == Operation::constant;
    }

    /// Whether the text says t, so that another time may give other values.
    bool
    depends_on_time() const
    {
      return has_time;
    }

    /// Operation of a node, by number of operands: none, one, two, three.
    enum class Operation : unsigned char
    {
      // clang-format off
      constant, x, y, z,
      minus, negate, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, exp, log, sqrt, abs,
      add, subtract, multiply, divide, power, atan2, min, max,
      less, less_equal, greater, greater_equal, equal, not_equal, both, either,
      select
      // clang-format on
    };

    static unsigned int
    n_operands(Operation operation);

    /// Value of an operation on numbers; operands that it does not have are
    /// ignored.
    static double
    apply(Operation operation, double a, double b = 0., double c = 0.);

    /// One node of the syntax tree: an operation on earlier nodes.
    struct Node
    {
      Operation                   operation = Operation::constant;
      std::array<unsigned int, 3> operands{};
      double                      constant = 0.;
    };

  private:
    /// Sets all members. In source/base/expression_parser.cc.
    void
    parse(const std::string &text, const std::string &where, double time);

    std::vector<Node>
         nodes; ///< operands before operations; the last is the root
    bool has_time = false;
  };

  /// Three expressions, the components of a vector.
  class VectorExpression
  {
  public:
    /// The constant zero.
    VectorExpression() = default;

    /// Parse "ex; ey; ez" for the given time. Throws InputError as Expression
    /// does, and for another number of parts.
    explicit VectorExpression(const std::string &text,
                              const std::string &where = "",
                              double             time  = 0.);

    dealii::Tensor<1, 3>
    value(const dealii::Point<3> &p) const
    {
      dealii::Tensor<1, 3> v;
      for (unsigned int c = 0; c < 3; ++c)
        v[c] = components[c].value(p);
      return v;
    }

    /// gradient[i][j] = d v_i / d x_j.
    dealii::Tensor<2, 3>
    gradient(const dealii::Point<3> &p) const
    {
      dealii::Tensor<2, 3> g;
      for (unsigned int c = 0; c < 3; ++c)
        g[c] = components[c].gradient(p);
      return g;
    }

    /// hessian[i] = second derivatives of v_i.
    std::array<dealii::SymmetricTensor<2, 3>, 3>
    hessian(const dealii::Point<3> &p) const
    {
      return {{components[0].hessian(p),
               components[1].hessian(p),
               components[2].hessian(p)}};
    }

    bool
    is_constant() const
    {
      return components[0].is_constant() && components[1].is_constant() &&
             components[2].is_constant();
    }

    /// Whether the value is zero at every point.
    bool
    is_zero() const
    {
      return is_constant() && value(dealii::Point<3>()).norm_square() == 0.;
    }

    const Expression &
    operator[](unsigned int component) const
    {
      AssertIndexRange(component, 3);
      return components[component];
    }

  private:
    std::array<Expression, 3> components;
  };
} // namespace mortise
