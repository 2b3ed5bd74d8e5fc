#include <mortise/solvers/factorisation/mumps_factorisation.h>
#include <mortise/solvers/multipliers/redundant_multipliers.h>
#include <mortise/solvers/multipliers/weighted_square.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  std::vector<types::global_dof_index>
  find_redundant_multipliers(const CouplingMatrix &coupling,
                             const Vector         &inverse_diagonal,
                             const Vector         &scale,
                             const SparseMatrix   &compliance)
  {
    RowsByNode C = weighted_square(RowsByEntity(coupling), inverse_diagonal);
    if (coupling.has_frames())
      C = in_frames(C, coupling.frames());
    const MPI_Comm            comm   = scale.get_mpi_communicator();
    SparseMatrix              matrix = as_matrix(C, comm);
    const std::vector<double> opening =
      compliance.m() > 0 ? compliance.diagonal() : std::vector<double>();
    // by row; that of a component that a node lacks has its diagonal alone
    Vector multipliers(matrix.rows(), comm), roots(multipliers);
    for (unsigned int i = 0; i < C.entries.size(); ++i)
      {
        const int entry = C.entries[i];
        multipliers.local_element(i) =
          entry < 0 ? -1. : scale.get_partitioner()->local_to_global(entry);
        roots.local_element(i) =
          entry < 0 ? 0. : std::sqrt(scale.local_element(entry));
      }
    const std::vector<double> of_columns = matrix.on_columns(roots.begin());
    matrix.for_each_entry(
      [&](const unsigned int i, const unsigned int k, double &value) {
        const bool diagonal = matrix.global_column(k) == matrix.global_row(i);
        const int  entry    = C.entries[i];
        if (diagonal && entry < 0)
          value = 1.;
        else if (diagonal && !opening.empty())
          value += opening[entry];
        if (entry >= 0)
          value *= roots.local_element(i) * of_columns[k];
      });
    MumpsFactorisation factorisation;
    factorisation.initialize(matrix, MatrixKind::positive_semidefinite);
    std::vector<types::global_dof_index> result;
    for (const auto row : factorisation.null_rows())
      {
        // of the rank that owns the row
        const double own =
          matrix.rows().is_element(row) ? multipliers(row) : -1.;
        result.push_back(
          static_cast<types::global_dof_index>(Utilities::MPI::max(own, comm)));
      }
    return result;
  }
} // namespace mortise
