// Proves that multipliers which depend on others are found, exactly as many as
// there are: none among independent constraints, and one for each that is
// added once more, scaled or as the sum of two others.
#include <mortise/solvers/multipliers/redundant_multipliers.h>
#include <verdict.h>

#include <utility>
#include <vector>

#include "coupling_line.h"

using namespace mortise;

namespace
{
  /// The system with row k of B replaced by the sum of factor times row source,
  /// for all given.
  struct Row
  {
    unsigned int                                 k;
    std::vector<std::pair<unsigned int, double>> sum;
  };

  unsigned int
  count(const std::vector<Row> &replaced)
  {
    const CouplingLine               line{12};
    std::vector<SparseMatrix::Entry> frames;
    const auto                       multipliers = line.owned_rows();
    for (const unsigned int k : multipliers)
      {
        std::vector<std::pair<unsigned int, double>> sum = {{k, 1.}};
        for (const Row &row : replaced)
          if (row.k == k)
            sum = row.sum;
        for (const auto &[source, factor] : sum)
          frames.push_back({k, source, factor});
      }
    const CouplingMatrix coupling = line.by_node(
      replaced.empty() ?
        SparseMatrix() :
        SparseMatrix(multipliers, multipliers, MPI_COMM_WORLD, frames));
    mortise::Vector inverse_diagonal(line.owned_nodes(dim), MPI_COMM_WORLD);
    for (const auto i : line.owned_nodes(dim))
      inverse_diagonal(i) = 1. / (1. + i % 7);
    mortise::Vector scale = coupling.diagonal_of_square(inverse_diagonal);
    for (double &value : scale)
      value = 1. / value;
    return find_redundant_multipliers(coupling,
                                      inverse_diagonal,
                                      scale,
                                      SparseMatrix())
      .size();
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  verdict("independent", count({}), 0);
  verdict("one twice", std::abs(int(count({{5, {{2, 1.}}}})) - 1), 0);
  verdict("one twice, scaled by 1e9",
          std::abs(int(count({{5, {{2, 1e9}}}})) - 1),
          0);
  verdict("two sums of others",
          std::abs(int(count(
                     {{5, {{2, 1.}, {8, -0.3}}}, {20, {{11, 2.}, {14, 1.}}}})) -
                   2),
          0);
  verdict("a sum of all others in a direction",
          std::abs(int(count({{0, {{3, 1.}, {6, 1.}, {9, 1.}, {12, 1.}}}})) -
                   1),
          0);
}
