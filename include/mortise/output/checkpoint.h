// The solution of a scene in an archive, from which a run goes on after an
// interruption: on any number of ranks, for values are found by cell and slave
// face, not by rank.
#pragma once

#include <mortise/mortar/coupling.h>
#include <mortise/operators/scene_solution.h>
#include <mortise/output/checkpoint_file.h>

#include <vector>

namespace mortise
{
  struct SceneValues
  {
    /// By body, with ghost values.
    std::vector<BodySolution> solutions;

    /// By interface and owned slave face, as of multiplier_coefficients().
    std::vector<std::vector<std::vector<double>>> multipliers;

    /// By body, displacements of the last step with arc-length control; or
    /// empty.
    std::vector<BodySolution> increments = {};
  };

  /// Write checkpoint_file_name(), whole or not at all: until the new one is
  /// complete the old one is there. Beside the @p sections of the caller, the
  /// same on all ranks, it has those that read_scene() needs. Numbers are kept
  /// bit for bit. A rank needs memory for what it writes, about what its
  /// solutions take. Collective; throws OutputError.
  void
  write_checkpoint(const std::string           &directory,
                   Sections                     sections,
                   const SceneValues           &values,
                   const Bodies                &bodies,
                   const std::vector<Coupling> &couplings,
                   MPI_Comm                     comm);

  /// Read the values of @p file for the present scene. Of @p couplings the
  /// slave faces are needed, not yet multipliers; without them only what was
  /// written without them can be read. The file is read @p block bytes at a
  /// time. Collective; throws InputError if it is damaged, and one that names
  /// what differs between the scene of the checkpoint and this one: bodies
  /// (names, shapes, cells, degrees, dofs, geometry) and interfaces (names,
  /// slaves, faces).
  SceneValues
  read_scene(const CheckpointFile        &file,
             const Bodies                &bodies,
             const std::vector<Coupling> &couplings,
             MPI_Comm                     comm,
             std::uint64_t                block = 1 << 22);
} // namespace mortise
