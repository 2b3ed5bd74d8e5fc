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
    /// At finite strain.
    using Stored = StoredTangent<Number, TangentForm::full_finite>;

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
    /// Its tangent at the points, the n_stored() numbers of its form as
    /// [batch][point][number][lane], else empty: that of small strain or that
    /// of finite strain, see StoredTangent.
    dealii::AlignedVector<Number> tangent;
    dealii::AlignedVector<Stored> finite_tangent;
    /// In mixed form sqrt(w |J|) and the slope of
    /// NonlinearLaw::dilatation_of_pressure() as [batch][point][2][lane].
    dealii::AlignedVector<Number> pressure_tangent;
    /// At finite strain the metric of the tangent, dxi_a/dx_e sqrt(w |J|) with
    /// deformed coordinates x but the volume |J| of undeformed cells.
    dealii::AlignedVector<Number> deformed_metric;

    /// The tangent of a law of this form.
    template <TangentForm form>
    StoredTangent<Number, form> *
    tangent_of()
    {
      if constexpr (is_finite(form))
        return finite_tangent.data();
      else
        return tangent.data();
    }

    template <TangentForm form>
    const StoredTangent<Number, form> *
    tangent_of() const
    {
      return const_cast<CellBatches &>(*this).tangent_of<form>();
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
