#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <mortise/base/interruption.h>
#include <mortise/output/whole_file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace mortise
{
  namespace
  {
    /// What helps against the error @p number of the system.
    std::string
    advice(const int number)
    {
      const std::string other =
        "choose another Output/Directory (--output DIR)";
      rlimit limit;
      switch (number)
        {
          case ENOSPC:
          case EDQUOT:
            return "make room there or " + other;
          case EFBIG:
            if (getrlimit(RLIMIT_FSIZE, &limit) == 0 &&
                limit.rlim_cur != RLIM_INFINITY)
              return "files may have " + std::to_string(limit.rlim_cur) +
                     " bytes; raise this limit (ulimit -f) or " + other;
            return other;
          case EISDIR:
            return "a directory has this name: move it away or " + other;
          default:
            return other;
        }
    }

    /// A file that grows beside its final name. After a failure nothing more
    /// happens; what is unfinished is removed in the end.
    class NewFile
    {
    public:
      explicit NewFile(const std::string &name)
        : name(name)
      {
        const auto      parent = std::filesystem::path(name).parent_path();
        std::error_code error;
        if (!parent.empty())
          std::filesystem::create_directories(parent, error);
        if (error)
          fail(error.value());
        else
          open();
      }

      ~NewFile()
      {
        close();
        if (!unfinished.empty())
          unlink(unfinished.c_str());
        interruption::set_unfinished("");
      }

      NewFile(const NewFile &) = delete;
      NewFile &
      operator=(const NewFile &) = delete;

      void
      append(const char *data, std::size_t size)
      {
        while (size > 0 && failure.empty())
          {
            const ssize_t written = write(descriptor, data, size);
            if (written >= 0)
              {
                data += written;
                size -= written;
              }
            else if (errno != EINTR)
              fail(errno);
          }
      }

      /// Give it its name; what went wrong, empty if nothing did.
      std::string
      finish()
      {
        // a disk elsewhere may say only now that it is full
        if (failure.empty() && close() != 0)
          fail(errno);
        if (failure.empty() && rename(unfinished.c_str(), name.c_str()) != 0)
          fail(errno);
        if (failure.empty())
          unfinished.clear();
        return failure;
      }

    private:
      /// Under a name that nobody has: not another run, not one that was
      /// killed, not one on another machine.
      void
      open()
      {
        for (unsigned int attempt = 0; attempt < 1000; ++attempt)
          {
            unfinished = name + ".unfinished." + std::to_string(getpid()) +
                         "." + std::to_string(attempt);
            descriptor = ::open(unfinished.c_str(),
                                O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                                0666);
            if (descriptor >= 0)
              {
                interruption::set_unfinished(unfinished);
                return;
              }
            if (errno != EEXIST)
              break;
          }
        fail(errno);
        unfinished.clear();
      }

      int
      close()
      {
        const int old = descriptor;
        descriptor    = -1;
        return old < 0 ? 0 : ::close(old);
      }

      void
      fail(const int number)
      {
        failure = std::string(std::strerror(number)) + "; " + advice(number);
      }

      const std::string name;
      std::string       unfinished, failure;
      int               descriptor = -1;
    };

    constexpr std::uint64_t chunk = 1 << 22;
    constexpr int           tag   = 0;

    /// Append what @p rank sends with send_to_first(), @p size bytes, by chunks; all of it is
    /// received even when it can no longer be written: the sender waits.
    void
    append_from(const int           rank,
                const std::uint64_t size,
                NewFile            &file,
                const MPI_Comm      comm)
    {
      std::string buffer(std::min(size, chunk), ' ');
      for (std::uint64_t start = 0; start < size; start += chunk)
        {
          const int n = std::min(chunk, size - start);
          MPI_Recv(
            buffer.data(), n, MPI_CHAR, rank, tag, comm, MPI_STATUS_IGNORE);
          file.append(buffer.data(), n);
        }
    }

    void
    send_to_first(const std::string &piece, const MPI_Comm comm)
    {
      for (std::uint64_t start = 0; start < piece.size(); start += chunk)
        MPI_Send(piece.data() + start,
                 std::min<std::uint64_t>(chunk, piece.size() - start),
                 MPI_CHAR,
                 0,
                 tag,
                 comm);
    }
  } // namespace

  OutputError::OutputError(const std::string &file, const std::string &reason)
    : InputError("cannot write \"" + file + "\": " + reason)
    , file(file)
    , reason(reason)
  {}

  void
  write_whole_file(const std::string &file,
                   const std::string &piece,
                   const MPI_Comm     comm)
  {
    const std::uint64_t mine  = piece.size();
    const auto          sizes = dealii::Utilities::MPI::gather(comm, mine, 0);
    std::string         failure;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        NewFile result(file);
        result.append(piece.data(), piece.size());
        for (unsigned int rank = 1; rank < sizes.size(); ++rank)
          append_from(rank, sizes[rank], result, comm);
        failure = result.finish();
      }
    else
      send_to_first(piece, comm);
    failure = dealii::Utilities::MPI::broadcast(comm, failure, 0);
    if (!failure.empty())
      throw OutputError(file, failure);
    interruption::add_complete(file);
  }

  std::string
  describe(const std::vector<OutputError> &errors)
  {
    std::string              text;
    std::vector<std::string> reasons;
    for (const OutputError &error : errors)
      if (std::find(reasons.begin(), reasons.end(), error.reason) ==
          reasons.end())
        reasons.push_back(error.reason);
    for (const std::string &reason : reasons)
      {
        constexpr std::size_t    most = 6;
        std::vector<std::string> files;
        for (const OutputError &error : errors)
          if (error.reason == reason &&
              std::find(files.begin(), files.end(), error.file) == files.end())
            files.push_back(error.file);
        std::string names;
        for (std::size_t i = 0; i < std::min(files.size(), most); ++i)
          names += (names.empty() ? "\"" : ", \"") + files[i] + "\"";
        if (files.size() > most)
          names += " and " + std::to_string(files.size() - most) + " more";
        text += (text.empty() ? "cannot write " : "\ncannot write ") + names +
                ": " + reason;
      }
    return text;
  }
} // namespace mortise
