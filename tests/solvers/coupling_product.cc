// Proves that products with B and B^T are those of the matrix, where components
// have the same entries, where they have others and where some lack them, and
// touch the displacements that multipliers move alone, on every number of
// ranks.
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/interface/coupling_product.h>
#include <verdict.h>

#include <cmath>
#include <map>

#include "coupling_line.h"

using namespace mortise;
using namespace dealii;

namespace
{
  template <typename Number>
  void
  check(const std::string      &name,
        const BlockSystem      &system,
        const Epetra_CrsMatrix &B,
        const double            n_moved,
        const double            allowed)
  {
    const auto say =
      [&](const std::string &what, const double got, const double limit) {
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          verdict(name + ": " + what, got, limit);
      };
    const CouplingProduct<Number> product(system,
                                          CouplingRows(system.coupling));
    const auto                   &places = product.indices();
    const double                  n_places =
      Utilities::MPI::sum<double>(places.size(), MPI_COMM_WORLD);
    say("places beside those that are moved", std::abs(n_places - n_moved), 0);

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

  /// @p B: the same entry by entry.
  void
  check_all(const std::string      &name,
            const BlockSystem      &system,
            const Epetra_CrsMatrix &B,
            const double            n_moved)
  {
    if (system.coupling.n_components() == dim)
      {
        check<double>(name, system, B, n_moved, 1e-15);
        check<float>(name + ", single", system, B, n_moved, 1e-6);
      }
    mortise::Vector u(system.owned_displacement, MPI_COMM_WORLD),
      y(system.owned_multiplier, MPI_COMM_WORLD), expected(y), expected_u(u);
    for (const auto i : system.owned_displacement)
      u(i) = std::sin(1. + i);
    u.compress(VectorOperation::insert);
    system.coupling.vmult(y, u);
    Epetra_Vector in_u = epetra_view(u), in_y = epetra_view(expected),
                  out = epetra_view(expected_u);
    B.Multiply(false, in_u, in_y);
    B.Multiply(true, in_y, out);
    y -= expected;
    const double error = y.linfty_norm() / expected.linfty_norm();
    u                  = 0.;
    system.coupling.Tvmult_add(u, expected);
    u -= expected_u;
    const double     error_u = u.linfty_norm() / expected_u.linfty_norm();
    Epetra_CrsMatrix same    = system.coupling.expanded();
    in_u.PutScalar(2.);
    const Epetra_Vector squares = system.coupling.diagonal_of_square(in_u);
    double              largest = 0., of_squares = 0.;
    for (int i = 0; i < B.NumMyRows(); ++i)
      {
        std::map<int, double> row;
        for (const auto &[matrix, sign] :
             std::initializer_list<std::pair<const Epetra_CrsMatrix *, double>>{
               {&B, 1.}, {&same, -1.}})
          {
            const EpetraRow entries(*matrix, i);
            for (int k = 0; k < entries.length; ++k)
              row[matrix->GCID(entries.columns[k])] += sign * entries.values[k];
          }
        for (const auto &[column, difference] : row)
          largest = std::max(largest, std::abs(difference));
        const EpetraRow entries(B, i);
        double          sum = 0.;
        for (int k = 0; k < entries.length; ++k)
          sum += 2. * entries.values[k] * entries.values[k];
        of_squares = std::max(of_squares, std::abs(sum - squares[i]) / sum);
      }
    largest    = Utilities::MPI::max(largest, MPI_COMM_WORLD);
    of_squares = Utilities::MPI::max(of_squares, MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        verdict(name + ": the matrix times u", error, 1e-15);
        verdict(name + ": its transpose times y", error_u, 1e-15);
        verdict(name + ": its entries", largest, 0.);
        verdict(name + ": the squares of its rows", of_squares, 1e-14);
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
    const auto owned    = [](const Epetra_Map &map) {
      IndexSet set(static_cast<unsigned int>(map.NumGlobalElements()));
      if (map.NumMyElements() > 0)
        set.add_range(map.MinMyGID(), map.MaxMyGID() + 1);
      return set;
    };
    system.owned_displacement  = owned(B.DomainMap());
    system.owned_multiplier    = owned(B.RowMap());
    const std::string     name = std::to_string(n_entities) + " entities";
    mortise::SparseMatrix by_displacement;
    by_displacement.reinit(B);
    system.coupling = CouplingMatrix(std::move(by_displacement));
    check_all(name + ", one by one", system, B, line.n_moved());
    system.coupling = line.by_node();
    check_all(name, system, B, line.n_moved());
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const int n_entities : {5, 12, 200})
    check_line(n_entities);
}
