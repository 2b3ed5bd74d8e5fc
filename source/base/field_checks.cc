#include <mortise/base/field_checks.h>

#include <cmath>
#include <sstream>

namespace mortise
{
  double
  FieldChecks::note(const double            value,
                    const dealii::Point<3> &x,
                    const std::string      &what)
  {
    if (problem.empty())
      {
        std::ostringstream text;
        text << what << " is ";
        if (std::isnan(value)) // without the sign that some write
          text << "nan";
        else
          text << value;
        text << " at (" << x[0] << ", " << x[1] << ", " << x[2]
             << "); allowed: finite numbers of at most " << largest_number
             << " in magnitude at every point of the body";
        problem = text.str();
      }
    return 0.;
  }
} // namespace mortise
