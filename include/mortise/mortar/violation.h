// How much the sides of an interface break its law between the functions of the
// multipliers, as an energy: what a coupling that holds only in the mean costs.
#pragma once

#include <mortise/mortar/displacement_jump.h>

#include <functional>
#include <vector>

namespace mortise
{
  struct GapOfSurfaces
  {
    /// Left between bodies, at points of the slave, a length; empty: none.
    std::function<double(const dealii::Point<dim> &position)> offset;
    bool of_meshes = true; ///< does that between the meshes count?

    /// Along the slave's @p normal at point @p q, where sides have moved by @p jump.
    double
    open(const IntegrationPoints      &points,
         unsigned int                  q,
         const dealii::Tensor<1, dim> &normal,
         const dealii::Tensor<1, dim> &jump) const;
  };

  /// What an interface is to do.
  struct InterfaceLaw
  {
    GapOfSurfaces gap;
    /// Of springs, at points of the slave; empty: none.
    std::function<Stiffness(const dealii::Point<dim> &)> stiffness;
  };

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
  };

  /// Twice the energy that it takes to mend what is broken, by slave face. With
  /// a length d by which sides are apart or inside each other at a point, and
  /// the wave number k = pi p / h of what multipliers of degree p on faces with
  /// sides of h leave, two half-spaces take c d^2 per area, c = k / (2 (1/E_1 +
  /// 1/E_2)), and a traction t that is not to be there t^2 / c. A cell of depth
  /// t behind a face may be all of a body, which bends: but under contact E
  /// times (k t)^3 / 6, if that is less. Ties: d is the jump of the
  /// displacement, sliding: along the normal; springs of stiffness K: it is
  /// beside what they give way, and they give way further: c (d / (1 + c/K))^2;
  /// contact: overlaps, tension, and of gap and
  /// pressure at the same point what is less. @p tractions: multiplier_on_faces(). Clips again. Collective.
  Violations
  violation_energies(const Coupling                         &coupling,
                     const TraceDisplacement                &displacement,
                     const std::vector<std::vector<double>> &tractions,
                     const InterfaceLaw                     &law,
                     MPI_Comm                                comm);
} // namespace mortise
