// Rigid motion of bodies along their loads until gaps close, if an active set
// leaves them free.
#pragma once

#include <mortise/problem/contact/global_unknowns.h>
#include <mortise/problem/scene/discretisation.h>

#include <vector>

namespace mortise
{
  /// A motion of all bodies without strain, and the changes of global unknowns
  /// that belong to it.
  struct DrivenMotion
  {
    SystemVector        x;
    std::vector<double> unknowns;

    bool
    is_zero() const
    {
      return size == 0.;
    }

    double size = 0.; ///< of the force that drives it
  };

  /// The free motion that the loads drive, each motion by the force along it;
  /// zero where they drive none. Collective.
  DrivenMotion
  driven_motion(const Discretisation &discretisation,
                const GlobalUnknowns &unknowns,
                const SceneLoad      &load,
                const FreeMotions    &free);

  /// Work of the loads, with that of given forces on global unknowns, on a
  /// rigid
  /// @p motion. Collective.
  double
  work_of_loads(const Discretisation &discretisation,
                const GlobalUnknowns &unknowns,
                const SceneLoad      &load,
                const DrivenMotion   &motion);

  /// Move bodies with free rigid motions with these @p laws of the nodes of
  /// contact from @p at along their loads and @p unknowns until gaps close; the
  /// nodes there stick, and the motion continues along free directions. Motions
  /// without work of the loads or without a gap in their way remain free. On
  /// return @p at is where bodies are then, with the gaps of @p load; returns the
  /// closed nodes.
  /// Collective.
  std::vector<bool>
  close_gaps_rigidly(const Discretisation &discretisation,
                     const GlobalUnknowns &unknowns,
                     SceneLoad            &load,
                     std::vector<Friction> laws,
                     SystemVector         &at);
} // namespace mortise
