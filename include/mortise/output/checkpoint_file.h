// The file of a checkpoint: its parts, their lengths and checksums. It never
// knows a mesh. (Not HDF5: deal.II's wrappers do not look at its errors in
// Release.)
#pragma once

#include <mortise/base/error.h>
#include <mpi.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mortise
{
  struct CheckpointHeader
  {
    std::string text;  ///< of the caller
    std::string scene; ///< as of pack()
  };

  /// Write @p file: @p header of the first rank, then the @p records of all ranks. Collective;
  /// throws OutputError, and leaves an old file as it was.
  void
  write_checkpoint_file(const std::string      &file,
                        const CheckpointHeader &header,
                        const std::string      &records,
                        MPI_Comm                comm);

  /// That @p file is not as it was written: @p how.
  InputError
  damaged_checkpoint(const std::string &file, const std::string &how);

  /// A checkpoint that is open: the first rank reads.
  class CheckpointFile
  {
  public:
    /// Opens @p file and checks all of it. Collective; throws InputError on all ranks if there is
    /// none, it is damaged, or of another version of program or format.
    CheckpointFile(const std::string &file, MPI_Comm comm);
    ~CheckpointFile();

    CheckpointFile(const CheckpointFile &) = delete;
    CheckpointFile &
    operator=(const CheckpointFile &) = delete;

    const CheckpointHeader &
    header() const
    {
      return contents;
    }

    /// Call @p take with all records in blocks of a few MiB, on all ranks; a block may end within a
    /// record. Collective; throws InputError on all ranks if the file cannot be
    /// read any more.
    void
    for_each_block(
      const std::function<void(const std::string &block)> &take) const;

  private:
    /// Records of one rank.
    struct Part
    {
      std::uint64_t size, checksum;
    };

    /// On the first rank: open, check, read the header; throws InputError.
    void
    open();
    std::string
    read_verified_header();
    void
    parse_header(const std::string &header);
    void
    read(std::uint64_t start, char *bytes, std::size_t size) const;
    std::uint64_t
    checksum(std::uint64_t start, std::uint64_t size) const;
    [[noreturn]] void
    fail_as_damaged(const std::string &how) const;

    const std::string name; ///< as messages quote it
    const std::string file;
    const MPI_Comm    comm;
    int               descriptor = -1;
    std::uint64_t     file_size = 0, records_start = 0, records_end = 0;
    CheckpointHeader  contents;
  };
} // namespace mortise
