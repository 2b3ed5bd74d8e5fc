// Sizes and first degrees of new meshes of tetrahedra.
#pragma once

#include <mortise/adapt/refinement.h>
#include <mortise/base/rigid_motion.h>
#include <mortise/body/mesh/size_field.h>

#include <memory>
#include <vector>

namespace mortise
{
  struct Remeshing
  {
    /// The same on all ranks.
    std::shared_ptr<const SizeField> sizes;
    std::vector<unsigned int>        degrees; ///< by cell of sizes
    double                           growth =
      1.; ///< cells of the new mesh by those of the old one, about
  };

  struct RemeshingOptions
  {
    double       target = 0.; ///< square of the error that a cell may have
    unsigned int most_halvings = 1; ///< of edges
    /// Degrees begin two below those of the old mesh, but not below this, and
    /// with this where cells were to be split.
    unsigned int least_degree = 1;
    RigidMotion  motion; ///< from the file to the scene
    unsigned int n_cuts =
      0; ///< after it has been read all cells are cut so often
  };

  /// A new mesh of @p body, smaller where @p refinements, by active cell, split and the error is larger than its target.
  /// Collective.
  Remeshing
  plan_remeshing(const Body                    &body,
                 const std::vector<Refinement> &refinements,
                 const std::vector<CellState>  &states,
                 const RemeshingOptions        &options);

  /// States of the cells of @p body, which has the new mesh: new, of the degrees of @p remeshing.
  std::vector<CellState>
  states_after(const Body        &body,
               const Remeshing   &remeshing,
               const RigidMotion &motion);
} // namespace mortise
