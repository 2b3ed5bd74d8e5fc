#include <mortise/base/quotes.h>
#include <mortise/output/bytes.h>
#include <mortise/output/checkpoint_records.h>

#include <algorithm>
#include <cstring>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    enum class RecordKind : std::uint32_t
    {
      displacement,
      pressure,
      multiplier
    };

    /// What a record begins with. That of a cell goes on with one bit for each
    /// of its dofs, by bytes, and the values of those dofs whose bit is set;
    /// that of a slave face with its coefficients.
    struct RecordStart
    {
      RecordKind    kind;
      std::uint32_t part;   ///< number of the body or interface
      std::uint32_t face;   ///< of the cell, or 0
      std::uint32_t n;      ///< dofs of the cell, or coefficients of the face
      CellNumber    number; ///< of the cell
    };

    std::map<CellNumber, Body::CellIterator>
    cells_by_number(const Body &body)
    {
      std::map<CellNumber, Body::CellIterator> cells;
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          cells.emplace(cell->id().to_binary<dim>(), cell);
      return cells;
    }

    /// Where the values of one field of one body are.
    struct PackedField
    {
      RecordKind        kind;
      const IndexSet   &relevant; ///< dofs of owned and ghost cells
      const BodyVector &values;
    };

    /// All cells that have a dof of an owned one are known here.
    void
    pack_cells(const Body                                     &body,
               const std::map<CellNumber, Body::CellIterator> &cells,
               const PackedField                              &field,
               std::string                                    &records)
    {
      std::vector<bool> seen(field.relevant.n_elements(), false);
      std::vector<types::global_dof_index> dofs;
      for (const auto &[number, displacement_cell] : cells)
        {
          const auto cell = field.kind == RecordKind::pressure ?
                              body.pressure->cell(displacement_cell) :
                              displacement_cell;
          dofs.resize(cell->get_fe().n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          std::string bits((dofs.size() + 7) / 8, '\0'), values;
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (const auto k = field.relevant.index_within_set(dofs[i]);
                !seen[k])
              {
                seen[k] = true;
                bits[i / 8] |= static_cast<char>(1u << (i % 8));
                if (cell->is_locally_owned())
                  append_bytes<double>(values, field.values(dofs[i]));
              }
          if (!cell->is_locally_owned())
            continue;
          append_bytes(records,
                       RecordStart{field.kind,
                                   body.index,
                                   0,
                                   static_cast<std::uint32_t>(dofs.size()),
                                   number});
          records += bits;
          records += values;
        }
    }

    void
    pack_faces(const unsigned int                      i,
               const BodySurface                      &slave,
               const std::vector<std::vector<double>> &coefficients,
               std::string                            &records)
    {
      for (unsigned int s = 0; s < slave.faces.size(); ++s)
        {
          append_bytes(records,
                       RecordStart{RecordKind::multiplier,
                                   i,
                                   slave.face_numbers[s],
                                   static_cast<std::uint32_t>(
                                     coefficients[s].size()),
                                   slave.cells[s]->id().to_binary<dim>()});
          for (const double value : coefficients[s])
            append_bytes(records, value);
        }
    }

    bool
    is_set(const char *const bits, const unsigned int i)
    {
      return (static_cast<unsigned char>(bits[i / 8]) >> (i % 8)) & 1u;
    }

    unsigned int
    n_set(const char *const bits, const unsigned int n)
    {
      unsigned int sum = 0;
      for (unsigned int i = 0; i < n; ++i)
        sum += is_set(bits, i);
      return sum;
    }

    /// The first @p n_bits bits say which values there are.
    std::size_t
    bytes_of_bits(const RecordStart &start)
    {
      return start.kind == RecordKind::multiplier ?
               0 :
               (static_cast<std::size_t>(start.n) + 7) / 8;
    }

    /// Of displacements of one cell.
    std::size_t
    most_dofs(const Bodies &bodies)
    {
      std::size_t most = 0;
      for (const auto &body : bodies)
        most = std::max<std::size_t>(
          most, body->dof_handler.get_fe_collection().max_dofs_per_cell());
      return most;
    }
  } // namespace

  std::string
  pack_records(const Checkpoint            &checkpoint,
               const Bodies                &bodies,
               const std::vector<Coupling> &couplings)
  {
    std::string records;
    for (const auto &body : bodies)
      {
        const BodySolution &own   = checkpoint.solutions[body->index];
        const auto          cells = cells_by_number(*body);
        pack_cells(*body,
                   cells,
                   {RecordKind::displacement,
                    body->relevant_dofs,
                    own.displacement},
                   records);
        if (body->pressure)
          pack_cells(*body,
                     cells,
                     {RecordKind::pressure,
                      body->pressure->relevant_dofs,
                      own.pressure},
                     records);
      }
    for (unsigned int i = 0; i < couplings.size(); ++i)
      pack_faces(i,
                 couplings[i].interface->slave(),
                 checkpoint.multipliers[i],
                 records);
    return records;
  }

  struct RecordReader::Record
  {
    RecordStart start;
    const char *bits, *values;
  };

  RecordReader::RecordReader(const Bodies                &bodies,
                             const std::vector<Coupling> &couplings)
    : bodies(bodies)
    , couplings(couplings)
    , largest_record(most_dofs(bodies))
  {
    checkpoint.solutions.resize(bodies.size());
    fields.resize(bodies.size());
    const auto prepare = [](const DoFHandler<dim> &handler,
                            const IndexSet        &relevant,
                            BodyVector            &values,
                            Field                 &field) {
      field.owned = handler.locally_owned_dofs();
      field.filled.resize(field.owned.n_elements(), false);
      values.reinit(field.owned, relevant, handler.get_communicator());
      field.values = &values;
    };
    for (const auto &body : bodies)
      {
        BodySolution &own = checkpoint.solutions[body->index];
        cells.push_back(cells_by_number(*body));
        prepare(body->dof_handler,
                body->relevant_dofs,
                own.displacement,
                fields[body->index][0]);
        if (body->pressure)
          prepare(body->pressure->dof_handler,
                  body->pressure->relevant_dofs,
                  own.pressure,
                  fields[body->index][1]);
      }
    for (const Coupling &coupling : couplings)
      {
        const BodySurface &slave = coupling.interface->slave();
        checkpoint.multipliers.emplace_back(slave.faces.size());
        filled_faces.emplace_back(slave.faces.size(), false);
        faces.emplace_back();
        for (unsigned int s = 0; s < slave.faces.size(); ++s)
          faces.back()[{slave.cells[s]->id().to_binary<dim>(),
                        slave.face_numbers[s]}] = s;
      }
  }

  void
  RecordReader::take(const std::string &block)
  {
    if (!problem.empty())
      return;
    rest += block;
    std::size_t done = 0;
    while (problem.empty())
      {
        ByteReader bytes(rest.data() + done, rest.size() - done);
        if (bytes.left() < sizeof(RecordStart))
          break;
        Record record;
        record.start = bytes.get<RecordStart>();
        check(record);
        if (!problem.empty())
          break;
        const std::size_t bit_bytes = bytes_of_bits(record.start);
        if (bytes.left() < bit_bytes)
          break;
        record.bits = bytes.take(bit_bytes);
        const std::size_t value_bytes =
          sizeof(double) *
          (bit_bytes > 0 ? n_set(record.bits, record.start.n) : record.start.n);
        if (bytes.left() < value_bytes)
          break;
        record.values = bytes.take(value_bytes);
        put(record);
        done = rest.size() - bytes.left();
      }
    rest.erase(0, done);
  }

  void
  RecordReader::check(const Record &record)
  {
    const auto &[kind, part, face, n, number] = record.start;
    if (kind == RecordKind::multiplier ?
          part >= faces.size() :
          kind > RecordKind::multiplier || part >= bodies.size() ||
            !fields[part][static_cast<unsigned int>(kind)].values)
      note("it has a record of what the scene has not");
    else if (n > largest_record)
      note("it has a record of " + std::to_string(n) +
           " values, more than a cell of the scene can have");
  }

  void
  RecordReader::put(const Record &record)
  {
    if (record.start.kind == RecordKind::multiplier)
      put_face(record);
    else
      put_cell(record);
  }

  void
  RecordReader::put_cell(const Record &record)
  {
    const Body &body  = *bodies[record.start.part];
    const auto  found = cells[body.index].find(record.start.number);
    if (found == cells[body.index].end())
      return;
    const bool is_pressure = record.start.kind == RecordKind::pressure;
    const auto cell =
      is_pressure ? body.pressure->cell(found->second) : found->second;
    if (cell->get_fe().n_dofs_per_cell() != record.start.n)
      {
        note("body " + in_quotes(body.name) +
             " has its degrees in other cells than now");
        return;
      }
    std::vector<types::global_dof_index> dofs(record.start.n);
    cell->get_dof_indices(dofs);
    Field     &field = fields[body.index][is_pressure];
    ByteReader values(record.values,
                      sizeof(double) * n_set(record.bits, record.start.n));
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (is_set(record.bits, i))
        {
          const double value = values.get<double>();
          if (field.owned.is_element(dofs[i]))
            {
              const auto k = field.owned.index_within_set(dofs[i]);
              if (field.filled[k])
                note("body " + in_quotes(body.name) +
                     " has two values for the same dof");
              (*field.values)(dofs[i]) = value;
              field.filled[k]          = true;
            }
        }
  }

  void
  RecordReader::put_face(const Record &record)
  {
    const unsigned int i = record.start.part;
    const auto found = faces[i].find({record.start.number, record.start.face});
    if (found == faces[i].end())
      return;
    const unsigned int s     = found->second;
    const FaceTrace   &trace = couplings[i].interface->slave().traces[s];
    if (record.start.n != dim * trace.n_functions())
      {
        note("interface " + in_quotes(couplings[i].interface->name()) +
             " has other degrees on its slave faces than now");
        return;
      }
    std::vector<double> &coefficients = checkpoint.multipliers[i][s];
    coefficients.resize(record.start.n);
    std::memcpy(coefficients.data(),
                record.values,
                sizeof(double) * record.start.n);
    if (filled_faces[i][s])
      note("interface " + in_quotes(couplings[i].interface->name()) +
           " has two records of the same slave face");
    filled_faces[i][s] = true;
  }

  void
  RecordReader::note(const std::string &what)
  {
    if (problem.empty())
      problem = what;
  }

  std::string
  RecordReader::finish()
  {
    const auto all = [](const std::vector<bool> &filled) {
      return std::find(filled.begin(), filled.end(), false) == filled.end();
    };
    for (const auto &body : bodies)
      for (const Field &field : fields[body->index])
        if (!all(field.filled))
          note("body " + in_quotes(body->name) +
               " has no values for some of the dofs that it has now");
    for (unsigned int i = 0; i < couplings.size(); ++i)
      if (!all(filled_faces[i]))
        note("interface " + in_quotes(couplings[i].interface->name()) +
             " has no values for some of the slave faces that it has now");
    if (!rest.empty())
      note("it ends within a record");
    return problem;
  }

  Checkpoint
  RecordReader::result()
  {
    for (const auto &of_body : fields)
      for (const Field &field : of_body)
        if (field.values)
          field.values->update_ghost_values();
    return std::move(checkpoint);
  }
} // namespace mortise
