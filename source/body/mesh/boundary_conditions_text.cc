#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/boundary_selection.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    const char *const allowed_conditions =
      "entries \"name: condition\" separated by ';', the condition one of: plane x = 1 "
      "(or y, z); plane through x, y, z normal nx, ny, nz; box x0, y0, z0, x1, y1, "
      "z1; cylinder, sphere or free, each with radius r, near x, y, z, or both; "
      "faces 7, 9; named A, B; several joined by \"and\"";

    using Words = std::vector<std::string>;

    /// Blanks, commas and equal signs separate words.
    Words
    words_of(std::string text)
    {
      for (char &c : text)
        if (c == ',' || c == '=')
          c = ' ';
      std::istringstream in(text);
      Words              words;
      for (std::string word; in >> word;)
        words.push_back(word);
      return words;
    }

    /// Reads one condition, word by word.
    class ConditionReader
    {
    public:
      explicit ConditionReader(const Words &words)
        : words(words)
      {}

      /// False if the words are no condition.
      bool
      read(FaceCondition &condition)
      {
        if (words.empty())
          return false;
        condition.kind = words[next++];
        if (condition.kind == "plane")
          return read_plane(condition) && done();
        if (condition.kind == "box")
          return numbers(6, condition.numbers) && done();
        if (condition.kind == "faces" || condition.kind == "named")
          {
            condition.names.assign(words.begin() + next, words.end());
            return !condition.names.empty();
          }
        if (condition.kind != "cylinder" && condition.kind != "sphere" &&
            condition.kind != "free")
          return false;
        std::vector<double> radius;
        if (is("radius") && (condition.kind == "free" || !numbers(1, radius) ||
                             !(radius[0] > 0.)))
          return false;
        condition.radius = radius.empty() ? 0. : radius[0];
        if (is("near") && !numbers(3, condition.near))
          return false;
        return done();
      }

    private:
      bool
      read_plane(FaceCondition &condition)
      {
        for (unsigned int d = 0; d < 3; ++d)
          if (is(std::string(1, "xyz"[d])))
            {
              std::vector<double> value;
              if (!numbers(1, value))
                return false;
              condition.numbers.assign(6, 0.);
              condition.numbers[d]     = value[0];
              condition.numbers[3 + d] = 1.;
              return true;
            }
        return is("through") && numbers(3, condition.numbers) && is("normal") &&
               numbers(3, condition.numbers) &&
               std::hypot(condition.numbers[3],
                          condition.numbers[4],
                          condition.numbers[5]) > 0.;
      }

      bool
      is(const std::string &word)
      {
        const bool there = next < words.size() && words[next] == word;
        next += there;
        return there;
      }

      bool
      numbers(const unsigned int n, std::vector<double> &values)
      {
        for (unsigned int i = 0; i < n; ++i)
          {
            const ReadNumber number =
              read_number(next < words.size() ? words[next++] : "");
            if (!number.problem.empty() || !std::isfinite(number.value))
              return false;
            values.push_back(number.value);
          }
        return true;
      }

      bool
      done() const
      {
        return next == words.size();
      }

      const Words &words;
      std::size_t  next = 0;
    };
  } // namespace

  std::vector<BoundarySelection>
  parse_boundaries(const std::string &text, const std::string &where)
  {
    std::vector<BoundarySelection> entries;
    for (const std::string &part : Utilities::split_string_list(text, ';'))
      {
        if (part.empty())
          continue;
        const std::size_t colon = part.find(':');
        BoundarySelection entry;
        entry.text     = part;
        entry.boundary = Utilities::trim(part.substr(0, colon));
        Words      words;
        bool       good = !entry.boundary.empty() && colon != std::string::npos;
        const auto end_condition = [&] {
          entry.conditions.emplace_back();
          good = good && ConditionReader(words).read(entry.conditions.back());
          words.clear();
        };
        for (const std::string &word :
             words_of(colon == std::string::npos ? "" : part.substr(colon + 1)))
          if (word == "and")
            end_condition();
          else
            words.push_back(word);
        end_condition();
        if (!good)
          throw InputError(where + ": Boundaries has the entry " +
                           in_quotes(part, '\'') +
                           "; allowed: " + allowed_conditions);
        entries.push_back(entry);
      }
    return entries;
  }
} // namespace mortise
