// Residuals of a solution: forces inside cells, jumps of tractions on faces,
// boundaries and interfaces, and prescribed displacements. Source: Melenk and
// Wohlmuth, On residual-based a posteriori error estimation in hp-FEM, Adv.
// Comput. Math. 15 (2001), for the weights.
#pragma once

#include <mortise/adapt/cell_states.h>
#include <mortise/mortar/interface_evaluation.h>

#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// Supports and loads of a body.
  struct BodyData
  {
    Loads                           loads;
    std::vector<DirichletCondition> dirichlet;
    /// On its faces that have partners.
    std::vector<const TractionsOnFaces *> interfaces;
  };

  /// Error of an interface by violation of its law: gaps, penetration, tension.
  struct InterfaceResidual
  {
    std::string         interface;
    double              size = 0.; ///< energy norm, see evaluate_interface()
    unsigned int        body = 0;  ///< of the slave
    std::vector<double> of_cells;  ///< squares, by active cell of that body
    /// Body and active cell: of both sides, where part of a face is active and
    /// part is open.
    std::vector<std::pair<unsigned int, unsigned int>> at_contact_edge;
    /// By side: the body, and what acts on its faces.
    std::vector<std::pair<unsigned int, TractionsOnFaces>> tractions;
  };

  struct Residuals
  {
    /// Squares of residuals, scaled as squares of errors in the energy norm:
    /// with the modulus E, the size h and the degree p of a cell (h / (pi p))^2
    /// f^2 / E of the residual force f per volume, h / p t^2 / E of the jump t
    /// of the traction on faces, half of it in each cell; E times the square of
    /// the residual of the dilatation in mixed form.
    NumbersByCell equations;
    /// Twice the energy of a half-space with the wave number pi p / h for the
    /// errors of prescribed displacements.
    NumbersByCell conditions;
    /// Body and active cell, of which some points have yielded and some have
    /// not.
    std::vector<std::pair<unsigned int, unsigned int>> at_plastic_front;
  };

  /// Collective.
  Residuals
  residuals(const Bodies                    &bodies,
            const std::vector<BodySolution> &solutions,
            const std::vector<BodyData>     &data);
} // namespace mortise
