// Proves that active sets end at what solves lambda >= 0, gap = q + C lambda >=
// 0, lambda gap = 0 for C that is positive definite, those included where sets
// come back: then the energy decides, or without one what is violated most; and
// that what nearly presses is left alone. The nodes are dealt out to the ranks;
// the sets are the same on any number of these.
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <mortise/contact/active_set.h>
#include <mortise/solvers/pseudo_random.h>
#include <verdict.h>

#include <algorithm>
#include <cmath>

using namespace mortise;
using dealii::FullMatrix;

namespace
{
  constexpr unsigned int n = 15;

  struct Problem
  {
    FullMatrix<double>     C = FullMatrix<double>(n, n);
    dealii::Vector<double> q = dealii::Vector<double>(n);
  };

  bool
  is_symmetric(const unsigned int number)
  {
    return number % 4 != 2;
  }

  /// C = A^T A with entries of A in -1..1, as nothing local makes it; in every
  /// second draw A has as many rows as a third of C, but for what is as small
  /// as the compliance of a stiff slave beside that of a soft master, and most
  /// sets come back. In every fourth draw what is not symmetric is added, as by
  /// friction.
  Problem
  draw(const unsigned int number)
  {
    Problem            problem;
    FullMatrix<double> A(number % 2 == 0 ? n : n / 3, n);
    const unsigned int first = number * n * (n + 1);
    for (unsigned int i = 0; i < n; ++i)
      problem.q(i) = pseudo_random(first + n * n + i);
    for (unsigned int i = 0; i < A.m(); ++i)
      for (unsigned int j = 0; j < n; ++j)
        A(i, j) = pseudo_random(first + n * i + j);
    A.Tmmult(problem.C, A);
    for (unsigned int i = 0; i < n; ++i)
      problem.C(i, i) += number % 2 == 0 ? 1e-2 : 1e-4;
    for (unsigned int i = 0; i < n && !is_symmetric(number); ++i)
      for (unsigned int j = 0; j < i; ++j)
        {
          const double skew = 0.3 * pseudo_random(first + n * i + j + 7);
          problem.C(i, j) += skew;
          problem.C(j, i) -= skew;
        }
    return problem;
  }

  /// The multipliers of a set, and all gaps.
  void
  solve(const Problem           &problem,
        const std::vector<bool> &active,
        dealii::Vector<double>  &lambda,
        dealii::Vector<double>  &gap)
  {
    FullMatrix<double>     C = problem.C;
    dealii::Vector<double> q = problem.q;
    for (unsigned int i = 0; i < n; ++i)
      if (!active[i])
        {
          for (unsigned int j = 0; j < n; ++j)
            C(i, j) = C(j, i) = 0.;
          C(i, i) = 1.;
          q(i)    = 0.;
        }
    C.gauss_jordan();
    C.vmult(lambda, q);
    lambda *= -1.;
    problem.C.vmult(gap, lambda);
    gap += problem.q;
  }

  std::vector<bool>
  of_all_ranks(const ActiveSet &set)
  {
    std::vector<bool> result;
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, set.active()))
      result.insert(result.end(), part.begin(), part.end());
    return result;
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int                       n_ranks =
                       dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                     me =
                       dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                     first = me * n / n_ranks, end = (me + 1) * n / n_ranks;
  double       worst     = 0.;
  unsigned int most_sets = 0, n_cycles = 0;
  for (unsigned int number = 0; number < 1000; ++number)
    {
      const Problem problem = draw(number);
      ActiveSet     set(std::vector<double>(end - first, 1.),
                    is_symmetric(number),
                    MPI_COMM_WORLD);
      if (number % 2 == 1)
        {
          std::vector<bool> start;
          for (unsigned int i = first; i < end; ++i)
            start.push_back(i % 3 == 0);
          set.start_from(start);
        }
      dealii::Vector<double> lambda(n), gap(n);
      unsigned int           n_sets = 0;
      ActiveSet::Change      change;
      do
        {
          ++n_sets;
          solve(problem, of_all_ranks(set), lambda, gap);
          change = set.advance({lambda.begin() + first, lambda.begin() + end},
                               {gap.begin() + first, gap.begin() + end},
                               1.,
                               1e-12);
        }
      while (change.any() && n_sets < 1000);
      most_sets = std::max(most_sets, n_sets);
      n_cycles += set.cycles() ? 1 : 0;
      const double largest = lambda.linfty_norm();
      for (unsigned int i = 0; i < n; ++i)
        worst = std::max(
          {worst,
           -lambda(i) / std::max(1., largest),
           -gap(i) / std::max(1., largest),
           std::fabs(lambda(i) * gap(i)) / std::max(1., largest * largest)});
    }
  if (me > 0)
    std::cout.setstate(std::ios_base::failbit); // one rank prints
  verdict("signs and products 1e-10", worst, 1e-10);
  verdict("sets", most_sets, 200);
  verdict("some draws come back", n_cycles > 0 ? 0. : 1., 0.);

  // pressing, just pulling, pulling, a gap that is just open, one that overlaps
  const bool                mine          = me == 0;
  const unsigned int        size          = mine ? 5 : 0;
  const std::vector<double> all_pressures = {1., -1e-12, -1., 0., 0.},
                            all_gaps      = {0., 0., 0., 1e-12, -1.};
  const std::vector<double> pressures(all_pressures.begin(),
                                      all_pressures.begin() + size),
    gaps(all_gaps.begin(), all_gaps.begin() + size);
  ActiveSet set(std::vector<double>(size, 1.), true, MPI_COMM_WORLD);
  verdict("all start active", std::fabs(double(set.n_active()) - 5.), 0.);
  set.start_from(mine ? std::vector<bool>{true, true, true, false, false} :
                        std::vector<bool>());
  const auto change = set.advance(pressures, gaps, 1., 1e-10);
  verdict("one opens", std::fabs(double(change.opened) - 1.), 0.);
  verdict("one closes", std::fabs(double(change.closed) - 1.), 0.);
  verdict("two are undecided", std::fabs(double(change.undecided) - 2.), 0.);
  verdict("three are left", std::fabs(double(set.n_active()) - 3.), 0.);

  // without a pressure what overlaps is the scale
  set.start_from(std::vector<bool>(size, false));
  const auto closing =
    set.advance(std::vector<double>(size, 0.),
                mine ? std::vector<double>{-1., -1e-12, 1e-12, 0., 0.} :
                       std::vector<double>(),
                1.,
                1e-10);
  verdict("one of the overlaps closes",
          std::fabs(double(closing.closed) - 1.),
          0.);

  // a set in which another node alone has changed has not been there
  for (unsigned int i = 0; i < 5; ++i)
    {
      set.start_from(std::vector<bool>(size, true));
      std::vector<double> pressure(size, 1.);
      if (mine)
        pressure[i] = -1.;
      const auto opening =
        set.advance(pressure, std::vector<double>(size, 0.), 1., 1e-10);
      verdict("it opens, and no set has come back",
              std::fabs(double(opening.opened) - 1.) + (set.cycles() ? 1. : 0.),
              0.);
    }
}
