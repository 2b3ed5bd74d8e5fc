// See approximate_schur_complement.h.
#include <deal.II/base/mpi.h>

#include <mortise/solvers/multipliers/approximate_schur_complement.h>
#include <mortise/solvers/multipliers/weighted_square.h>

#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The number of rows that a last attempt may have on all ranks.
    constexpr std::size_t always_gathered = 100000;
  } // namespace

  ApproximateSchurComplement::ApproximateSchurComplement(
    const BlockSystem            &system,
    const RowsByEntity           &rows,
    const CouplingProduct<float> &product,
    const std::size_t             max_gathered)
    : system(system)
    , product(product)
    , max_gathered(max_gathered)
    , weights(system.bulk->node_diagonal())
  {
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      weights.local_element(i) = 1. / weights.local_element(i);
    for (const auto &independent : system.bulk->independent_displacements())
      weights.local_element(independent.index) = 0.;
    undirected = weighted_square(rows, weights);
    if (system.active)
      update_directions();
    else
      factorise(in_directions(std::move(undirected)));
  }

  RowsByNode
  ApproximateSchurComplement::in_directions(RowsByNode C) const
  {
    std::vector<bool> left_out;
    if (system.directions)
      {
        left_out = *system.active;
        left_out.flip();
      }
    if (const CouplingMatrix &B = system.directed_constraint(); B.has_frames())
      C = in_frames(C, B.frames(), left_out);
    if (system.has_springs())
      add(C, system.compliance());
    return C;
  }

  bool
  ApproximateSchurComplement::update_directions()
  {
    schur = in_directions(undirected);
    return update_active();
  }

  bool
  ApproximateSchurComplement::update_active()
  {
    factorise(select(schur, *system.active, system.communicator));
    return is_valid();
  }

  SchwarzInverse::Product
  ApproximateSchurComplement::product_with_schur() const
  {
    LevelVector<float> trace;
    product.initialize(trace);
    return [trace, this](Vector &to, const Vector &from) mutable {
      product.multiply_transposed(trace, from);
      const auto &indices = product.indices();
      for (unsigned int k = 0; k < indices.size(); ++k)
        trace.local_element(k) *= weights.local_element(indices[k]);
      product.multiply(to, trace);
      if (system.has_springs())
        {
          Vector opening(to);
          system.compliance().vmult(opening, from);
          to += opening;
        }
      system.clear_inactive(to);
    };
  }

  void
  ApproximateSchurComplement::factorise(RowsByNode active)
  {
    const MPI_Comm comm = system.communicator;
    schwarz.reset();
    cholesky.reset();
    mumps.reset();
    uncoupled_entries.clear();
    std::vector<std::pair<int, double>> uncoupled;
    RowsByNode coupled = extract_coupled(active, comm, uncoupled);
    valid              = true;
    for (auto &[entry, diagonal] : uncoupled)
      {
        valid    = valid && diagonal > 0.;
        diagonal = 1. / diagonal;
      }
    valid = Utilities::MPI::min(valid ? 1 : 0, comm) == 1;
    if (!valid)
      return;
    const std::size_t size = Utilities::MPI::sum(coupled.entries.size(), comm);
    const bool        together =
      Utilities::MPI::n_mpi_processes(comm) == 1 || size <= max_gathered;
    const Vector zero(system.owned_multiplier, comm);
    if (!together)
      {
        schwarz = std::make_unique<SchwarzInverse>();
        valid   = schwarz->initialize(active, product_with_schur(), zero);
        if (valid)
          return;
        schwarz.reset();
      }
    uncoupled_entries = std::move(uncoupled);
    if (size == 0)
      return;
    const SparseMatrix matrix = as_matrix(coupled, comm);
    if (together || size <= always_gathered)
      {
        cholesky = std::make_unique<CholeskyInverse<double>>();
        valid    = cholesky->initialize(
          coupled,
          [&](Vector &y, const Vector &x) { multiply(coupled, matrix, y, x); },
          zero,
          true);
        if (valid)
          return;
        cholesky.reset();
      }
    mumps         = std::make_unique<MumpsFactorisation>();
    valid         = mumps->initialize(matrix, MatrixKind::positive_definite);
    mumps_entries = std::move(coupled.entries);
    mumps_x.resize(mumps_entries.size());
    mumps_b.resize(mumps_entries.size());
  }

  void
  ApproximateSchurComplement::apply_inverse_diagonal(Vector       &dst,
                                                     const Vector &src) const
  {
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      dst.local_element(i) = weights.local_element(i) * src.local_element(i);
  }

  void
  ApproximateSchurComplement::apply_inverse(Vector &y, const Vector &jump) const
  {
    if (!system.active)
      {
        solve(y, jump);
        return;
      }
    Vector of_active(jump);
    system.clear_inactive(of_active);
    solve(y, of_active);
    system.clear_inactive(y);
  }

  void
  ApproximateSchurComplement::solve(Vector &y, const Vector &jump) const
  {
    for (const auto &[entry, inverse] : uncoupled_entries)
      y.local_element(entry) = inverse * jump.local_element(entry);
    if (schwarz)
      schwarz->solve(y, jump);
    else if (cholesky)
      cholesky->solve(y, jump);
    else if (mumps)
      {
        for (unsigned int i = 0; i < mumps_entries.size(); ++i)
          mumps_b[i] =
            mumps_entries[i] < 0 ? 0. : jump.local_element(mumps_entries[i]);
        mumps->solve(mumps_x.data(), mumps_b.data());
        for (unsigned int i = 0; i < mumps_entries.size(); ++i)
          if (mumps_entries[i] >= 0)
            y.local_element(mumps_entries[i]) = mumps_x[i];
      }
  }

  std::string
  ApproximateSchurComplement::description() const
  {
    if (schwarz)
      return "multipliers by parts";
    if (mumps)
      return "multipliers by MUMPS";
    return !cholesky || cholesky->is_single() ?
             "" :
             "multipliers in double precision";
  }
} // namespace mortise
