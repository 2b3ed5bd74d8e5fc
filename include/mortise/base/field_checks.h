// Checks of the values of fields of a scene: the first bad value is noted, and
// all ranks throw together later.
#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mpi.h>

#include <cmath>
#include <string>

namespace mortise
{
  class FieldChecks
  {
  public:
    /// @p value at @p x; 0 and a note if it is not finite or above
    /// largest_number in magnitude. @p what: where the field is given, and its
    /// text.
    double
    operator()(const double            value,
               const dealii::Point<3> &x,
               const std::string      &what)
    {
      return std::fabs(value) <= largest_number ? value : note(value, x, what);
    }

    /// A tensor, component by component.
    template <typename Tensor>
    Tensor
    all(const Tensor &value, const dealii::Point<3> &x, const std::string &what)
    {
      if (value.norm() <= largest_number)
        return value;
      constexpr double scale = 1e200; // squares of what is finite stay finite
      note(scale * (1. / scale * value).norm(), x, what);
      return Tensor();
    }

    /// Throw InputError on every rank of @p comm if any has noted something.
    /// Collective.
    void
    throw_if_any(MPI_Comm comm) const
    {
      mortise::throw_if_any(problem, comm);
    }

  private:
    double
    note(double value, const dealii::Point<3> &x, const std::string &what);

    std::string problem; ///< the first one
  };
} // namespace mortise
