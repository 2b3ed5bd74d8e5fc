// Proves that products with B and B^T are those of the matrix, where components
// have the same entries, where they have others and where some lack them, and
// touch the displacements that multipliers move alone, on every number of
// ranks.
#include <mortise/solvers/multipliers/coupling_product.h>
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
  check(const std::string           &name,
        const BlockSystem           &system,
        const mortise::SparseMatrix &B,
        const double                 n_moved,
        const double                 allowed)
  {
    const auto say =
      [&](const std::string &what, const double got, const double limit) {
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          verdict(name + ": " + what, got, limit);
      };
    const CouplingProduct<Number> product(system,
                                          RowsByEntity(system.constraint));
    const auto                   &places = product.indices();
    const double                  n_places =
      Utilities::MPI::sum<double>(places.size(), MPI_COMM_WORLD);
    say("places beside those that are moved", std::abs(n_places - n_moved), 0);

    mortise::Vector u(system.owned_displacement, MPI_COMM_WORLD),
      jump(system.owned_multiplier, MPI_COMM_WORLD), expected(jump);
    LevelVector<Number> trace;
    product.initialize(trace);
    for (const auto i : system.owned_displacement)
      u(i) = std::sin(1. + i);
    for (unsigned int k = 0; k < places.size(); ++k)
      trace.local_element(k) = static_cast<Number>(u.local_element(places[k]));
    product.multiply(jump, trace);
    B.vmult(expected, u);
    jump -= expected;
    say("B u", jump.linfty_norm() / expected.linfty_norm(), allowed);

    product.multiply_transposed(trace, expected);
    u = 0.;
    B.Tvmult_add(u.begin(), expected.begin());
    const double norm = u.linfty_norm();
    for (unsigned int k = 0; k < places.size(); ++k)
      u.local_element(places[k]) -= trace.local_element(k);
    say("B^T y, zero elsewhere", u.linfty_norm() / norm, allowed);
  }

  /// @p B: the same entry by entry.
  void
  check_all(const std::string           &name,
            const BlockSystem           &system,
            const mortise::SparseMatrix &B,
            const double                 n_moved)
  {
    check<double>(name, system, B, n_moved, 1e-15);
    check<float>(name + ", single", system, B, n_moved, 1e-6);
    mortise::Vector u(system.owned_displacement, MPI_COMM_WORLD),
      y(system.owned_multiplier, MPI_COMM_WORLD), expected(y), expected_u(u);
    for (const auto i : system.owned_displacement)
      u(i) = std::sin(1. + i);
    system.constraint.vmult(y, u);
    B.vmult(expected, u);
    B.Tvmult_add(expected_u.begin(), expected.begin());
    y -= expected;
    const double error = y.linfty_norm() / expected.linfty_norm();
    u                  = 0.;
    system.constraint.Tvmult_add(u, expected);
    u -= expected_u;
    const double error_u = u.linfty_norm() / expected_u.linfty_norm();
    const mortise::SparseMatrix same = system.constraint.expanded();
    u                                = 2.;
    const mortise::Vector squares    = system.constraint.diagonal_of_square(u);
    double                largest = 0., of_squares = 0.;
    for (unsigned int i = 0; i < B.n_rows(); ++i)
      {
        std::map<unsigned int, double> row;
        double                         sum = 0.;
        for (const auto &[matrix, sign] : std::initializer_list<
               std::pair<const mortise::SparseMatrix *, double>>{{&B, 1.},
                                                                 {&same, -1.}})
          {
            const auto entries = matrix->row(i);
            for (unsigned int k = 0; k < entries.length; ++k)
              {
                row[matrix->global_column(entries.columns[k])] +=
                  sign * entries.values[k];
                sum += entries.values[k] * entries.values[k];
              }
          }
        for (const auto &[column, difference] : row)
          largest = std::max(largest, std::abs(difference));
        of_squares =
          std::max(of_squares, std::abs(sum - squares.local_element(i)) / sum);
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
    const CouplingLine          line{n_entities};
    const mortise::SparseMatrix B = line.matrix();
    BlockSystem                 system;
    system.communicator       = MPI_COMM_WORLD;
    system.owned_displacement = line.owned_nodes(dim);
    system.owned_multiplier   = line.owned_rows();
    system.constraint         = line.by_node();
    check_all(std::to_string(n_entities) + " entities",
              system,
              B,
              line.n_moved());
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const int n_entities : {5, 12, 200})
    check_line(n_entities);
}
