// The values of a checkpoint as records of cells and slave faces: packed on the
// ranks that own these, and put in their places on others.
#pragma once

#include <mortise/output/checkpoint.h>
#include <mortise/output/checkpoint_scene.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mortise
{
  /// Records of the owned cells and slave faces. A value is in the record of
  /// the first cell, by number, that has its dof: whatever the ranks, it is
  /// there once.
  std::string
  pack_records(const Checkpoint            &checkpoint,
               const Bodies                &bodies,
               const std::vector<Coupling> &couplings);

  /// Takes the records of all ranks, keeps what belongs to this one.
  class RecordReader
  {
  public:
    /// @p bodies and @p couplings must outlive it.
    RecordReader(const Bodies &bodies, const std::vector<Coupling> &couplings);

    /// The next bytes, which may begin and end within a record.
    void
    take(const std::string &block);

    /// After the last block: what does not fit the scene or is missing on this
    /// rank; empty if nothing.
    std::string
    finish();

    /// What was read, with ghost values; to be called once. Collective.
    Checkpoint
    result();

  private:
    /// Displacement or pressure of one body.
    struct Field
    {
      BodyVector       *values = nullptr;
      dealii::IndexSet  owned;
      std::vector<bool> filled; ///< by owned dof
    };

    struct Record;

    /// Its start, before there are the bytes that it tells.
    void
    check(const Record &record);
    void
    put(const Record &record);
    void
    put_cell(const Record &record);
    void
    put_face(const Record &record);
    /// Let finish() return @p what if it is the first.
    void
    note(const std::string &what);

    const Bodies                &bodies;
    const std::vector<Coupling> &couplings;
    const std::size_t            largest_record; ///< values
    Checkpoint                   checkpoint;
    std::string                  rest; ///< an incomplete record
    std::string                  problem;

    /// By body: owned and ghost cells.
    std::vector<std::map<CellNumber, Body::CellIterator>> cells;
    std::vector<std::array<Field, 2>>                     fields;
    /// By interface: the owned slave face with this number of its cell.
    std::vector<std::map<std::pair<CellNumber, unsigned int>, unsigned int>>
                                   faces;
    std::vector<std::vector<bool>> filled_faces;
  };
} // namespace mortise
