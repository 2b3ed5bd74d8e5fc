// The slave faces of couplings, and the dofs of their traces.
#pragma once

#include <mortise/mortar/coupling.h>
#include <mortise/mortar/row_assembler.h>

namespace mortise
{
  /// The dofs of component @p c.
  inline Expansion
  component(const FaceTrace &trace, const unsigned int c)
  {
    return {trace.begin, trace.column, trace.weight, c * trace.n_functions()};
  }

  /// Calls visit(coupling, s) for each slave face s with a partner.
  template <typename Visit>
  void
  for_each_face(const std::vector<Coupling> &couplings, const Visit &visit)
  {
    for (const Coupling &coupling : couplings)
      for (unsigned int s = 0; s < coupling.local.size(); ++s)
        if (!coupling.local[s].partners.empty())
          visit(coupling, s);
  }
} // namespace mortise
