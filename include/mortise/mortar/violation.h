// How much the sides of an interface break its law between the functions of the
// multipliers: as an energy, what a coupling that holds only in the mean costs;
// and how deep bodies are inside each other.
#pragma once

#include <mortise/mortar/interface_points.h>

#include <vector>

namespace mortise
{
  /// What multipliers put on one face, at a point of both sides.
  struct TractionAtPoint
  {
    dealii::Point<2>       xi; ///< as CellFace has it
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> normal;      ///< outward, of unit length
    dealii::Tensor<1, dim> traction;    ///< on this side, force per area
    double                 weight = 0.; ///< an area
    /// Components that have a multiplier; without it nothing moves there, and
    /// any traction is right.
    std::array<bool, dim> is_known{};

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &xi &x &normal &traction &weight &is_known;
    }
  };

  /// By owned face of a surface that has partners.
  struct TractionsOnFace
  {
    Body::CellIterator           cell;
    unsigned int                 number = 0; ///< of the face
    std::vector<TractionAtPoint> points;
  };
  using TractionsOnFaces = std::vector<TractionsOnFace>;

  struct Violations
  {
    std::vector<double> energies; ///< by slave face
    TractionsOnFaces    on_slave, on_master;
    /// By owned face of the slave and of the master: part of it presses, part
    /// is open.
    std::vector<bool> slave_at_edge, master_at_edge;
    double            penetration = 0.; ///< largest_penetration()
  };

  /// Twice the energy that it takes to mend what is broken, by slave face: the
  /// integral of InterfaceLaw::violation(). With the wave number k = pi p / h
  /// of what multipliers of degree p on faces with sides of h leave,
  /// half-spaces have c = k / (2 (1/E_1 + 1/E_2)). A cell of depth t behind a
  /// face may be all of a body, which bends: but under contact E times (k t)^3
  /// / 6, if that
  /// is less. @p tractions: multiplier_on_faces(). Clips again. Collective.
  Violations
  violation_energies(const Coupling                         &coupling,
                     const TraceDisplacement                &displacement,
                     const std::vector<std::vector<double>> &tractions,
                     const Offset                           &offset,
                     MPI_Comm                                comm);

  /// The most by which the surfaces overlap at the quadrature points of the
  /// interface, along the normals of the slave's faces; zero where they do not.
  /// A length. Clips again. Collective.
  double
  largest_penetration(const Coupling          &coupling,
                      const TraceDisplacement &displacement,
                      const Offset            &offset,
                      MPI_Comm                 comm);
} // namespace mortise
