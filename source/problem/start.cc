#include <dlfcn.h>
#include <mortise/base/error.h>
#include <mortise/base/interruption.h>
#include <mortise/problem/start.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C"
{
  void
  dpotrf_(const char *, const int *, double *, const int *, int *);
}

namespace
{
  constexpr std::size_t blas_buffer = 128 << 20;

  /// A function of OpenBLAS, which may be what the BLAS of the other libraries
  /// is, or nullptr.
  template <typename Function>
  Function *
  of_openblas(const char *name)
  {
    return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, name));
  }

  bool
  has_room(const std::size_t bytes)
  {
    void *memory = mmap(nullptr,
                        bytes,
                        PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS,
                        -1,
                        0);
    if (memory == MAP_FAILED)
      return false;
    munmap(memory, bytes);
    return true;
  }

  /// The value of a variable, or nullptr: getenv() for those who are called
  /// before the libraries are initialised.
  const char *
  value_of(const char *name, char *const *environment)
  {
    const std::size_t length = std::strlen(name);
    for (; *environment != nullptr; ++environment)
      if (std::strncmp(*environment, name, length) == 0 &&
          (*environment)[length] == '=')
        return *environment + length + 1;
    return nullptr;
  }

  /// May be called before the libraries are initialised, streams with them.
  [[noreturn]] void
  end_without_room(const std::size_t bytes, char *const *environment)
  {
    // Most often all ranks are here: the first ends them all. Another speaks if
    // it is here alone.
    for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"})
      if (const char *rank = value_of(name, environment);
          rank != nullptr && std::strcmp(rank, "0") != 0)
        {
          sleep(3); // mpirun takes one second
          break;
        }
    rlimit limit;
    char   message[300];
    int    length = std::snprintf(
      message,
      sizeof message,
      "error: not enough memory to start: %zu MiB of address space are needed beside the program",
      bytes >> 20);
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      length += std::snprintf(
        message + length,
        sizeof message - length,
        ", and a process may have %zu MiB in all (ulimit -v); raise this limit",
        static_cast<std::size_t>(limit.rlim_cur >> 20));
    message[length++] = '\n';
    // nobody is left to hear of an error
    [[maybe_unused]] const ssize_t ignored =
      write(STDERR_FILENO, message, length);
    _exit(static_cast<int>(mortise::ExitCode::memory));
  }

  // Parallelism is between ranks: threads of BLAS would fight with them for the
  // cores (the assembly of a scene of degree 4 took four times as long).
  // OpenBLAS starts a thread for each processor that it sees, when it is
  // loaded, and each of them takes 128 MiB of address space and tries again for
  // ever if it cannot have them. So it sees one processor: the program's own
  // .preinit_array is run before any library's constructor. An
  // OPENBLAS_NUM_THREADS of the user stays.
  cpu_set_t all_processors;
  bool      loaded_on_one = false;

  void
  load_on_one_processor(char *const *environment)
  {
    if (value_of("OPENBLAS_NUM_THREADS", environment) != nullptr)
      return;
    cpu_set_t one;
    CPU_ZERO(&one);
    const int here = sched_getcpu();
    if (here < 0 || here >= CPU_SETSIZE ||
        sched_getaffinity(0, sizeof all_processors, &all_processors) != 0)
      return; // more processors than a set has room for
    CPU_SET(here, &one);
    loaded_on_one = sched_setaffinity(0, sizeof one, &one) == 0;
  }

  void
  prepare_libraries(int, char **, char **environment)
  {
    // OpenBLAS 0.3.29 takes a buffer when it is loaded; see take_blas_buffer()
    if (!has_room(2 * blas_buffer))
      end_without_room(2 * blas_buffer, environment);
    load_on_one_processor(environment);
  }

  __attribute__((section(".preinit_array"),
                 used)) void (*const before_libraries)(int, char **, char **) =
    prepare_libraries;

  void
  use_one_blas_thread()
  {
    if (loaded_on_one)
      sched_setaffinity(0, sizeof all_processors, &all_processors);
    if (const auto set = of_openblas<void(int)>("openblas_set_num_threads");
        set != nullptr && std::getenv("OPENBLAS_NUM_THREADS") == nullptr)
      set(1);
  }

  /// OpenBLAS takes its oldest kernels on processors that are newer than
  /// itself: at half the speed, and one of them (strsm of Prescott, in 0.3.21)
  /// ends the program. It reads the name of others when it is loaded, so that
  /// the program begins again with it.
  void
  use_kernels_of_processor(char *arguments[])
  {
    constexpr const char *variable = "OPENBLAS_CORETYPE";
    const auto core = of_openblas<const char *()>("openblas_get_corename");
    if (core == nullptr || std::getenv(variable) != nullptr ||
        std::strcmp(core(), "Prescott") != 0)
      return;
#if defined(__x86_64__)
    const char *name = __builtin_cpu_supports("avx512dq") ? "SkylakeX" :
                       __builtin_cpu_supports("avx2")     ? "Haswell" :
                                                            nullptr;
    if (name != nullptr && setenv(variable, name, 1) == 0)
      execv("/proc/self/exe", arguments); // if it cannot, all goes on as it was
#else
    static_cast<void>(arguments);
#endif
  }

  /// A run without mpirun needs neither a daemon of Open MPI nor a network,
  /// which take a tenth and a fifth of a second to start and to look for
  /// (measured), and no directory in /tmp, which runs that start at once take
  /// from each other (1 of 100 failed); others do not know the variables.
  void
  start_alone()
  {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    for (const char *name : {"PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
      if (std::getenv(name) != nullptr)
        return; // one of several
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }

  /// OpenBLAS takes its buffer, at first twice of it, when a function first
  /// needs one, and tries for ever: let it be now, when there is room.
  void
  take_blas_buffer()
  {
    const auto        number = of_openblas<int()>("openblas_get_num_threads");
    const std::size_t n_threads = number != nullptr ? number() : 1;
    const std::size_t needed    = (n_threads + 1) * blas_buffer;
    if (!has_room(needed))
      end_without_room(needed, environ);
    const int n      = 1;
    double    matrix = 1.;
    int       info   = 0;
    dpotrf_("L", &n, &matrix, &n, &info);
  }
} // namespace

namespace mortise
{
  void
  prepare_process(char *arguments[])
  {
    use_kernels_of_processor(arguments);
    interruption::catch_signals();
    // a file that grows beyond a limit is an error of write(), which is
    // reported
    std::signal(SIGXFSZ, SIG_IGN);
    use_one_blas_thread();
    take_blas_buffer();
    start_alone();
  }
} // namespace mortise
