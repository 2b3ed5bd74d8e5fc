// Wall times of the steps of a run, and its memory, without synchronisation of
// ranks.
#pragma once

#include <mpi.h>

#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// Tell a profiler of MPI which stage of a run begins: MPI_Pcontrol(1, name),
  /// which does nothing by itself.
  void
  announce_stage(const std::string &name);

  /// Accumulated wall times by name. Scopes may be entered many times; a name
  /// that was never entered is absent.
  class Timers
  {
  public:
    using Clock = std::chrono::steady_clock;

    /// Adds the time of its life to a name, also when it ends by an exception;
    /// announces the stage.
    class Scope
    {
    public:
      Scope(Timers &timers, const std::string &name);
      ~Scope();
      Scope(const Scope &) = delete;
      Scope &
      operator=(const Scope &) = delete;

      /// Seconds since the scope was entered.
      double
      seconds() const;

    private:
      Timers           &timers;
      std::string       name;
      Clock::time_point start;
    };

    /// The clock of `total` starts here.
    Timers();

    /// Enter a scope: `const auto scope = timers.scope("mesh");`
    [[nodiscard]] Scope
    scope(const std::string &name);

    /// Add @p seconds to @p name (for times that were measured elsewhere).
    void
    add(const std::string &name, double seconds);

    /// Seconds of @p name on this rank so far; 0 if it was never entered.
    double
    seconds(const std::string &name) const;

    /// Seconds since construction on this rank.
    double
    total() const;

    /// Names in order of first use with the largest time of any rank, and
    /// "total" first. A name that only some ranks entered is there, too.
    /// Collective.
    std::vector<std::pair<std::string, double>>
    walls(MPI_Comm comm) const;

  private:
    Clock::time_point start;
    std::vector<std::pair<std::string, double>>
                                       times; ///< in order of first use
    std::map<std::string, std::size_t> index;
  };

  /// Peak resident memory of the processes, MiB.
  struct PeakMemory
  {
    double sum_over_ranks = 0.;
    double max_rank       = 0.;
  };

  /// Peak resident memory so far (VmHWM of Linux). Collective.
  PeakMemory
  peak_memory_mib(MPI_Comm comm);
} // namespace mortise
