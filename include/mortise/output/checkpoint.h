// The state of a run in a file, from which it goes on after an interruption: on
// any number of ranks, for values are found by cell, not by rank.
#pragma once

#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_solution.h>

#include <string>
#include <vector>

namespace mortise
{
  /// What a run needs to go on after a step.
  struct Checkpoint
  {
    /// What the caller keeps, the same on all ranks; opaque here.
    std::string text;

    /// By body, with ghost values.
    std::vector<BodySolution> solutions;

    /// By interface and owned slave face, as of multiplier_coefficients().
    std::vector<std::vector<std::vector<double>>> multipliers;
  };

  /// DIRECTORY/checkpoint.bin
  std::string
  checkpoint_file_name(const std::string &directory);

  /// Write checkpoint_file_name(), whole or not at all: until the new one is
  /// complete the old one is there. Numbers are kept bit for bit. A rank needs
  /// memory for what it writes, about what its solutions take. Collective;
  /// throws OutputError.
  void
  write_checkpoint(const std::string           &directory,
                   const Checkpoint            &checkpoint,
                   const Bodies                &bodies,
                   const std::vector<Coupling> &couplings,
                   MPI_Comm                     comm);

  /// The text alone, before there is a mesh. Collective; throws InputError if
  /// there is no file, if it is damaged (length or checksum), or if another
  /// version of the program or another format has written it.
  std::string
  read_checkpoint_text(const std::string &directory, MPI_Comm comm);

  /// All of it, for the scene as it stands now: text, solutions with ghost
  /// values, multipliers. Of @p couplings the slave faces are needed, not yet
  /// multipliers; without them only what was written without them can be read.
  /// The first rank reads a few MiB at a time and hands them to all: the others
  /// need not see the file. Collective; throws InputError as above, and one
  /// that names what differs between the scene of the checkpoint and this one:
  /// bodies (names, shapes, cells, degrees, dofs, geometry) and interfaces
  /// (names, slaves, faces).
  Checkpoint
  read_checkpoint(const std::string           &directory,
                  const Bodies                &bodies,
                  const std::vector<Coupling> &couplings,
                  MPI_Comm                     comm);
} // namespace mortise
