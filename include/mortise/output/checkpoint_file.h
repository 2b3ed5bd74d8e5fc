// An archive of sections that are found by name: their lengths and checksums.
// It knows no mesh. A program that reads skips sections that it does not ask
// for. (Not HDF5: deal.II's wrappers do not look at its errors in Release.)
#pragma once

#include <mortise/base/error.h>
#include <mortise/output/bytes.h>
#include <mpi.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace mortise
{
  /// Bytes by name.
  using Sections = std::map<std::string, std::string>;

  /// DIRECTORY/checkpoint.bin
  inline std::string
  checkpoint_file_name(const std::string &directory)
  {
    return directory + "/checkpoint.bin";
  }

  /// Write @p file, whole or not at all: @p shared of the first rank, and what all ranks have as
  /// @p records, under the same names on all of them. Collective; throws
  /// OutputError, and leaves an old file as it was.
  void
  write_checkpoint_file(const std::string &file,
                        const Sections    &shared,
                        const Sections    &records,
                        MPI_Comm           comm);

  /// That @p file is not as it was written: @p how.
  InputError
  damaged_checkpoint(const std::string &file, const std::string &how);

  /// An archive that is open: the first rank reads a few MiB at a time and
  /// hands them to all; the others need not see the file.
  class CheckpointFile
  {
  public:
    /// Opens @p file and checks all of it. Collective; throws InputError on all ranks if there is
    /// none, it is damaged (length or checksum), or of another version of
    /// program or format.
    CheckpointFile(const std::string &file, MPI_Comm comm);

    bool
    has(const std::string &section) const
    {
      return sections.count(section) > 0;
    }

    /// All of it, on all ranks. Collective; throws InputError on all ranks if
    /// there is none, or the file cannot be read any more.
    std::string
    read(const std::string &section) const;

    /// The same as the inverse of to_bytes(); throws InputError if that is
    /// impossible.
    template <typename T>
    T
    get(const std::string &section) const
    {
      try
        {
          return from_bytes<T>(read(section));
        }
      catch (const std::out_of_range &error)
        {
          throw damaged(error.what());
        }
    }

    /// Pass the texts of @p section, written by to_bytes(), one after the
    /// other, reading @p block bytes at a time.
    void
    for_each_record(const std::string                              &section,
                    const std::function<void(const std::string &)> &take,
                    std::uint64_t block = 1 << 22) const;

    InputError
    damaged(const std::string &how) const
    {
      return damaged_checkpoint(file, how);
    }

    /// As messages quote it.
    const std::string &
    name() const
    {
      return quoted;
    }

  private:
    /// The part of one rank in a section: size, checksum, start.
    using Part = std::array<std::uint64_t, 3>;

    /// On the first rank: the header; throws InputError.
    std::string
    open();
    /// Throws InputError, and std::out_of_range where it is too short.
    void
    parse_header(const std::string &header);
    void
    check_sections() const;
    void
    read(std::uint64_t start, char *bytes, std::size_t size) const;
    std::uint64_t
    checksum(std::uint64_t start, std::uint64_t size) const;
    void
    for_each_block(const std::string                              &section,
                   const std::function<void(const std::string &)> &take,
                   std::uint64_t                                   block) const;

    struct Descriptor
    {
      Descriptor()                   = default;
      Descriptor(const Descriptor &) = delete;
      ~Descriptor();
      int number = -1;
    };

    const std::string                        file, quoted;
    const MPI_Comm                           comm;
    Descriptor                               descriptor;
    std::uint64_t                            file_size = 0;
    std::map<std::string, std::vector<Part>> sections;
  };
} // namespace mortise
