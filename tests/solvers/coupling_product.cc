// Proves that products with B and B^T are those of the matrix and touch the
// displacements that multipliers move alone, on every number of ranks.
#include <mortise/solvers/coupling_product.h>
#include <mortise/solvers/epetra_tools.h>
#include <verdict.h>

#include <cmath>

#include "spring_system.h"

using namespace mortise;
using namespace dealii;

namespace
{
  template <typename Number>
  void
  check(const BlockSystem      &system,
        const springs::Options &options,
        const std::string      &precision,
        const double            allowed)
  {
    const auto say =
      [&](const std::string &what, const double got, const double limit) {
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          verdict(precision + ": " + what, got, limit);
      };
    const CouplingProduct<Number> product(system);
    const auto                   &places = product.places();
    // two layers of points, three displacements each
    const double n_moved = 6. * options.size * options.size,
                 n_places =
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
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const springs::Options           options;
  const BlockSystem system = springs::Builder(options, MPI_COMM_WORLD).build();
  check<double>(system, options, "double", 1e-15);
  check<float>(system, options, "float", 1e-6);
}
