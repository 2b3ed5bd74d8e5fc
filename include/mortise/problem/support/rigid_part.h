// A part of a scene that moves as a rigid one: a boundary, or the surface of a
// body. Its motion is that of a reference point, six numbers, of which supports
// prescribe some and the equilibrium decides the others. Rotations by any angle
// have the matrix exp(w x) (Rodrigues), which changes along d w by
// (T d w) x exp(w x), T the left Jacobian of rotations.
#pragma once

#include <mortise/problem/support/rigid_support.h>

#include <string>
#include <vector>

namespace mortise
{
  /// Displacements value + gradient (x - centre).
  struct AffineField
  {
    dealii::Tensor<1, dim> value;
    dealii::Tensor<2, dim> gradient;
  };

  struct RigidPart
  {
    std::string                             name;
    unsigned int                            body;
    std::vector<dealii::types::boundary_id> boundaries;
    /// Its centre is the reference point.
    Extent where;
    /// May it turn by any angle? Motions have a rotation vector then, else
    /// a linear one.
    bool is_finite = false;
    /// Orthonormal: motions that nothing prescribes.
    std::vector<Motion> free = {};
    /// The prescribed motion, orthogonal to these.
    Motion given = {};
    /// A force and a moment at a point of the undeformed part, which keep their
    /// directions.
    struct PointLoad
    {
      std::string            boundary; ///< that is coupled to the point
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> force, moment;
    };
    std::vector<PointLoad> loads = {};

    /// The displacements by @p motion.
    AffineField
    displacement(const Motion &motion) const;

    /// Their change along @p direction from @p motion on, and the rotation of the
    /// part with it, in space.
    AffineField
    change(const Motion           &motion,
           const Motion           &direction,
           dealii::Tensor<1, dim> *rotation = nullptr) const;

    /// The work of the loads on that.
    double
    work(const Motion &motion, const Motion &direction) const;

    /// Its motion by that of the whole @p body, which does not turn far.
    std::array<Motion, 6>
    rows_of(const Extent &body) const;
  };

  /// Of the prescribed displacements of one body, or a piece of it, with what
  /// is prescribed of the rigid ones of @p parts; pieces are taken to be held by
  /// these. Collective.
  Support
  support_of(const Body                            &body,
             const std::vector<DirichletCondition> &dirichlet,
             const std::vector<RigidPart>          &parts,
             const Extent                          &where,
             const PartOfBody                      &piece = {});

  /// The boundaries of @p body, also of other ranks. Collective.
  std::vector<dealii::types::boundary_id>
  all_boundaries(const Body &body);
} // namespace mortise
