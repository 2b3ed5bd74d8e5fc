#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <mortise/base/interruption.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace mortise::interruption
{
  /// Is it what catch_signals() has set?
  bool
  is_caught(const struct sigaction &action);
} // namespace mortise::interruption

/// By this name METIS, and no other library, asks for signal(). While it orders
/// or partitions, also for MUMPS, it wants SIGTERM and SIGABRT for itself and
/// makes an error code of them: a run that is to end would go on without an
/// order. Defined in the program it comes before that of the C library. Who has
/// called catch_signals() keeps those signals.
extern "C" __sighandler_t
__sysv_signal(const int number, const __sighandler_t handler) noexcept
{
  struct sigaction old;
  if (sigaction(number, nullptr, &old) != 0)
    return SIG_ERR;
  if (mortise::interruption::is_caught(old))
    return old.sa_handler;
  struct sigaction action = {};
  action.sa_handler       = handler;
  action.sa_flags         = SA_RESETHAND | SA_NODEFER;
  return sigaction(number, &action, &old) == 0 ? old.sa_handler : SIG_ERR;
}

namespace mortise::interruption
{
  namespace
  {
    struct Signal
    {
      int         number;
      const char *name;
    };
    // SIGXCPU: the limit of time of a batch system
    // SIGUSR1: what mpirun hands on to the ranks without ending them itself
    constexpr std::array<Signal, 5> signals = {{{SIGINT, "SIGINT"},
                                                {SIGTERM, "SIGTERM"},
                                                {SIGUSR1, "SIGUSR1"},
                                                {SIGHUP, "SIGHUP"},
                                                {SIGXCPU, "SIGXCPU"}}};

    /// A text that a handler may read at any time: it is written where no
    /// handler looks, then shown.
    template <std::size_t size>
    class ShownText
    {
    public:
      void
      set(const std::string &text)
      {
        char *next                      = buffers[shown == buffers[0] ? 1 : 0];
        next[text.copy(next, size - 1)] = '\0';
        shown                           = next;
      }

      const char *
      get() const
      {
        return shown;
      }

    private:
      char                      buffers[2][size] = {};
      std::atomic<const char *> shown            = buffers[0];
    };

    ShownText<PATH_MAX> unfinished;
    ShownText<4000>     complete;
    /// Names, each once, the one that was written last at the end.
    std::vector<std::string> complete_files;

    std::atomic<bool> speaks = true, is_patient = false;
    /// Somebody sees at once that the signal has come: on a terminal.
    std::atomic<bool>               tells = false;
    std::atomic<int>                kept  = 0;
    std::atomic<int>                alone_spoken{0};
    std::atomic<std::atomic<int> *> spoken = &alone_spoken;
    static_assert(std::atomic<int>::is_always_lock_free &&
                    std::atomic<const char *>::is_always_lock_free,
                  "handlers and other processes read them");

    /// Append @p text to the @p length characters of @p line.
    template <std::size_t size>
    void
    append(char (&line)[size], std::size_t &length, const char *text)
    {
      while (*text != '\0' && length < size)
        line[length++] = *text++;
    }

    /// Is @p number the first one of a patient run? Only what POSIX allows in a
    /// handler.
    bool
    keep(const int number)
    {
      int none = 0;
      if (!is_patient || number == SIGHUP || number == SIGXCPU ||
          !kept.compare_exchange_strong(none, number))
        return false;
      constexpr char told[] =
        "\nthe run stops after this step; a second signal ends it at once\n";
      if (tells)
        {
          [[maybe_unused]] const ssize_t ignored =
            write(STDERR_FILENO, told, sizeof told - 1);
        }
      return true;
    }

    // Only what POSIX allows in a handler.
    void
    end(const int number)
    {
      const int error = errno;
      if (keep(number))
        {
          errno = error; // of who was interrupted
          return;
        }
      if (*unfinished.get() != '\0')
        unlink(unfinished.get());
      if (speaks && speak_first())
        {
          const char *name = "a signal";
          for (const Signal &signal : signals)
            if (signal.number == number)
              name = signal.name;
          char        line[4096];
          std::size_t length = 0;
          append(line, length, "interrupted by ");
          append(line, length, name);
          append(line, length, ": ");
          append(line, length, complete.get());
          append(line, length, "\n");
          // nobody is left to hear of an error
          [[maybe_unused]] const ssize_t ignored =
            write(STDERR_FILENO, line, length);
        }
      _exit(128 + number);
    }

    /// An integer that the ranks on one machine share; nullptr on other
    /// machines than that of the first rank. Plain shared memory: a window of
    /// MPI needs files of megabytes, which a limit may forbid.
    std::atomic<int> *
    shared_integer(const MPI_Comm comm)
    {
      const bool  first = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
      std::string name  = "/mortise." + std::to_string(getpid());
      int         descriptor = -1;
      if (first)
        {
          descriptor = shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
          if (descriptor >= 0 &&
              posix_fallocate(descriptor, 0, sizeof(int)) != 0)
            {
              close(descriptor);
              shm_unlink(name.c_str());
              descriptor = -1;
            }
          if (descriptor < 0)
            name.clear();
        }
      name = dealii::Utilities::MPI::broadcast(comm, name, 0);
      if (name.empty())
        return nullptr;
      if (!first)
        descriptor = shm_open(name.c_str(), O_RDWR, 0600);
      void *memory = MAP_FAILED;
      if (descriptor >= 0)
        {
          memory = mmap(nullptr,
                        sizeof(int),
                        PROT_READ | PROT_WRITE,
                        MAP_SHARED,
                        descriptor,
                        0);
          close(descriptor);
        }
      MPI_Barrier(comm); // all have it
      if (first)
        shm_unlink(name.c_str());
      return memory == MAP_FAILED ? nullptr :
                                    static_cast<std::atomic<int> *>(memory);
    }
  } // namespace

  bool
  is_caught(const struct sigaction &action)
  {
    return action.sa_handler == end;
  }

  void
  catch_signals()
  {
    for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"})
      if (const char *rank = std::getenv(name))
        speaks = std::strcmp(rank, "0") == 0;
    complete.set(what_is_complete());
    tells                   = speaks && isatty(STDERR_FILENO) != 0;
    struct sigaction action = {};
    action.sa_handler       = end;
    action.sa_flags         = SA_RESTART; // a patient run goes on
    sigfillset(&action.sa_mask);
    for (const Signal &signal : signals)
      {
        struct sigaction old;
        const bool ignored = sigaction(signal.number, nullptr, &old) == 0 &&
                             old.sa_handler == SIG_IGN;
        if (!(signal.number == SIGHUP && ignored)) // nohup
          sigaction(signal.number, &action, nullptr);
      }
  }

  void
  share_silence(const MPI_Comm comm)
  {
    speaks = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      if (std::atomic<int> *shared = shared_integer(comm))
        {
          spoken = shared;
          speaks = true;
        }
  }

  bool
  speak_first()
  {
    return spoken.load()->exchange(1) == 0;
  }

  void
  be_patient(const bool patient)
  {
    is_patient = patient;
  }

  int
  agreed_signal(const MPI_Comm comm)
  {
    return dealii::Utilities::MPI::max(kept.load(), comm);
  }

  std::string
  name_of_signal(const int number)
  {
    for (const Signal &signal : signals)
      if (signal.number == number)
        return signal.name;
    return "a signal";
  }

  void
  set_unfinished(const std::string &file)
  {
    unfinished.set(file);
  }

  void
  add_complete(const std::string &file)
  {
    complete_files.erase(std::remove(complete_files.begin(),
                                     complete_files.end(),
                                     file),
                         complete_files.end());
    complete_files.push_back(file);
    complete.set(what_is_complete());
  }

  std::string
  what_is_complete()
  {
    constexpr std::size_t most = 6;
    const std::size_t     n    = complete_files.size();
    if (n == 0)
      return "nothing was written";
    std::string names;
    for (std::size_t i = n <= most ? 0 : n - most; i < n; ++i)
      names += (names.empty() ? "" : ", ") + complete_files[i];
    return n <= most ? "complete are: " + names :
                       "complete are " + std::to_string(n) +
                         " files, the last of them: " + names;
  }
} // namespace mortise::interruption
