// The records of a checkpoint: what cells and faces have. Only sources of
// checkpoints include this.
#pragma once

#include <mortise/operators/scene_solution.h>
#include <mortise/output/checkpoint_file.h>
#include <mortise/output/checkpoint_scene.h>

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace mortise
{
  /// Of a cell with one bit for each of its dofs, by bytes, and the values of
  /// those whose bit is set: a value is in the record of the first cell, by
  /// number, that has its dof, so that it is there once, whatever the ranks.
  /// Of a slave face with its coefficients, or of a cell with what its points
  /// remember.
  struct Record
  {
    std::uint32_t       part = 0; ///< number of the body or interface
    std::uint32_t       face = 0; ///< of the cell
    CellNumber          cell = {};
    std::string         bits;
    std::vector<double> values;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &part &face &cell &bits &values;
    }
  };

  using CellsByNumber = std::map<CellNumber, Body::CellIterator>;

  /// Those that a rank knows.
  inline CellsByNumber
  cells_by_number(const Body &body)
  {
    CellsByNumber cells;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        cells.emplace(cell->id().to_binary<dim>(), cell);
    return cells;
  }

  /// Give @p put the records of all ranks, which says in words what does not fit the scene; returns the
  /// first such words, or nothing.
  template <typename Put>
  std::string
  read_records(const CheckpointFile &file,
               const char *const     section,
               const std::uint64_t   block,
               const Put            &put)
  {
    std::string problem;
    file.for_each_record(
      section,
      [&](const std::string &bytes) {
        Record record;
        try
          {
            record = from_bytes<Record>(bytes);
          }
        catch (const std::out_of_range &error)
          {
            throw file.damaged(error.what()); // on all ranks
          }
        if (problem.empty())
          problem = put(record);
      },
      block);
    return problem;
  }

  constexpr const char *unknown_record =
    "it has a record of what the scene has not";

  /// Does its law have histories of points?
  bool
  remembers(const Body &body);

  /// Those of @p solution join @p records.
  void
  append_histories(const Body         &body,
                   const BodySolution &solution,
                   std::string        &records);

  /// Set the histories of @p solutions to those of @p file; returns in words what
  /// does not fit the scene. Collective.
  std::string
  read_histories(const CheckpointFile      &file,
                 std::uint64_t              block,
                 const Bodies              &bodies,
                 std::vector<BodySolution> &solutions);

  /// Section of the histories of points.
  constexpr const char *histories_section = "histories";
} // namespace mortise
