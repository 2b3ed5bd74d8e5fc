// Proves that every kind of error becomes its exit code and one message, the
// same on all ranks.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/problem/guard.h>
#include <mortise/problem/input/parameters.h>
#include <verdict.h>

#include <functional>
#include <iostream>
#include <new>
#include <sstream>
#include <string>

using namespace mortise;
namespace Ranks = dealii::Utilities::MPI;

namespace
{
  /// All ranks return @p code, and one of them says a message that contains @p part.
  void
  check(const std::string           &what,
        const std::function<void()> &program,
        const int                    code,
        const std::string           &part)
  {
    std::ostringstream error;
    const int          got  = run_guarded(MPI_COMM_WORLD, program, error, 600.);
    const std::string  text = error.str();
    const int  speakers     = Ranks::sum(text.empty() ? 0 : 1, MPI_COMM_WORLD);
    const bool contains =
      Ranks::max(text.find(part) != std::string::npos ? 1 : 0, MPI_COMM_WORLD) >
      0;
    const bool same = Ranks::min(got, MPI_COMM_WORLD) == code &&
                      Ranks::max(got, MPI_COMM_WORLD) == code;
    const bool fine = same && contains && speakers == (part.empty() ? 0 : 1);
    verdict(fine, what, text);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Ranks::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int      me = Ranks::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int      n  = Ranks::n_mpi_processes(MPI_COMM_WORLD);
  check(
    "no error: 0 and no message", [] {}, 0, "");
  check(
    "wrong input: 2",
    [] { throw InputError("no such thing"); },
    2,
    "error: no such thing");
  check(
    "wrong input seen by one rank only: 2",
    [&] { throw_if_any(me == n - 1 ? "a bad file" : "", MPI_COMM_WORLD); },
    2,
    "a bad file");
  check(
    "wrong input on the last rank, nothing collective after it: 2",
    [&] {
      if (me == n - 1)
        throw InputError("only here");
    },
    2,
    "only here");
  check(
    "different messages: that of the lowest rank",
    [&] { throw InputError("rank " + std::to_string(me)); },
    2,
    "rank 0");
  check(
    "not converged: 3",
    [] { throw ConvergenceError("after 7 iterations"); },
    3,
    "after 7 iterations");
  check(
    "a standard exception: 1",
    [] { (void)std::string().at(1); },
    1,
    "a defect of mortise");
  check(
    "an exception of any type: 1", [] { throw 1; }, 1, "unknown type");
  check(
    "out of memory: 4", [] { throw std::bad_alloc(); }, 4, "not enough memory");
  check(
    "out of memory in deal.II: 4",
    [] { AssertThrow(false, dealii::ExcOutOfMemory(1)); },
    4,
    "not enough memory");
  check(
    "out of memory on the last rank, nothing collective after it: 4",
    [&] {
      if (me == n - 1)
        throw std::bad_alloc();
    },
    4,
    "not enough memory");
  check(
    "a parameter file that is missing: 2",
    [] { read_parameters("missing_file.prm", {}, MPI_COMM_WORLD); },
    2,
    "error: parameter file \"missing_file.prm\": cannot be read");
  check(
    "an output directory below a file: 2",
    [] {
      Parameters parameters;
      parameters.output.directory = "/dev/null/results";
      check_output_directory(parameters, MPI_COMM_WORLD);
    },
    2,
    "\"/dev/null\" is not a directory");
  return 0;
}
