// Recursive descent over the grammar in expression.h, folding constants on the
// way.

#include <deal.II/base/numbers.h>

#include <mortise/base/error.h>
#include <mortise/base/expression.h>
#include <mortise/base/quotes.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace mortise
{
  namespace
  {
    using Operation = Expression::Operation;
    using Node      = Expression::Node;

    struct Name
    {
      const char *text;
      Operation   operation;
    };

    constexpr Name variables[] = {{"x", Operation::x},
                                  {"y", Operation::y},
                                  {"z", Operation::z}};

    constexpr Name functions[] = {{"sin", Operation::sin},
                                  {"cos", Operation::cos},
                                  {"tan", Operation::tan},
                                  {"asin", Operation::asin},
                                  {"acos", Operation::acos},
                                  {"atan", Operation::atan},
                                  {"sinh", Operation::sinh},
                                  {"cosh", Operation::cosh},
                                  {"tanh", Operation::tanh},
                                  {"exp", Operation::exp},
                                  {"log", Operation::log},
                                  {"sqrt", Operation::sqrt},
                                  {"abs", Operation::abs},
                                  {"atan2", Operation::atan2},
                                  {"min", Operation::min},
                                  {"max", Operation::max},
                                  {"pow", Operation::power},
                                  {"if", Operation::select}};

    /// Binary operators by level, weakest first; all group from left to right.
    constexpr Name operators[][6] = {
      {{"||", Operation::either}},
      {{"&&", Operation::both}},
      {{"<=", Operation::less_equal},
       {">=", Operation::greater_equal},
       {"==", Operation::equal},
       {"!=", Operation::not_equal},
       {"<", Operation::less},
       {">", Operation::greater}},
      {{"+", Operation::add}, {"-", Operation::subtract}},
      {{"*", Operation::multiply}, {"/", Operation::divide}}};
    constexpr unsigned int n_levels = sizeof(operators) / sizeof(operators[0]);

    class Parser
    {
    public:
      Parser(const std::string &text,
             const std::string &where,
             const double       time)
        : text(text)
        , where(where)
        , time(time)
      {}

      std::vector<Node>
      parse()
      {
        const unsigned int root = conditional();
        skip_space();
        if (position < text.size())
          fail(position, "an operator or the end is expected here");
        return compact(root);
      }

      bool has_time = false; ///< found t

    private:
      [[noreturn]] void
      fail(const std::size_t at, const std::string &what) const
      {
        std::string got = "the end";
        if (at < text.size())
          got =
            "'" + text.substr(at, 12) + (at + 12 < text.size() ? "...'" : "'");
        throw InputError((where.empty() ? "" : where + ": ") +
                         "in the expression " + in_quotes(text) +
                         ", at character " + std::to_string(at + 1) + " (" +
                         got + "): " + what);
      }

      void
      skip_space()
      {
        while (position < text.size() &&
               std::isspace(static_cast<unsigned char>(text[position])))
          ++position;
      }

      /// Step over @p token if it comes next.
      bool
      accept(const std::string &token)
      {
        skip_space();
        if (text.compare(position, token.size(), token) != 0)
          return false;
        position += token.size();
        return true;
      }

      void
      expect(const std::string &token)
      {
        if (!accept(token))
          fail(position, "'" + token + "' is expected here");
      }

      unsigned int
      constant(const double value)
      {
        nodes.emplace_back();
        nodes.back().constant = value;
        return nodes.size() - 1;
      }

      /// A new operation; folded if all operands are constants. @p at: where it stands.
      unsigned int
      make(const Operation                    operation,
           const std::array<unsigned int, 3> &operands,
           const std::size_t                  at)
      {
        const unsigned int n          = Expression::n_operands(operation);
        bool               foldable   = n > 0;
        double             numbers[3] = {0., 0., 0.};
        for (unsigned int i = 0; i < n; ++i)
          {
            foldable =
              foldable && nodes[operands[i]].operation == Operation::constant;
            numbers[i] = nodes[operands[i]].constant;
          }
        if (foldable)
          {
            const double value =
              Expression::apply(operation, numbers[0], numbers[1], numbers[2]);
            if (!std::isfinite(value))
              fail(at,
                   "the value of this constant part is not a finite number");
            return constant(value);
          }
        // A condition that is constant leaves its branch.
        if (operation == Operation::select &&
            nodes[operands[0]].operation == Operation::constant)
          return numbers[0] != 0. ? operands[1] : operands[2];
        nodes.emplace_back();
        nodes.back().operation = operation;
        nodes.back().operands  = operands;
        return nodes.size() - 1;
      }

      unsigned int
      conditional()
      {
        if (++depth > 200)
          fail(position, "parentheses are nested more than 200 deep");
        unsigned int node = binary(0);
        skip_space();
        const std::size_t at = position;
        if (accept("?"))
          {
            const unsigned int yes = conditional();
            expect(":");
            const unsigned int no = conditional();
            node = make(Operation::select, {{node, yes, no}}, at);
          }
        --depth;
        return node;
      }

      unsigned int
      binary(const unsigned int level)
      {
        if (level == n_levels)
          return unary();
        unsigned int node = binary(level + 1);
        for (bool found = true; found;)
          {
            found = false;
            skip_space();
            const std::size_t at = position;
            for (const Name &name : operators[level])
              if (!found && name.text != nullptr && accept(name.text))
                {
                  found = true;
                  node =
                    make(name.operation, {{node, binary(level + 1), 0}}, at);
                }
          }
        return node;
      }

      unsigned int
      unary()
      {
        if (++signs > 200)
          fail(position, "signs are nested more than 200 deep");
        skip_space();
        const std::size_t at = position;
        unsigned int      node;
        if (accept("+"))
          node = unary();
        else if (accept("-"))
          node = make(Operation::minus, {{unary(), 0, 0}}, at);
        else if (accept("!"))
          node = make(Operation::negate, {{unary(), 0, 0}}, at);
        else
          {
            node = primary();
            skip_space();
            const std::size_t hat = position;
            if (accept("^")) // binds tighter than a sign before it, looser than
                             // one after it
              node = make(Operation::power, {{node, unary(), 0}}, hat);
          }
        --signs;
        return node;
      }

      unsigned int
      primary()
      {
        skip_space();
        if (accept("("))
          {
            const unsigned int node = conditional();
            expect(")");
            return node;
          }
        const char next = position < text.size() ? text[position] : '\0';
        if (std::isdigit(static_cast<unsigned char>(next)) || next == '.')
          return number();
        if (std::isalpha(static_cast<unsigned char>(next)) || next == '_')
          return name();
        fail(position, "a number, a name, a sign or '(' is expected here");
      }

      unsigned int
      number()
      {
        double      value = 0.;
        const char *begin = text.data() + position;
        const auto [end, error] =
          std::from_chars(begin, text.data() + text.size(), value);
        // a number too small to be represented in full would lose digits, or
        // become 0, without a word
        constexpr double smallest = std::numeric_limits<double>::min();
        if (error != std::errc() || (value != 0. && value < smallest))
          fail(position,
               "this number is too large or too small; allowed: 0, or from "
               "2.2e-308 to 1.7e308");
        position += end - begin;
        return constant(value);
      }

      unsigned int
      name()
      {
        const std::size_t at = position;
        while (position < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[position])) ||
                text[position] == '_'))
          ++position;
        const std::string word = text.substr(at, position - at);
        if (word == "pi")
          return constant(dealii::numbers::PI);
        if (word == "t")
          {
            has_time = true;
            return constant(time);
          }
        for (const Name &variable : variables)
          if (word == variable.text)
            return make(variable.operation, {}, at);
        for (const Name &function : functions)
          if (word == function.text)
            return make(function.operation, arguments(function), at);
        unknown(word, at);
      }

      std::array<unsigned int, 3>
      arguments(const Name &function)
      {
        const unsigned int n = Expression::n_operands(function.operation);
        std::array<unsigned int, 3> operands{};
        expect("(");
        for (unsigned int i = 0; i < n; ++i)
          {
            if (i > 0 && !accept(","))
              fail(position,
                   std::string(function.text) + " takes " + std::to_string(n) +
                     " arguments separated by ','");
            operands[i] = conditional();
          }
        if (!accept(")"))
          fail(position,
               "')' is expected here; " + std::string(function.text) +
                 " takes " + std::to_string(n) +
                 (n == 1 ? " argument" : " arguments"));
        return operands;
      }

      [[noreturn]] void
      unknown(const std::string &word, const std::size_t at) const
      {
        std::vector<std::string> known;
        for (const Name &variable : variables)
          known.emplace_back(variable.text);
        known.emplace_back("t");
        known.emplace_back("pi");
        for (const Name &function : functions)
          known.emplace_back(function.text);
        const std::string nearest = nearest_name(word, known);
        fail(at,
             in_quotes(word, '\'') + " is not known" +
               (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
               " Known: " + join_names(known));
      }

      /// The nodes that @p root needs, itself last. Not by recursion: a sum of
      /// many terms is as deep as it is long.
      std::vector<Node>
      compact(const unsigned int root) const
      {
        std::vector<bool> used(nodes.size(), false);
        used[root] = true;
        for (unsigned int n = root + 1; n-- > 0;) // operands come before
          for (unsigned int i = 0;
               used[n] && i < Expression::n_operands(nodes[n].operation);
               ++i)
            used[nodes[n].operands[i]] = true;
        std::vector<Node>         result;
        std::vector<unsigned int> place(root + 1, 0);
        for (unsigned int n = 0; n <= root; ++n)
          if (used[n])
            {
              place[n] = result.size();
              result.push_back(nodes[n]);
              for (unsigned int &operand : result.back().operands)
                operand = place[operand];
            }
        return result;
      }

      const std::string &text;
      const std::string &where;
      const double       time;
      std::size_t        position = 0;
      unsigned int       depth    = 0;
      unsigned int       signs    = 0;
      std::vector<Node>  nodes; ///< as parsed, folded parts included
    };
  } // namespace

  void
  Expression::parse(const std::string &text,
                    const std::string &where,
                    const double       time)
  {
    Parser parser(text, where, time);
    nodes    = parser.parse();
    has_time = parser.has_time;
  }
} // namespace mortise
