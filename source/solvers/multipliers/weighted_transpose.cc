// See weighted_transpose.h.
#include <mortise/solvers/multipliers/weighted_transpose.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  WeightedTranspose::WeightedTranspose(const RowsByEntity        &B,
                                       const LevelVector<double> &weights)
    : begin{0}
  {
    const SparseMatrix              &scalar = B.matrix.scalar();
    std::vector<SparseMatrix::Entry> moved;
    for (const auto &of_entity : B.rows)
      for (const EntityRows &shared : of_entity)
        for (unsigned int c = 0; c < dim; ++c)
          for (int i = 0; i < shared.n_rows && shared.first_row[c] >= 0; ++i)
            {
              const auto    row = scalar.global_row(shared.first_row[c] + i);
              const double *from =
                shared.values.data() + i * shared.nodes.size();
              for (unsigned int k = 0; k < shared.nodes.size(); ++k)
                if (const int displacement =
                      B.displacements[dim * shared.nodes[k] + c];
                    displacement >= 0)
                  moved.push_back(
                    {SparseMatrix::Index(displacement), row, from[k]});
            }
    SparseMatrix transposed(weights.locally_owned_elements(),
                            scalar.rows(),
                            scalar.communicator(),
                            moved);
    transposed.for_each_entry(
      [&](const unsigned int i, const unsigned int, double &value) {
        value *= weights.local_element(i);
      });

    std::vector<SparseMatrix::Index> wanted;
    for (const int displacement : B.displacements)
      if (displacement >= 0)
        wanted.push_back(displacement);
    const auto rows = transposed.fetch(wanted);
    // those in front of the owned ones wrap around
    std::vector<SparseMatrix::Index> others;
    for (const auto column : rows.columns)
      if (column - scalar.global_row(0) >= scalar.n_rows())
        others.push_back(column);
    std::sort(others.begin(), others.end());
    IndexSet used(scalar.m());
    used.add_indices(others.begin(), others.end());
    multipliers = std::make_shared<const Utilities::MPI::Partitioner>(
      scalar.rows(), used, scalar.communicator());
    unsigned int next = 0;
    for (const int displacement : B.displacements)
      begin.push_back(displacement < 0 ? begin.back() : rows.begin[++next]);
    entries.reserve(rows.columns.size());
    for (std::size_t k = 0; k < rows.columns.size(); ++k)
      entries.emplace_back(multipliers->global_to_local(rows.columns[k]),
                           rows.values[k]);
  }
} // namespace mortise
