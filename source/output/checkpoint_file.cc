#include <deal.II/base/mpi.h>

#include <boost/crc.hpp>

#include <fcntl.h>
#include <mortise/base/quotes.h>
#include <mortise/output/checkpoint_file.h>
#include <mortise/output/summary.h>
#include <mortise/output/whole_file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
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
      char          magic[16];
      std::uint64_t checksum, format, header_size;
    };

    constexpr char checkpoint_magic[]         = "Mortise state\r\n"; // and '\0'
    constexpr std::uint64_t checkpoint_format = 7;
    constexpr std::uint64_t checkpoint_block  = 1 << 22;

    std::uint64_t
    checksum_of(const std::string &bytes)
    {
      boost::crc_32_type crc;
      crc.process_bytes(bytes.data(), bytes.size());
      return crc.checksum();
    }
  } // namespace

  void
  write_checkpoint_file(const std::string &file,
                        const Sections    &shared,
                        const Sections    &records,
                        const MPI_Comm     comm)
  {
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    // size and checksum by section, as the ranks write them
    std::map<std::string, std::array<std::uint64_t, 2>> own;
    std::string                                         values;
    for (const Sections *sections : {&shared, &records})
      for (const auto &[name, bytes] : *sections)
        if (sections == &records || is_first)
          {
            own[name] = {{bytes.size(), checksum_of(bytes)}};
            values += bytes;
          }
    const auto  ranks = dealii::Utilities::MPI::gather(comm, own, 0);
    std::string piece;
    if (is_first)
      {
        // in the order in which they are in the file
        std::vector<std::string> names;
        for (const Sections *sections : {&shared, &records})
          for (const auto &section : *sections)
            names.push_back(section.first);
        const std::string checked = to_bytes(checkpoint_format) +
                                    to_bytes(to_bytes(program_info(1).version) +
                                             to_bytes(names) + to_bytes(ranks));
        piece.assign(checkpoint_magic, sizeof(checkpoint_magic));
        piece += to_bytes(checksum_of(checked)) + checked;
      }
    write_whole_file(file, piece + values, comm);
  }

  CheckpointFile::CheckpointFile(const std::string &file, const MPI_Comm comm)
    : file(file)
    , quoted(file_in_quotes(file))
    , comm(comm)
  {
    const auto on_first = [&](const auto &action) {
      std::string problem;
      if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
        try
          {
            action();
          }
        catch (const InputError &error)
          {
            problem = error.what();
          }
      throw_if_any(problem, comm);
    };
    std::string header;
    on_first([&] { header = open(); });
    header    = dealii::Utilities::MPI::broadcast(comm, header, 0);
    file_size = dealii::Utilities::MPI::broadcast(comm, file_size, 0);
    try
      {
        parse_header(header);
      }
    catch (const std::out_of_range &error)
      {
        throw damaged(error.what());
      }
    on_first([&] { check_sections(); });
  }

  CheckpointFile::Descriptor::~Descriptor()
  {
    if (number >= 0)
      ::close(number);
  }

  InputError
  damaged_checkpoint(const std::string &file, const std::string &how)
  {
    return InputError("The checkpoint " + file_in_quotes(file) +
                      " is damaged: " + how +
                      "; allowed: a checkpoint as Mortise has left it. Without "
                      "one the run has to start anew");
  }

  std::string
  CheckpointFile::open()
  {
    descriptor.number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status;
    const bool  is_there =
      descriptor.number >= 0 && fstat(descriptor.number, &status) == 0;
    if (!is_there || !S_ISREG(status.st_mode))
      throw InputError("Cannot read the checkpoint " + quoted + ": " +
                       (is_there ? "it is not a file" : std::strerror(errno)) +
                       "; allowed: the directory of a run that has written "
                       "a checkpoint");
    file_size = status.st_size;
    if (file_size < sizeof(CheckpointStart))
      throw damaged("it ends after " + std::to_string(file_size) + " bytes");
    CheckpointStart start;
    read(0, reinterpret_cast<char *>(&start), sizeof(start));
    if (std::memcmp(start.magic, checkpoint_magic, sizeof(start.magic)) != 0)
      throw InputError("The file " + quoted +
                       " is damaged or no checkpoint: it does not begin as "
                       "one; allowed: a checkpoint as Mortise has left it");
    if (start.header_size > file_size - sizeof(start))
      throw damaged("it ends after " + std::to_string(file_size) +
                    " bytes, within its header");
    // without memory for a header of which only the length is wrong
    constexpr auto checked = offsetof(CheckpointStart, format);
    if (checksum(checked, sizeof(start) - checked + start.header_size) !=
        start.checksum)
      throw damaged("its header does not match its checksum");
    if (start.format != checkpoint_format)
      throw InputError("The checkpoint " + quoted + " has format " +
                       std::to_string(start.format) + ", allowed is format " +
                       std::to_string(checkpoint_format) +
                       ": another version of Mortise has written it");
    std::string header(start.header_size, '\0');
    read(sizeof(start), header.data(), header.size());
    return header;
  }

  void
  CheckpointFile::parse_header(const std::string &header)
  {
    ByteArchive archive(header);
    std::string version;
    archive    &version;
    if (const std::string own = program_info(1).version; version != own)
      throw InputError("The checkpoint " + quoted + " was written by version " +
                       in_quotes(version) +
                       " of Mortise, and this is version " + in_quotes(own) +
                       "; allowed: a checkpoint of the same version");
    std::vector<std::string>                                         names;
    std::vector<std::map<std::string, std::array<std::uint64_t, 2>>> ranks;
    archive &names                                                  &ranks;
    if (archive.left() > 0)
      throw damaged("its header has " + std::to_string(archive.left()) +
                    " bytes too many");
    std::uint64_t end = sizeof(CheckpointStart) + header.size();
    for (const auto &sections_of_rank : ranks)
      for (const std::string &name : names)
        if (const auto part = sections_of_rank.find(name);
            part != sections_of_rank.end())
          {
            const auto &[size, checksum] = part->second;
            if (size > std::numeric_limits<std::uint64_t>::max() - end)
              throw damaged("a part of it has " + std::to_string(size) +
                            " bytes");
            sections[name].push_back({{size, checksum, end}});
            end += size;
          }
    if (file_size != end)
      throw damaged("it has " + std::to_string(file_size) +
                    " bytes instead of " + std::to_string(end));
  }

  void
  CheckpointFile::check_sections() const
  {
    for (const auto &[name, parts] : sections)
      for (const auto &[size, expected, start] : parts)
        if (checksum(start, size) != expected)
          throw damaged("the values of its section " + in_quotes(name) +
                        " from byte " + std::to_string(start) +
                        " on do not match their checksum");
  }

  void
  CheckpointFile::read(std::uint64_t start, char *bytes, std::size_t size) const
  {
    while (size > 0)
      {
        const ssize_t got = pread(descriptor.number, bytes, size, start);
        if (got == 0)
          throw damaged("it ends after " + std::to_string(start) + " bytes");
        if (got < 0 && errno != EINTR)
          throw InputError("Cannot read the checkpoint " + quoted + ": " +
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
    const std::string                              &section,
    const std::function<void(const std::string &)> &take,
    const std::uint64_t                             size) const
  {
    if (!has(section))
      throw InputError("The checkpoint " + quoted + " has no section " +
                       in_quotes(section) +
                       ", without which the run cannot go on; allowed: a "
                       "checkpoint that has it");
    std::string block, problem;
    for (auto [left, checksum, start] : sections.at(section))
      for (; left > 0 && problem.empty(); left -= block.size())
        {
          block.resize(std::min(left, size));
          if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
            try
              {
                read(start, block.data(), block.size());
              }
            catch (const InputError &error)
              {
                problem = error.what();
              }
          problem = dealii::Utilities::MPI::broadcast(comm, problem, 0);
          if (!problem.empty())
            break;
          block = dealii::Utilities::MPI::broadcast(comm, block, 0);
          take(block);
          start += block.size();
        }
    throw_if_any(problem, comm);
  }

  std::string
  CheckpointFile::read(const std::string &section) const
  {
    std::string bytes;
    for_each_block(
      section,
      [&](const std::string &block) { bytes += block; },
      checkpoint_block);
    return bytes;
  }

  void
  CheckpointFile::for_each_record(
    const std::string                              &section,
    const std::function<void(const std::string &)> &take,
    const std::uint64_t                             block_size) const
  {
    std::string rest; // an incomplete record
    for_each_block(
      section,
      [&](const std::string &block) {
        rest += block;
        ByteArchive   bytes(rest);
        std::size_t   done = 0;
        std::uint64_t size;
        while (bytes.left() >= sizeof(size))
          {
            bytes &size;
            if (bytes.left() < size)
              break;
            take(std::string(bytes.take(size), size));
            done = rest.size() - bytes.left();
          }
        rest.erase(0, done);
      },
      block_size);
    if (!rest.empty())
      throw damaged("its section " + in_quotes(section) +
                    " ends within a record");
  }
} // namespace mortise
