// Proves that products with B and B^T are those of the matrix, where components
// have the same entries, where they have others and where some lack them, and
// touch the displacements that multipliers move alone, on every number of
// ranks.
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interface/coupling_product.h>
#include <verdict.h>

#include <cmath>

#include "coupling_line.h"
#include "spring_system.h"

using namespace mortise;
using namespace dealii;

namespace
{
  template <typename Number>
  void
  check(const std::string  &name,
        const BlockSystem  &system,
        const CouplingRows &rows,
        const double        n_moved,
        const double        allowed)
  {
    const auto say =
      [&](const std::string &what, const double got, const double limit) {
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          verdict(name + ": " + what, got, limit);
      };
    const CouplingProduct<Number> product(system, rows);
    const auto                   &places = product.indices();
    const double                  n_places =
      Utilities::MPI::sum<double>(places.size(), MPI_COMM_WORLD);
    say("places beside those that are moved", std::abs(n_places - n_moved), 0);

    const auto         &B = system.coupling.trilinos_matrix();
    Epetra_Vector       u(B.DomainMap()), jump(B.RowMap()), expected(jump);
    LevelVector<Number> trace;
    product.initialize(trace);
    for (int i = 0; i < u.MyLength(); ++i)
      u[i] = std::sin(1. + u.Map().GID(i));
    for (unsigned int k = 0; k < places.size(); ++k)
      trace.local_element(k) = static_cast<Number>(u[places[k]]);
    product.multiply(jump, trace);
    B.Multiply(false, u, expected);
    double norm = 0., error = 0.;
    expected.NormInf(&norm);
    jump.Update(-1., expected, 1.);
    jump.NormInf(&error);
    say("B u", error / norm, allowed);

    product.multiply_transposed(trace, expected);
    B.Multiply(true, expected, u);
    u.NormInf(&norm);
    for (unsigned int k = 0; k < places.size(); ++k)
      u[places[k]] -= trace.local_element(k);
    u.NormInf(&error);
    say("B^T y, zero elsewhere", error / norm, allowed);
  }

  void
  check_all(const std::string &name,
            const BlockSystem &system,
            const double       n_moved)
  {
    for (const bool by_node : {true, false})
      {
        const CouplingRows rows(system.coupling.trilinos_matrix(), by_node);
        const std::string  what = name + (by_node ? "" : ", one by one");
        check<double>(what, system, rows, n_moved, 1e-15);
        check<float>(what + ", single", system, rows, n_moved, 1e-6);
      }
  }

  /// Multipliers in a line, some components without rows or columns.
  void
  check_line(const int n_entities)
  {
    const CouplingLine     line{n_entities};
    const Epetra_CrsMatrix B = line.matrix();
    BlockSystem            system;
    system.communicator = MPI_COMM_WORLD;
    system.coupling.reinit(B);
    system.owned_displacement =
      IndexSet(static_cast<unsigned int>(3 * line.n_nodes()));
    if (B.DomainMap().NumMyElements() > 0)
      system.owned_displacement.add_range(B.DomainMap().MinMyGID(),
                                          B.DomainMap().MaxMyGID() + 1);
    check_all(std::to_string(n_entities) + " entities", system, line.n_moved());
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const springs::Options           options;
  const BlockSystem system = springs::Builder(options, MPI_COMM_WORLD).build();
  // two layers of points, three displacements each
  const double n_moved = 6. * options.size * options.size;
  check_all("springs", system, n_moved);
  for (const int n_entities : {5, 12, 200})
    check_line(n_entities);
}
