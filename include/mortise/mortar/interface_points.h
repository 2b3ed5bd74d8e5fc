// Evaluation of both sides of an interface at its quadrature points.
#pragma once

#include <mortise/mortar/coupling.h>

#include <array>
#include <functional>
#include <vector>

namespace mortise
{
  /// Displacement in the numbering of the traces.
  struct TraceDisplacement
  {
    Vector free;       ///< owned coefficients
    Vector prescribed; ///< added to them
  };

  /// What the sides are apart in addition to the mesh gap, a length.
  struct Offset
  {
    /// The gap at points of the slave; null: zero.
    std::function<double(const dealii::Point<dim> &position)> gap;
    /// u_slave - Q u_master of a periodic tie.
    dealii::Tensor<1, dim> jump;
  };

  /// The bound of tangential tractions at points of the slave; null: none.
  using BoundOfFriction =
    std::function<FrictionBound(const dealii::Point<dim> &position)>;

  class InterfacePoints
  {
  public:
    /// @p coupling must live on; it is undeformed, or has the present
    /// @p displacement, so that there are no jumps but its gaps. @p offset is
    /// kept. Collective.
    InterfacePoints(const Coupling          &coupling,
                    const TraceDisplacement &displacement,
                    const Offset            &offset,
                    MPI_Comm                 comm);

    /// Choose the slave face.
    void
    reinit(unsigned int slave);

    /// Point @p q of @p points, common to the slave face and the master face
    /// @p m; without its traction.
    InterfacePoint
    operator()(unsigned int m, const IntegrationPoints &points, unsigned int q);

  private:
    /// By component and function of a face.
    using Coefficients = std::array<std::vector<double>, dim>;

    Coefficients
    coefficients(const FaceTrace &trace) const;
    dealii::Tensor<1, dim>
    value(const TraceBasis       &basis,
          const Coefficients     &coefficients,
          const dealii::Point<2> &xi);

    const InterfaceHandler   &interface;
    const RigidMotion        &placement;
    const Offset              offset;
    Vector                    free, prescribed;
    std::vector<Coefficients> masters;
    unsigned int              slave = 0;
    Coefficients              of_slave;
    std::vector<double>       values; ///< of functions
  };
} // namespace mortise
