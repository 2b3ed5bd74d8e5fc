// Files that appear whole or not at all: every result goes through here.
#pragma once

#include <mortise/base/error.h>
#include <mpi.h>

#include <string>
#include <vector>

namespace mortise
{
  /// A file that could not be written; others may still be.
  class OutputError : public InputError
  {
  public:
    OutputError(const std::string &file, const std::string &reason);

    std::string file;
    std::string reason; ///< why, and what helps
  };

  /// Give @p file the @p piece of every rank, one after the other in the order of the ranks; its
  /// directory is made with its parents if need be. The text is written under
  /// a name of its own beside @p file and renamed when all of it is written, so that a reader
  /// sees the old file or the new one, also while another run writes there.
  /// The first rank writes; it holds a few MiB of the others' pieces at a time.
  /// Throws OutputError on every rank, and leaves an old file as it was, if
  /// anything fails. Collective.
  void
  write_whole_file(const std::string &file,
                   const std::string &piece,
                   MPI_Comm           comm);

  /// One message for all @p errors: files with the same reason on one line, of
  /// many only the first.
  std::string
  describe(const std::vector<OutputError> &errors);
} // namespace mortise
