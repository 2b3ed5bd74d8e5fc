// Proves that C = B T B^T by nodes is what the products with B and B^T make it,
// where components have the same rows, where they have others and where some
// lack them, and that its factorisation on all ranks and the one by parts
// invert it, on every number of ranks.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/factorisation/schwarz_inverse.h>
#include <mortise/solvers/factorisation/sparse_cholesky.h>
#include <mortise/solvers/multipliers/weighted_square.h>
#include <verdict.h>

#include <cmath>

#include "coupling_line.h"

using namespace mortise;
using namespace dealii;

namespace
{
  void
  check(const int n_entities)
  {
    const CouplingLine          line{n_entities};
    const mortise::SparseMatrix B = line.matrix();
    const auto                  say =
      [&](const std::string &what, const double got, const double allowed) {
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          verdict(std::to_string(n_entities) + " entities: " + what,
                  got,
                  allowed);
      };
    const IndexSet  owned = line.owned_nodes(dim);
    mortise::Vector weights(owned, MPI_COMM_WORLD);
    for (const auto i : owned)
      weights(i) = 1. + i / 3 % 5;

    const CouplingMatrix by_node = CouplingLine{n_entities}.by_node();
    const RowsByNode     C = weighted_square(RowsByEntity(by_node), weights);
    const auto alike   = std::count(C.variants.begin(), C.variants.end(), 1U);
    const int  n_alike = Utilities::MPI::sum<int>(alike, MPI_COMM_WORLD),
              n_nodes  = Utilities::MPI::sum<int>(C.size(), MPI_COMM_WORLD);
    // those of entities that share columns with deviating ones: 20 at the ends,
    // 15 of entities 5 to 11
    say("nodes whose components differ", n_nodes - n_alike, 35);
    say("without such", n_nodes - n_alike > 0 ? 0 : 1, 0);

    mortise::Vector y(B.rows(), MPI_COMM_WORLD), expected(y), got(y),
      u(weights);
    for (const auto i : B.rows())
      y(i) = std::sin(1. + i);
    const auto multiply = [&](mortise::Vector       &to,
                              const mortise::Vector &from) {
      u = 0.;
      B.Tvmult_add(u.begin(), from.begin());
      u.scale(weights);
      B.vmult(to, u);
    };
    multiply(expected, y);
    const mortise::SparseMatrix matrix = as_matrix(C, MPI_COMM_WORLD);
    mortise::multiply(C, matrix, got, y);
    got -= expected;
    say("products", got.linfty_norm() / expected.linfty_norm(), 1e-14);

    SparseCholesky<double> inverse;
    say("positive definite", inverse.initialize(C, MPI_COMM_WORLD) ? 0 : 1, 0);
    inverse.solve(got.begin(), expected.begin());
    got -= y;
    say("inverse", got.linfty_norm(), 1e-12);

    SchwarzInverse by_parts;
    say("by parts", by_parts.initialize(C, multiply, got) ? 0 : 1, 0);
    say("by parts, corrections", by_parts.n_corrections(), 12);
    by_parts.solve(got, expected);
    got -= y;
    mortise::Vector C_error(got);
    multiply(C_error, got);
    say("by parts, energy of the error",
        std::sqrt((got * C_error) / (y * expected)),
        4e-6);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const int n_entities : {5, 12, 200})
    check(n_entities);
}
