#include <mortise/base/child_process.h>
#include <mortise/base/error.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace mortise
{
  namespace
  {
    bool
    write_all(const int file, const std::vector<char> &bytes)
    {
      for (std::size_t done = 0; done < bytes.size();)
        {
          const ssize_t n =
            write(file, bytes.data() + done, bytes.size() - done);
          if (n < 0 && errno != EINTR)
            return false;
          done += std::max<ssize_t>(n, 0);
        }
      return true;
    }

    std::vector<char>
    read_all(const int file)
    {
      std::vector<char> bytes, part(1 << 16);
      for (;;)
        {
          const ssize_t n = read(file, part.data(), part.size());
          if (n == 0 || (n < 0 && errno != EINTR))
            return bytes;
          bytes.insert(bytes.end(),
                       part.begin(),
                       part.begin() + std::max<ssize_t>(n, 0));
        }
    }

    /// A thread of a library in which nobody catches what it throws.
    [[noreturn]] void
    end_thread()
    {
      try
        {
          if (std::current_exception())
            throw; // std::rethrow_exception() needs memory
        }
      catch (const std::bad_alloc &)
        {
          _exit(static_cast<int>(ExitCode::memory));
        }
      catch (...)
        {}
      std::abort();
    }

    /// Does @p work and ends the process, without what the parent has to do at
    /// its end.
    [[noreturn]] void
    work_and_end(const std::function<std::vector<char>()> &work, const int file)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (const int number :
           {SIGINT, SIGTERM, SIGHUP, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
        std::signal(number, SIG_DFL);
      std::set_terminate(end_thread);
      bool done = std::freopen("/dev/null", "w", stderr) != nullptr;
      try
        {
          done = done && write_all(file, work());
        }
      catch (const std::bad_alloc &)
        {
          _exit(static_cast<int>(ExitCode::memory));
        }
      catch (...)
        {
          done = false;
        }
      _exit(done ? 0 : 1);
    }
  } // namespace

  std::vector<char>
  in_child_process(const std::function<std::vector<char>()> &work)
  {
    int ends[2];
    if (pipe(ends) != 0)
      throw std::runtime_error("no pipe to a process of its own");
    const pid_t child = fork();
    if (child == 0)
      work_and_end(work, ends[1]);
    close(ends[1]);
    const std::vector<char> bytes = read_all(ends[0]);
    close(ends[0]);
    if (child < 0)
      throw std::runtime_error("no process of its own could be started");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;
    if (WIFSIGNALED(status))
      throw std::runtime_error(std::string("it crashed (") +
                               strsignal(WTERMSIG(status)) + ")");
    if (WEXITSTATUS(status) == static_cast<int>(ExitCode::memory))
      throw std::bad_alloc();
    if (status != 0)
      throw std::runtime_error("it ended before its work was done");
    return bytes;
  }
} // namespace mortise
