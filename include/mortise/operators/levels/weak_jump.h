// What a level sees of the constraint of an interface: the jump of
// displacements tested by functions of the slave's nodes.
#pragma once

#include <deal.II/base/index_set.h>

#include <mortise/mortar/coupling.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace mortise
{
  /// b_i(u) = int psi_i [[u]] for functions u of a level, the same for each
  /// component, and the nodes i of the finest level on the slave. psi are dual
  /// functions where faces are covered as a whole and have such, else the nodal
  /// ones.
  class WeakJump
  {
  public:
    using Index = dealii::types::global_dof_index;
    using Entry = std::pair<Index, double>; ///< node, value

    /// Of level @p number. @p owned_tests: the nodes of the finest level, which are kept by
    /// reference; @p owned_nodes: of this level. Collective.
    WeakJump(const Coupling         &coupling,
             unsigned int            number,
             const dealii::IndexSet &owned_tests,
             const dealii::IndexSet &owned_nodes,
             MPI_Comm                comm);

    /// Those of the owned tests, to @p nodes.
    void
    add_nodes(dealii::IndexSet &nodes) const;

    /// visit(number of an owned test, entries of b_i), where there are some.
    void
    for_each_test(
      const std::function<void(unsigned int, const std::vector<Entry> &)>
        &visit) const;

    /// By owned test, w_i of the penalty sum_i w_i b_i(u)^2, which is about
    /// int gamma [[u]]^2. @p gamma: by slave face. Collective.
    std::vector<double>
    factors(const Coupling                                 &coupling,
            const std::function<double(unsigned int face)> &gamma) const;

  private:
    const dealii::IndexSet       &owned_tests;
    MPI_Comm                      comm;
    std::unique_ptr<SparseMatrix> tests;
  };
} // namespace mortise
