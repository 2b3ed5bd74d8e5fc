#include <deal.II/base/mpi.h>

#include <mortise/output/vtu_file.h>
#include <mortise/output/whole_file.h>

#include <sstream>

namespace mortise
{
  namespace
  {
    const std::string first_words = "<Piece ", last_words = "</Piece>\n";

    /// Whether the piece of a VTU file that begins at @p start has no cells.
    bool
    is_empty(const std::string &text, const std::size_t start)
    {
      const std::string opening =
        text.substr(start, text.find('>', start) - start);
      return opening.find("NumberOfCells=\"0\"") != std::string::npos;
    }
  } // namespace

  // A file of several ranks has the beginning and the end of one and, between
  // them, the pieces of all. ParaView cannot bear a piece without cells, and no
  // file without a piece.
  template <int d>
  void
  write_vtu_file(const dealii::DataOutInterface<d, 3> &output,
                 const std::string                    &file,
                 const MPI_Comm                        comm)
  {
    std::ostringstream stream;
    // else a stream hides that memory ran out
    stream.exceptions(std::ios::badbit);
    output.write_vtu(stream);
    std::string       text  = stream.str();
    const std::size_t start = text.find(first_words);
    const std::size_t end   = text.rfind(last_words) + last_words.size();
    AssertThrow(start < end && end <= text.size(), dealii::ExcInternalError());

    const bool        empty   = is_empty(text, start);
    const std::string ending  = text.substr(end);
    const int         me      = dealii::Utilities::MPI::this_mpi_process(comm);
    const int         n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    const bool none = dealii::Utilities::MPI::min(empty ? 1 : 0, comm) == 1;
    text.resize(end);
    if (empty && !(none && me == 0))
      text.resize(start); // the first rank's beginning stays
    if (me != 0)
      text.erase(0, start);
    if (me == n_ranks - 1)
      text += ending;
    write_whole_file(file, text, comm);
  }

  template void
  write_vtu_file(const dealii::DataOutInterface<2, 3> &,
                 const std::string &,
                 MPI_Comm);
  template void
  write_vtu_file(const dealii::DataOutInterface<3, 3> &,
                 const std::string &,
                 MPI_Comm);
} // namespace mortise
