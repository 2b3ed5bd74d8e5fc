#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/serialization/utility.hpp>

#include <mortise/base/timers.h>

#include <algorithm>

namespace mortise
{
  namespace
  {
    double
    seconds_since(const Timers::Clock::time_point start)
    {
      return std::chrono::duration<double>(Timers::Clock::now() - start)
        .count();
    }
  } // namespace

  void
  announce_stage(const std::string &name)
  {
    int running = 0;
    MPI_Initialized(&running);
    if (running)
      MPI_Pcontrol(1, name.c_str());
  }

  Timers::Scope::Scope(Timers &timers, const std::string &name)
    : timers(timers)
    , name(name)
    , start(Clock::now())
  {
    announce_stage(name);
  }

  Timers::Scope::~Scope()
  {
    timers.add(name, seconds());
  }

  double
  Timers::Scope::seconds() const
  {
    return seconds_since(start);
  }

  Timers::Timers()
    : start(Clock::now())
  {}

  Timers::Scope
  Timers::scope(const std::string &name)
  {
    return Scope(*this, name);
  }

  void
  Timers::add(const std::string &name, const double seconds)
  {
    const auto [entry, is_new] = index.emplace(name, times.size());
    if (is_new)
      times.emplace_back(name, seconds);
    else
      times[entry->second].second += seconds;
  }

  double
  Timers::seconds(const std::string &name) const
  {
    const auto entry = index.find(name);
    return entry == index.end() ? 0. : times[entry->second].second;
  }

  double
  Timers::total() const
  {
    return seconds_since(start);
  }

  std::vector<std::pair<std::string, double>>
  Timers::walls(const MPI_Comm comm) const
  {
    Timers all;
    all.add("total", 0.);
    std::vector<std::pair<std::string, double>> mine = times;
    mine.emplace_back("total", total());
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(comm, mine))
      for (const auto &[name, seconds] : of_rank)
        {
          all.add(name, 0.);
          double &wall = all.times[all.index.at(name)].second;
          wall         = std::max(wall, seconds);
        }
    return all.times;
  }

  PeakMemory
  peak_memory_mib(const MPI_Comm comm)
  {
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    const double mib =
      static_cast<double>(stats.VmHWM) / 1024.; // VmHWM is in kB
    return {dealii::Utilities::MPI::sum(mib, comm),
            dealii::Utilities::MPI::max(mib, comm)};
  }
} // namespace mortise
