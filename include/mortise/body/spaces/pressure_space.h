// The pressures of a body in mixed form: continuous, one degree below the
// displacement of each cell (Taylor and Hood). Sources: Boffi, Brezzi, Fortin
// (2013), "Mixed finite element methods and applications", chapter 8.
#pragma once

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/hp/fe_collection.h>

#include <deal.II/lac/affine_constraints.h>

#include <mortise/base/types.h>
#include <mortise/body/spaces/entity_degrees.h>

#include <memory>

namespace mortise
{
  struct PressureSpace
  {
    using CellIterator = dealii::DoFHandler<dim>::active_cell_iterator;

    /// For the cells of @p displacement, whose degrees are above one; its
    /// triangulation is kept. Collective.
    explicit PressureSpace(const dealii::DoFHandler<dim> &displacement);

    /// @p cell, of any DoFHandler on the triangulation, of this one.
    CellIterator
    cell(const CellIterator &cell) const
    {
      return {&dof_handler.get_triangulation(),
              cell->level(),
              cell->index(),
              &dof_handler};
    }

    /// FE_Legendre or FE_SimplexLegendre (two orders of vertices each), rising
    /// degree.
    dealii::hp::FECollection<dim> fe;
    dealii::DoFHandler<dim>       dof_handler;
    /// Hanging nodes and mixed degrees, complete; left open.
    dealii::AffineConstraints<double> conformity;
    dealii::IndexSet relevant_dofs; ///< of owned and ghost cells, and masters
    std::unique_ptr<EntityDegrees> degrees;
  };
} // namespace mortise
