// Proves that multipliers which depend on others are found, exactly as many as
// there are: none among independent constraints, and one for each that is
// added once more, scaled or as the sum of two others.
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mortise/solvers/interface/dependent_multipliers.h>
#include <verdict.h>

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
    const Epetra_CrsMatrix B = CouplingLine{12}.matrix();
    SparseMatrix           given;
    given.reinit(B);
    dealii::DynamicSparsityPattern pattern(given.m(), given.n());
    const auto                     for_each = [&](const auto &visit) {
      for (unsigned int k = 0; k < given.m(); ++k)
        {
          std::vector<std::pair<unsigned int, double>> sum = {{k, 1.}};
          for (const Row &row : replaced)
            if (row.k == k)
              sum = row.sum;
          for (const auto &[source, factor] : sum)
            for (auto entry = given.begin(source); entry != given.end(source);
                 ++entry)
              visit(k, entry->column(), factor * entry->value());
        }
    };
    for_each([&](const unsigned int k, const auto column, const double) {
      pattern.add(k, column);
    });
    SparseMatrix coupling;
    coupling.reinit(dealii::complete_index_set(given.m()),
                    dealii::complete_index_set(given.n()),
                    pattern,
                    MPI_COMM_WORLD);
    for_each([&](const unsigned int k, const auto column, const double value) {
      coupling.add(k, column, value);
    });
    coupling.compress(dealii::VectorOperation::add);
    const CouplingMatrix all(std::move(coupling));
    Epetra_Vector        inverse_diagonal(B.DomainMap());
    for (int i = 0; i < inverse_diagonal.MyLength(); ++i)
      inverse_diagonal[i] = 1. / (1. + i % 7);
    Epetra_Vector scale = all.diagonal_of_square(inverse_diagonal);
    scale.Reciprocal(scale);
    return find_dependent_multipliers(all,
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
