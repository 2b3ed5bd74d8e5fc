// Names for the files of a test on several ranks.
#pragma once

#include <deal.II/base/mpi.h>

#include <memory>
#include <string>

#include "temporary_directory.h"

/// @p name in a directory that all ranks of the world share: rank 0 makes it in
/// the first call, which is collective, and removes it when the program ends.
inline std::string
temporary_file(const std::string &name)
{
  namespace Ranks = dealii::Utilities::MPI;
  static const std::unique_ptr<TemporaryDirectory> own(
    Ranks::this_mpi_process(MPI_COMM_WORLD) == 0 ? new TemporaryDirectory :
                                                   nullptr);
  static const std::string path =
    Ranks::broadcast(MPI_COMM_WORLD, own ? own->path : std::string(), 0);
  return path + "/" + name;
}
