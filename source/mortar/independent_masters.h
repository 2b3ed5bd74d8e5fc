// Which masters preconditioners move alone, and the penalty of jumps that
// follows from it.
#pragma once

#include <mortise/mortar/local_coupling.h>

namespace mortise
{
  /// Set LocalCoupling::penalty and, where @p may_be_independent,
  /// Partner::is_independent of slave face @p s.
  void
  set_independent_masters(const InterfaceHandler &interface,
                          unsigned int            s,
                          bool                    may_be_independent,
                          LocalCoupling          &local);
} // namespace mortise
