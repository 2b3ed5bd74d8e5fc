// Violation of an interface law at quadrature points, where multipliers enforce
// it in the mean only: its energy, and the largest penetration.
#pragma once

#include <mortise/mortar/interface_points.h>

#include <vector>

namespace mortise
{
  /// Traction of the multipliers on one side at a point.
  struct TractionAtPoint
  {
    dealii::Point<2>       xi; ///< as CellFace has it
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> normal;      ///< outward, of unit length
    dealii::Tensor<1, dim> traction;    ///< on this side, force per area
    double                 weight = 0.; ///< an area
    /// Components with a multiplier; in others displacements are prescribed and
    /// any traction is admissible.
    std::array<bool, dim> is_known{};

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &xi &x &normal &traction &weight &is_known;
    }
  };

  /// Tractions on an owned face with partners.
  struct TractionsOnFace
  {
    Body::CellIterator           cell;
    unsigned int                 number = 0; ///< of the face
    std::vector<TractionAtPoint> points;
  };
  using TractionsOnFaces = std::vector<TractionsOnFace>;

  struct InterfaceEvaluation
  {
    std::vector<double> energies; ///< by slave face
    TractionsOnFaces    on_slave, on_master;
    /// By owned face of the slave and of the master: is part of it active and
    /// part inactive?
    std::vector<bool> slave_at_edge, master_at_edge;
    double            penetration = 0.; ///< largest_penetration()
  };

  /// By slave face: the integral of InterfaceLaw::violation() with c = k / (2
  /// (1/E_1 + 1/E_2)) of half-spaces, k = pi p / h the wave number of errors
  /// with multipliers of degree p on faces of size h. Except in contact, E is E
  /// (k t)^3 / 6 if that is less, since a body may be one cell of depth t that
  /// bends. @p tractions: multiplier_on_faces(). Clips again. Collective.
  InterfaceEvaluation
  evaluate_interface(const Coupling                         &coupling,
                     const TraceDisplacement                &displacement,
                     const std::vector<std::vector<double>> &tractions,
                     const Offset                           &offset,
                     const BoundOfFriction                  &friction,
                     MPI_Comm                                comm);

  /// Largest penetration at the quadrature points along the normals of the
  /// slave's faces, a length; zero without. Clips again. Collective.
  double
  largest_penetration(const Coupling          &coupling,
                      const TraceDisplacement &displacement,
                      const Offset            &offset,
                      MPI_Comm                 comm);
} // namespace mortise
