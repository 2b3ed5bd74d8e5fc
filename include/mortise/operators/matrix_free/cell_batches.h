// Cells as kernels compute them: several at once, one in each lane of a vector.
#pragma once

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>

#include <mortise/body/spaces/nodal_space.h>
#include <mortise/material/nonlinear_law.h>
#include <mortise/material/tangent_form.h>

#include <memory>
#include <string>

namespace mortise
{
  /// The pressures that belong to a space of displacements.
  struct PressureNodes
  {
    const NodalSpace                          &space;
    const dealii::Utilities::MPI::Partitioner &layout; ///< node n has index n
  };

  /// The rule of the stiffness of cells with @p element of a body, with functions
  /// of @p degree, on the reference cell; on tetrahedra its points have the same
  /// barycentric coordinates by ascending vertices, whatever their order.
  template <typename Number>
  dealii::Quadrature<dim>
  cell_rule(const Body &body, unsigned int element, unsigned int degree);

  /// The cells of one body and degree, computed several at once.
  template <typename Number>
  struct CellBatches
  {
    CellBatches() = default;

    /// Of the owned cells with one element of a body; @p layout, @p pressures: as
    /// for MatrixFreeElasticity; @p tangled: what is wrong with a cell, if
    /// anything.
    CellBatches(const NodalSpace                          &space,
                const Body                                &body,
                unsigned int                               element,
                const dealii::Utilities::MPI::Partitioner &layout,
                const PressureNodes                       *pressures,
                std::string                               &tangled);

    bool         tetrahedra = false;
    unsigned int degree     = 1;
    /// Per cell; points only of cells with a Jacobian that varies.
    unsigned int     n_nodes = 0, n_pressure_nodes = 0, n_points = 0;
    PointLaw<Number> law;
    unsigned int     n_cells = 0;
    /// Batches with constant Jacobians come first.
    unsigned int n_affine = 0, n_batches = 0;
    unsigned int n_affine_cells = 0;
    /// [batch][node][lane]: index of the first component. Nodes of hexahedra
    /// are lexicographic, those of tetrahedra in the order of simplex_nodes().
    /// Lanes without a cell repeat the first and have no metric.
    dealii::AlignedVector<unsigned int> nodes;
    /// The same of the pressures in mixed form, of one degree less, else empty:
    /// indices.
    dealii::AlignedVector<unsigned int> pressure_nodes;
    double compressibility = 0., pressure_norm = 0.;
    /// dxi_a/dx_e sqrt(|J|) as [batch][a][e][lane] on affine cells; after these
    /// dxi_a/dx_e sqrt(w |J|) as [batch][point][a][e][lane]. On tetrahedra xi
    /// are the barycentric coordinates of the second to last ascending vertex,
    /// or on curved ones those of simplex_rule().
    dealii::AlignedVector<Number> metric;

    /// Of a body whose law is not linear, else null; all its cells count as
    /// curved.
    std::shared_ptr<const NonlinearLaw> nonlinear;
    /// Its tangent at the points, [batch][point][number][lane], else empty: the
    /// n_tangent() numbers of its form, and in mixed form sqrt(w |J|) and the
    /// slope of NonlinearLaw::dilatation_of_pressure().
    dealii::AlignedVector<Number> tangent;
    /// At finite strain the metric of the tangent, dxi_a/dx_e sqrt(w |J|) with
    /// deformed coordinates x but the volume |J| of undeformed cells.
    dealii::AlignedVector<Number> deformed_metric;

    /// Numbers of tangent at a point.
    unsigned int
    n_numbers() const
    {
      return n_tangent(nonlinear->form()) + (n_pressure_nodes == 0 ? 0 : 2);
    }

    /// Cells of a batch.
    unsigned int
    lanes(unsigned int batch) const;

    const Number *
    metric_of(unsigned int batch) const;

    const unsigned int *
    nodes_of(const unsigned int batch) const
    {
      return &nodes[std::size_t(batch) * n_nodes * Batch<Number>::size];
    }

    const unsigned int *
    pressure_nodes_of(const unsigned int batch) const
    {
      return &pressure_nodes[std::size_t(batch) * n_pressure_nodes *
                             Batch<Number>::size];
    }
  };
} // namespace mortise
