#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/interruption.h>
#include <mortise/problem/guard.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <ostream>
#include <string>
#include <thread>

namespace mortise
{
  namespace
  {
    struct Outcome
    {
      ExitCode    code = ExitCode::success;
      std::string message;
    };

    Outcome
    defect(const std::string &what)
    {
      return {
        ExitCode::defect,
        "error: a defect of mortise, not of its input. Please report it with the parameter "
        "file, the command line, the output of `mortise --version`, and this:\n" +
          what};
    }

    Outcome
    out_of_memory()
    {
      std::string message =
        "error: not enough memory for this scene. Take fewer cells, a lower degree, or more "
        "machines.";
      rlimit limit;
      if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        message += " Each process may have " +
                   std::to_string(limit.rlim_cur >> 20) +
                   " MiB (ulimit -v): perhaps this limit can be raised.";
      return {ExitCode::memory, message};
    }

    Outcome
    run(const std::function<void()> &program)
    {
      try
        {
          program();
          return {};
        }
      catch (const InputError &e)
        {
          return {ExitCode::invalid_input, std::string("error: ") + e.what()};
        }
      catch (const ConvergenceError &e)
        {
          return {ExitCode::not_converged,
                  std::string("not converged: ") + e.what()};
        }
      catch (const interruption::Interrupted &e)
        {
          return {static_cast<ExitCode>(128 + e.signal), e.what()};
        }
      catch (const std::bad_alloc &)
        {
          return out_of_memory();
        }
      catch (const dealii::StandardExceptions::ExcOutOfMemory &)
        {
          return out_of_memory();
        }
      catch (const std::exception &e)
        {
          return defect(e.what());
        }
      catch (...)
        {
          return defect("an exception of an unknown type");
        }
    }

    /// Wait for @p request for at most @p patience seconds (for ever if negative) without using
    /// the processor.
    bool
    wait_for(MPI_Request &request, const double patience)
    {
      using Clock      = std::chrono::steady_clock;
      const auto start = Clock::now();
      for (unsigned int round = 0;; ++round)
        {
          int done = 0;
          MPI_Test(&request, &done, MPI_STATUS_IGNORE);
          if (done)
            return true;
          if (patience >= 0. &&
              std::chrono::duration<double>(Clock::now() - start).count() >
                patience)
            return false;
          if (round > 1000)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
  } // namespace

  int
  run_guarded(const MPI_Comm               comm,
              const std::function<void()> &program,
              std::ostream                &error,
              const double                 patience)
  {
    // Its own communicator: a rank that failed must not answer a collective
    // call of the others.
    MPI_Comm agreement;
    MPI_Comm_dup(comm, &agreement);
    const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    const int me      = dealii::Utilities::MPI::this_mpi_process(comm);

    const Outcome outcome  = run(program);
    const bool    failed   = outcome.code != ExitCode::success;
    int           mine     = failed ? me : n_ranks;
    int           reporter = n_ranks;
    MPI_Request   request;
    MPI_Iallreduce(&mine, &reporter, 1, MPI_INT, MPI_MIN, agreement, &request);

    // The lower rank speaks first, so that only one does; those on other
    // machines don't know of each other.
    const double own_patience =
      (outcome.code == ExitCode::memory ? std::min(1., patience) : patience) +
      0.5 * std::min(me, 4);
    if (!wait_for(request, failed ? own_patience : -1.))
      {
        if (interruption::speak_first())
          error << outcome.message << std::endl;
        MPI_Abort(comm, static_cast<int>(outcome.code));
      }
    int code = static_cast<int>(outcome.code);
    if (reporter < n_ranks)
      {
        MPI_Bcast(&code, 1, MPI_INT, reporter, agreement);
        if (me == reporter)
          {
            interruption::speak_first(); // mpirun may now end the others
            error << outcome.message << std::endl;
          }
      }
    MPI_Comm_free(&agreement);
    return code;
  }
} // namespace mortise
