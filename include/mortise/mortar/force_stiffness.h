// The stiffness of the forces of an interface that follows the bodies.
//
// Of a pressure p per undeformed area, p delta alpha is the work on a change of
// the distance alpha, x_m(eta) = x_s(xi) + alpha n. Where the surfaces touch
//
//   delta alpha = nu . (delta x_m - delta x_s) / (n . nu),
//   (n . nu) Delta delta alpha = V_a T_a + T_a V_a + b_ab T_a T_b,
//   V_a = nu . (delta x_m),a,  T_a = e^a . (delta x_s - delta x_m),
//   b_ab = nu . x_m,ab,
//
// with the normal nu of the master into the slave's side, and its dual tangents
// m^a, e^a = m^a - (m^a . n) / (nu . n) nu. Source: the second derivative of
// alpha at alpha = 0, as in Hiermeier, Wall, Popp (2018). A traction t of
// friction per undeformed area does the work t . (delta x_s - delta x_m), of
// which the points of the master move, and turns with nu:
//
//   -t . (delta x_m),a T_a + (t . e^a) (V_a + b_ab T_b) nu . (delta x_s - delta
//   x_m),
//
// which is not symmetric.
#pragma once

#include <mortise/mortar/coupling.h>

#include <vector>

namespace mortise
{
  /// d(B^T lambda)/du at fixed multipliers, of the @p couplings with a displaced
  /// slave: displacements at nodes, also constrained ones. Where surfaces are
  /// apart or facets meet at an angle it lacks what is small with these.
  /// @p multiplier: owned, of all couplings. Collective.
  SparseMatrix
  force_stiffness(const std::vector<Coupling> &couplings,
                  const Vector                &multiplier,
                  const dealii::IndexSet      &owned_displacement,
                  MPI_Comm                     comm);
} // namespace mortise
