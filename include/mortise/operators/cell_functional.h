// A linear functional of the fields of one body, cell by cell.
#pragma once

#include <deal.II/lac/vector.h>

#include <mortise/body/body.h>

#include <vector>

namespace mortise
{
  /// Factors of the coefficients of an owned cell: of the displacement in the
  /// order of its element, in mixed form of the pressure in that of its
  /// element.
  struct CellFunctional
  {
    Body::CellIterator     cell;
    dealii::Vector<double> displacement, pressure;
  };

  /// The sum over the cells that it is not zero on.
  using CellFunctionals = std::vector<CellFunctional>;
} // namespace mortise
