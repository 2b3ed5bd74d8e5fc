// How far the sides of an interface have moved against each other at its
// quadrature points.
#pragma once

#include <mortise/mortar/coupling.h>

#include <array>
#include <vector>

namespace mortise
{
  /// In the numbering of the traces.
  struct TraceDisplacement
  {
    Vector free;       ///< coefficients; those of others do not matter
    Vector prescribed; ///< what is added to these
  };

  class DisplacementJump
  {
  public:
    /// @p interface must live on. Collective.
    DisplacementJump(const InterfaceHandler  &interface,
                     const TraceDisplacement &displacement,
                     MPI_Comm                 comm);

    /// Choose the slave face of the points to come.
    void
    reinit(unsigned int slave);

    /// Displacement of the master face @p m less that of the slave at point @p q of @p points, which
    /// are those of both; a length.
    dealii::Tensor<1, dim>
    operator()(unsigned int m, const IntegrationPoints &points, unsigned int q);

  private:
    /// Of the functions of a face, by component.
    using Coefficients = std::array<std::vector<double>, dim>;

    Coefficients
    coefficients(const FaceTrace &trace) const;
    dealii::Tensor<1, dim>
    value(const TraceBasis       &basis,
          const Coefficients     &coefficients,
          const dealii::Point<2> &xi);

    const InterfaceHandler   &interface;
    Vector                    free, prescribed;
    std::vector<Coefficients> masters;
    unsigned int              slave = 0;
    Coefficients              of_slave;
    std::vector<double>       values; ///< of functions
  };
} // namespace mortise
