// The sides of an interface at its quadrature points, where bodies are
// displaced.
#pragma once

#include <mortise/mortar/coupling.h>

#include <array>
#include <functional>
#include <vector>

namespace mortise
{
  /// In the numbering of the traces.
  struct TraceDisplacement
  {
    Vector free;       ///< coefficients; those of others do not matter
    Vector prescribed; ///< what is added to these
  };

  /// The gap that is left between bodies beside that of their meshes, at points
  /// of the slave, a length; null: none.
  using Offset = std::function<double(const dealii::Point<dim> &position)>;

  class InterfacePoints
  {
  public:
    /// @p interface must live on; @p offset is kept. Collective.
    InterfacePoints(const InterfaceHandler  &interface,
                    const TraceDisplacement &displacement,
                    const Offset            &offset,
                    MPI_Comm                 comm);

    /// Choose the slave face of the points to come.
    void
    reinit(unsigned int slave);

    /// Point @p q of @p points, which the slave face and the master face @p m share, without a
    /// traction.
    InterfacePoint
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
    const Offset              offset;
    Vector                    free, prescribed;
    std::vector<Coefficients> masters;
    unsigned int              slave = 0;
    Coefficients              of_slave;
    std::vector<double>       values; ///< of functions
  };
} // namespace mortise
