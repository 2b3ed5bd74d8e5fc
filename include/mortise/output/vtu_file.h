// VTU files of all ranks' cells.
#pragma once

#include <deal.II/base/data_out_base.h>

#include <mpi.h>

#include <string>

namespace mortise
{
  /// Write the patches of all ranks' @p output, cells (d = 3) or faces (d = 2), into @p file.
  /// Throws OutputError on every rank as write_whole_file() does. Collective.
  template <int d>
  void
  write_vtu_file(const dealii::DataOutInterface<d, 3> &output,
                 const std::string                    &file,
                 MPI_Comm                              comm);
} // namespace mortise
