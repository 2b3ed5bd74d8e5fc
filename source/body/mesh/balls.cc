// See balls.h.
#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/balls.h>

#include <cmath>
#include <sstream>

namespace mortise
{
  std::vector<Ball>
  parse_balls(const std::string &text,
              const std::string &where,
              const std::string &number,
              const unsigned int most)
  {
    std::vector<Ball> balls;
    for (const std::string &entry :
         dealii::Utilities::split_string_list(text, ';'))
      {
        if (entry.empty())
          continue;
        std::vector<double> numbers;
        bool                good = true;
        for (const std::string &part :
             dealii::Utilities::split_string_list(entry, ','))
          {
            const ReadNumber read = read_number(part);
            good                  = good && read.problem.empty();
            numbers.push_back(read.value);
          }
        if (!(good && numbers.size() == 5 && numbers[3] > 0. &&
              numbers[4] >= 1. && numbers[4] <= most &&
              numbers[4] == std::floor(numbers[4])))
          throw InputError(where + " has the entry " + in_quotes(entry, '\'') +
                           "; allowed: x, y, z, radius, " + number +
                           "; with radius > 0 and " + number +
                           " a whole number from 1 to " + std::to_string(most) +
                           ", entries separated by ';'");
        balls.push_back({dealii::Point<3>(numbers[0], numbers[1], numbers[2]),
                         numbers[3],
                         static_cast<unsigned int>(numbers[4])});
      }
    return balls;
  }

  void
  fail_untouched(const Ball &ball, const std::string &where)
  {
    std::ostringstream message;
    message << where << " finds no cell with its centre or a vertex within "
            << ball.radius << " of (" << ball.centre
            << "); allowed: a ball that meets the body where it stands after "
               "Rotate and Translate";
    throw InputError(message.str());
  }
} // namespace mortise
