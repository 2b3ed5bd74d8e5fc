// Cells as kernels compute them: several at once, one in each lane of a vector.
#pragma once

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>

#include <mortise/body/spaces/nodal_space.h>
#include <mortise/material/nonlinear_law.h>

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

  /// The cells of one body and degree, computed several at once.
  template <typename Number>
  struct CellBatches
  {
    CellBatches() = default;

    /// Of the owned cells with one element of a body; @p layout, @p pressures: as
    /// for MatrixFreeElasticity; @p law: null if linear; @p tangled: what is
    /// wrong with a cell, if anything.
    CellBatches(const NodalSpace                           &space,
                const Body                                 &body,
                unsigned int                                element,
                const dealii::Utilities::MPI::Partitioner  &layout,
                const PressureNodes                        *pressures,
                std::shared_ptr<const NonlinearLaw<Number>> law,
                std::string                                &tangled);

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
    std::shared_ptr<const NonlinearLaw<Number>> nonlinear;
    /// Its tangent at the points, [batch][point][modulus][lane], else empty.
    dealii::AlignedVector<Number> moduli;

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
