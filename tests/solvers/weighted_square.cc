// Proves that C = B T B^T by nodes is what the products with B and B^T make it,
// where components have the same rows, where they have others and where some
// lack them, and that its factorisation on all ranks and the one by parts
// invert it, on every number of ranks.
#include <deal.II/base/mpi.h>

#include <Epetra_MpiComm.h>
#include <mortise/solvers/factorisation/schwarz_inverse.h>
#include <mortise/solvers/factorisation/sparse_cholesky.h>
#include <mortise/solvers/interface/weighted_square.h>
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
    const Epetra_CrsMatrix B       = CouplingLine{n_entities}.matrix();
    const auto             largest = [](const Epetra_Vector &x) {
      double norm = 0.;
      x.NormInf(&norm);
      return norm;
    };
    const auto say =
      [&](const std::string &what, const double got, const double allowed) {
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          verdict(std::to_string(n_entities) + " entities: " + what,
                  got,
                  allowed);
      };
    IndexSet owned(B.DomainMap().NumGlobalElements());
    if (B.DomainMap().NumMyElements() > 0)
      owned.add_range(B.DomainMap().MinMyGID(), B.DomainMap().MaxMyGID() + 1);
    LevelVector<double> weights(owned, MPI_COMM_WORLD);
    for (const auto i : owned)
      weights(i) = 1. + i / 3 % 5;

    const CouplingMatrix by_node = CouplingLine{n_entities}.by_node();
    const NodalMatrix    C = weighted_square(CouplingRows(by_node), weights);
    const auto alike   = std::count(C.variants.begin(), C.variants.end(), 1U);
    const int  n_alike = Utilities::MPI::sum<int>(alike, MPI_COMM_WORLD),
              n_nodes  = Utilities::MPI::sum<int>(C.size(), MPI_COMM_WORLD);
    // those of entities that share columns with deviating ones: 20 at the ends,
    // 15 of entities 5 to 11
    say("nodes whose components differ", n_nodes - n_alike, 35);
    say("without such", n_nodes - n_alike > 0 ? 0 : 1, 0);

    Epetra_Vector y(B.RowMap()), expected(y), got(y), u(B.DomainMap());
    for (int i = 0; i < y.MyLength(); ++i)
      y[i] = std::sin(1. + B.GRID(i));
    B.Multiply(true, y, u);
    for (int i = 0; i < u.MyLength(); ++i)
      u[i] *= weights.local_element(i);
    B.Multiply(false, u, expected);
    const auto    matrix = as_matrix(C, B.Comm());
    Epetra_Vector at_nodes(matrix->RowMap()), product(at_nodes);
    for (unsigned int i = 0; i < C.entries.size(); ++i)
      if (C.entries[i] >= 0)
        at_nodes[i] = y[C.entries[i]];
    matrix->Multiply(false, at_nodes, product);
    for (unsigned int i = 0; i < C.entries.size(); ++i)
      if (C.entries[i] >= 0)
        got[C.entries[i]] = product[i];
    got.Update(-1., expected, 1.);
    say("products", largest(got) / largest(expected), 1e-14);

    SparseCholesky<double> inverse;
    say("positive definite", inverse.initialize(C, MPI_COMM_WORLD) ? 0 : 1, 0);
    inverse.solve(got, expected);
    got.Update(-1., y, 1.);
    say("inverse", largest(got), 1e-12);

    SchwarzInverse by_parts;
    const auto multiply = [&](Epetra_Vector &to, const Epetra_Vector &from) {
      B.Multiply(true, from, u);
      for (int i = 0; i < u.MyLength(); ++i)
        u[i] *= weights.local_element(i);
      B.Multiply(false, u, to);
    };
    const auto nodes = std::make_shared<DistributedNodalMatrix>(C, B.RowMap());
    nodes->vmult(got, y);
    got.Update(-1., expected, 1.);
    say("products by nodes", largest(got) / largest(expected), 1e-14);
    say("by parts", by_parts.initialize(nodes, multiply) ? 0 : 1, 0);
    say("by parts, corrections", by_parts.n_corrections(), 12);
    by_parts.solve(got, expected);
    got.Update(-1., y, 1.);
    double        error = 0., norm = 0.;
    Epetra_Vector C_error(got);
    multiply(C_error, got);
    got.Dot(C_error, &error);
    y.Dot(expected, &norm);
    say("by parts, energy of the error", std::sqrt(error / norm), 4e-6);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const int n_entities : {5, 12, 200})
    check(n_entities);
}
