// Iterates in terms that do not depend on the pairs of the bodies.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/problem/scene/pairing.h>

#include <map>
#include <string>
#include <vector>

namespace mortise
{
  /// By name of an interface: multiplier_coefficients(), in axes that follow
  /// the bodies if there is friction.
  using MultipliersByFace =
    std::map<std::string, std::vector<std::vector<double>>>;

  struct Iterate
  {
    SystemVector      x; ///< without multipliers where they are given by face
    MultipliersByFace multipliers;
  };

  /// x += factor y; multipliers of faces that x lacks stay away.
  void
  add_scaled(Iterate &x, double factor, const Iterate &y);

  /// Collective.
  MultipliersByFace
  multipliers_by_face(const Pairing &pairing,
                      const Vector  &multiplier,
                      MPI_Comm       comm);

  /// Those of faces that @p known lacks stay as they are.
  void
  set_multipliers(const MultipliersByFace &known,
                  const Pairing           &pairing,
                  Vector                  &multiplier);
} // namespace mortise
