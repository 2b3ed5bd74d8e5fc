#include <deal.II/base/mpi.h>

#include <boost/crc.hpp>

#include <fcntl.h>
#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/output/bytes.h>
#include <mortise/output/checkpoint_file.h>
#include <mortise/output/summary.h>
#include <mortise/output/whole_file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace mortise
{
  namespace
  {
    /// The start of every format. The checksum is that of the rest and of the
    /// header after it.
    struct CheckpointStart
    {
      std::array<char, 16> magic;
      std::uint64_t        checksum, format, header_size;
    };

    constexpr std::array<char, 16> checkpoint_magic  = {{'M',
                                                         'o',
                                                         'r',
                                                         't',
                                                         'i',
                                                         's',
                                                         'e',
                                                         ' ',
                                                         's',
                                                         't',
                                                         'a',
                                                         't',
                                                         'e',
                                                         '\r',
                                                         '\n',
                                                         '\0'}};
    constexpr std::uint64_t        checkpoint_format = 5;
    constexpr std::uint64_t        checkpoint_block  = 1 << 22;

    std::uint64_t
    checksum_of(const std::string &bytes)
    {
      boost::crc_32_type crc;
      crc.process_bytes(bytes.data(), bytes.size());
      return crc.checksum();
    }
  } // namespace

  void
  write_checkpoint_file(const std::string      &file,
                        const CheckpointHeader &header,
                        const std::string      &records,
                        const MPI_Comm          comm)
  {
    const std::array<std::uint64_t, 2> own = {
      {records.size(), checksum_of(records)}};
    const auto  parts = dealii::Utilities::MPI::gather(comm, own, 0);
    std::string piece;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::string contents;
        append_text(contents, program_info(1).version);
        append_text(contents, header.text);
        append_text(contents, header.scene);
        append_bytes<std::uint64_t>(contents, parts.size());
        for (const auto &part : parts)
          append_bytes(contents, part);

        std::string checked;
        append_bytes(checked, checkpoint_format);
        append_bytes<std::uint64_t>(checked, contents.size());
        checked += contents;
        append_bytes(piece, checkpoint_magic);
        append_bytes(piece, checksum_of(checked));
        piece += checked;
      }
    write_whole_file(file, piece.empty() ? records : piece + records, comm);
  }

  CheckpointFile::CheckpointFile(const std::string &file, const MPI_Comm comm)
    : name(file_in_quotes(file))
    , file(file)
    , comm(comm)
  {
    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          open();
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    // the destructor does not run after this
    if (!problem.empty() && descriptor >= 0)
      ::close(descriptor);
    throw_if_any(problem, comm);
    contents.text  = dealii::Utilities::MPI::broadcast(comm, contents.text, 0);
    contents.scene = dealii::Utilities::MPI::broadcast(comm, contents.scene, 0);
    records_start  = dealii::Utilities::MPI::broadcast(comm, records_start, 0);
    records_end    = dealii::Utilities::MPI::broadcast(comm, records_end, 0);
  }

  CheckpointFile::~CheckpointFile()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }

  InputError
  damaged_checkpoint(const std::string &file, const std::string &how)
  {
    return InputError("The checkpoint " + file_in_quotes(file) +
                      " is damaged: " + how +
                      "; allowed: a checkpoint as Mortise has left it. Without "
                      "one the run has to start anew");
  }

  void
  CheckpointFile::fail_as_damaged(const std::string &how) const
  {
    throw damaged_checkpoint(file, how);
  }

  void
  CheckpointFile::open()
  {
    descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status;
    if (descriptor < 0 || fstat(descriptor, &status) != 0)
      throw InputError("Cannot read the checkpoint " + name + ": " +
                       std::strerror(errno) +
                       "; allowed: the directory of a run that has written "
                       "a checkpoint");
    if (!S_ISREG(status.st_mode))
      throw InputError("Cannot read the checkpoint " + name +
                       ": it is not a file; allowed: the directory of a run "
                       "that has written a checkpoint");
    file_size = status.st_size;
    try
      {
        parse_header(read_verified_header());
      }
    catch (const std::out_of_range &error)
      {
        fail_as_damaged(error.what());
      }
  }

  std::string
  CheckpointFile::read_verified_header()
  {
    if (file_size < sizeof(CheckpointStart))
      fail_as_damaged("it ends after " + std::to_string(file_size) + " bytes");
    CheckpointStart start;
    read(0, reinterpret_cast<char *>(&start), sizeof(start));
    if (start.magic != checkpoint_magic)
      throw InputError("The file " + name +
                       " is damaged or no checkpoint: it does not begin as "
                       "one; allowed: a checkpoint as Mortise has left it");
    if (start.header_size > file_size - sizeof(start))
      fail_as_damaged("it ends after " + std::to_string(file_size) +
                      " bytes, within its header");
    // without memory for a header of which only the length is wrong
    constexpr auto checked = offsetof(CheckpointStart, format);
    if (checksum(checked, sizeof(start) - checked + start.header_size) !=
        start.checksum)
      fail_as_damaged("its header does not match its checksum");
    if (start.format != checkpoint_format)
      throw InputError("The checkpoint " + name + " has format " +
                       std::to_string(start.format) + ", allowed is format " +
                       std::to_string(checkpoint_format) +
                       ": another version of Mortise has written it");
    records_start = sizeof(start) + start.header_size;
    std::string header(start.header_size, '\0');
    read(sizeof(start), header.data(), header.size());
    return header;
  }

  void
  CheckpointFile::parse_header(const std::string &header)
  {
    ByteReader        bytes(header);
    const std::string version = bytes.get_text();
    if (const std::string own = program_info(1).version; version != own)
      throw InputError("The checkpoint " + name + " was written by version " +
                       in_quotes(version) +
                       " of Mortise, and this is version " + in_quotes(own) +
                       "; allowed: a checkpoint of the same version");
    contents.text      = bytes.get_text();
    contents.scene     = bytes.get_text();
    const auto n_parts = bytes.get<std::uint64_t>();
    if (bytes.left() % sizeof(Part) != 0 ||
        bytes.left() / sizeof(Part) != n_parts)
      fail_as_damaged("its header has " + std::to_string(bytes.left()) +
                      " bytes for the lengths of " + std::to_string(n_parts) +
                      " parts");
    std::vector<Part> parts(n_parts);
    records_end = records_start;
    for (Part &part : parts)
      {
        part = bytes.get<Part>();
        if (part.size > std::numeric_limits<std::uint64_t>::max() - records_end)
          fail_as_damaged("a part of it has " + std::to_string(part.size) +
                          " bytes");
        records_end += part.size;
      }
    if (file_size != records_end)
      fail_as_damaged("it has " + std::to_string(file_size) +
                      " bytes instead of " + std::to_string(records_end));
    std::uint64_t start = records_start;
    for (const Part &part : parts)
      {
        if (checksum(start, part.size) != part.checksum)
          fail_as_damaged("its values from byte " + std::to_string(start) +
                          " on do not match their checksum");
        start += part.size;
      }
  }

  void
  CheckpointFile::read(std::uint64_t start, char *bytes, std::size_t size) const
  {
    while (size > 0)
      {
        const ssize_t got = pread(descriptor, bytes, size, start);
        if (got == 0)
          fail_as_damaged("it ends after " + std::to_string(start) + " bytes");
        if (got < 0 && errno != EINTR)
          throw InputError("Cannot read the checkpoint " + name + ": " +
                           std::strerror(errno));
        if (got > 0)
          {
            start += got;
            bytes += got;
            size -= got;
          }
      }
  }

  std::uint64_t
  CheckpointFile::checksum(std::uint64_t start, const std::uint64_t size) const
  {
    boost::crc_32_type crc;
    std::string        block(std::min(size, checkpoint_block), '\0');
    for (const std::uint64_t end = start + size; start < end;
         start += block.size())
      {
        block.resize(std::min(end - start, checkpoint_block));
        read(start, block.data(), block.size());
        crc.process_bytes(block.data(), block.size());
      }
    return crc.checksum();
  }

  void
  CheckpointFile::for_each_block(
    const std::function<void(const std::string &block)> &take) const
  {
    std::string block, problem;
    for (std::uint64_t start = records_start; start < records_end;
         start += block.size())
      {
        if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
          try
            {
              block.resize(std::min(records_end - start, checkpoint_block));
              read(start, block.data(), block.size());
            }
          catch (const InputError &error)
            {
              problem = error.what();
              block.clear();
            }
        block = dealii::Utilities::MPI::broadcast(comm, block, 0);
        if (block.empty())
          break;
        take(block);
      }
    throw_if_any(problem, comm);
  }
} // namespace mortise
