// The constraint in the hierarchical functions of the bodies, which the program
// has at nodes.
#pragma once

#include <mortise/mortar/coupling.h>

#include <vector>

namespace mortise::testing
{
  /// [D, -M], columns in the numbering of the traces. Collective.
  inline SparseMatrix
  hierarchical_constraint(const std::vector<Coupling> &couplings,
                          const CouplingPartition     &partition)
  {
    std::vector<SparseMatrix::Entry> entries;
    const auto add = [&](const MultiplierSpace::FaceMultipliers &rows,
                         const dealii::FullMatrix<double>       &block,
                         const FaceTrace                        &trace,
                         const double                            sign) {
      for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
        rows.for_each_direction(
          r,
          [&](const unsigned int i, const dealii::Tensor<1, dim> &direction) {
            for (unsigned int j = 0; j < dim * block.n(); ++j)
              for (unsigned int f = rows.begin[r]; f < rows.begin[r + 1]; ++f)
                for (unsigned int e = trace.begin[j]; e < trace.begin[j + 1];
                     ++e)
                  entries.push_back(
                    {rows.index[f],
                     trace.column[e],
                     sign * rows.weight[f] * direction[j / block.n()] *
                       block(i, j % block.n()) * trace.weight[e]});
          });
    };
    for (const Coupling &coupling : couplings)
      for (unsigned int s = 0; s < coupling.local.size(); ++s)
        if (const LocalCoupling &local = coupling.local[s];
            !local.partners.empty())
          {
            const auto &rows = coupling.multipliers->rows()[s];
            add(rows,
                local.constraint,
                coupling.interface->slave().traces[s],
                1.);
            for (const auto &partner : local.partners)
              add(rows,
                  partner.constraint,
                  coupling.interface->master_traces()[partner.master],
                  -1.);
          }
    return SparseMatrix(partition.owned_multiplier,
                        partition.owned_displacement,
                        partition.comm,
                        entries);
  }
} // namespace mortise::testing
