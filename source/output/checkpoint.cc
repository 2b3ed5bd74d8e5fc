#include <deal.II/base/exceptions.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/output/checkpoint.h>
#include <mortise/output/checkpoint_scene.h>

#include <algorithm>
#include <map>
#include <utility>

#include "checkpoint_records.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    const char *const of_scene = "scene", *const of_faces = "multipliers";

    /// A section for each field of the bodies.
    struct FieldKind
    {
      const char *section;
      bool        is_pressure;
    };

    constexpr FieldKind field_kinds[] = {{"displacements", false},
                                         {"pressures", true}};
    constexpr FieldKind of_increments = {"increments", false};

    std::vector<types::global_dof_index>
    dofs_of(const Body               &body,
            const Body::CellIterator &cell,
            const FieldKind          &kind)
    {
      const auto own = kind.is_pressure ? body.pressure->cell(cell) : cell;
      std::vector<types::global_dof_index> dofs(
        own->get_fe().n_dofs_per_cell());
      own->get_dof_indices(dofs);
      return dofs;
    }

    /// All cells that have a dof of an owned one are known here.
    void
    append_cells(const Body         &body,
                 const BodySolution &solution,
                 const FieldKind    &kind,
                 std::string        &records)
    {
      const BodyVector &field =
        kind.is_pressure ? solution.pressure : solution.displacement;
      const IndexSet &relevant =
        kind.is_pressure ? body.pressure->relevant_dofs : body.relevant_dofs;
      std::vector<bool> seen(relevant.n_elements(), false);
      for (const auto &[number, cell] : cells_by_number(body))
        {
          const auto dofs = dofs_of(body, cell, kind);
          Record     record{body.index, 0, number, {}, {}};
          record.bits.resize((dofs.size() + 7) / 8, '\0');
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (const auto k = relevant.index_within_set(dofs[i]); !seen[k])
              {
                seen[k] = true;
                record.bits[i / 8] |= static_cast<char>(1u << (i % 8));
                if (cell->is_locally_owned())
                  record.values.push_back(field(dofs[i]));
              }
          if (cell->is_locally_owned())
            records += to_bytes(to_bytes(std::move(record)));
        }
    }

    bool
    all(const std::vector<bool> &filled)
    {
      return std::find(filled.begin(), filled.end(), false) == filled.end();
    }

    /// One field of one body, as far as it is read.
    struct Field
    {
      Field(const Body &body, const FieldKind &kind, BodySolution &solution)
        : body(body)
        , kind(kind)
        , cells(cells_by_number(body))
        , values(kind.is_pressure ? solution.pressure : solution.displacement)
        , owned(
            (kind.is_pressure ? body.pressure->dof_handler : body.dof_handler)
              .locally_owned_dofs())
        , filled(owned.n_elements(), false)
      {
        values.reinit(owned,
                      kind.is_pressure ? body.pressure->relevant_dofs :
                                         body.relevant_dofs,
                      body.triangulation().get_communicator());
      }

      /// As read_records() asks for.
      std::string
      put(const Record &record)
      {
        const auto cell = cells.find(record.cell);
        if (cell == cells.end())
          return "";
        const auto dofs  = dofs_of(body, cell->second, kind);
        auto       value = record.values.begin();
        if (record.bits.size() != (dofs.size() + 7) / 8)
          return other_degrees();
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if ((static_cast<unsigned char>(record.bits[i / 8]) >> (i % 8)) & 1u)
            {
              if (value == record.values.end())
                return other_degrees();
              if (owned.is_element(dofs[i]))
                {
                  const auto k = owned.index_within_set(dofs[i]);
                  if (filled[k])
                    return "body " + in_quotes(body.name) +
                           " has two values for the same dof";
                  values(dofs[i]) = *value;
                  filled[k]       = true;
                }
              ++value;
            }
        return value == record.values.end() ? "" : other_degrees();
      }

      std::string
      other_degrees() const
      {
        return "body " + in_quotes(body.name) +
               " has its degrees in other cells than now";
      }

      const Body         &body;
      const FieldKind     kind;
      const CellsByNumber cells;
      BodyVector         &values;
      const IndexSet      owned;
      std::vector<bool>   filled; ///< by owned dof
    };

    /// Returns in words what does not fit the scene.
    std::string
    read_cells(const CheckpointFile      &file,
               const FieldKind           &kind,
               const std::uint64_t        block,
               const Bodies              &bodies,
               std::vector<BodySolution> &solutions)
    {
      std::map<unsigned int, Field> fields; // by body
      for (const auto &body : bodies)
        if (!kind.is_pressure || body->pressure)
          fields.try_emplace(body->index, *body, kind, solutions[body->index]);
      std::string problem =
        read_records(file, kind.section, block, [&](const Record &record) {
          const auto field = fields.find(record.part);
          return field == fields.end() ? std::string(unknown_record) :
                                         field->second.put(record);
        });
      for (auto &[b, field] : fields)
        if (problem.empty() && !all(field.filled))
          problem = "body " + in_quotes(field.body.name) +
                    " has no values for some of the dofs that it has now";
      return problem;
    }

    /// Likewise.
    std::string
    read_faces(const CheckpointFile                          &file,
               const std::uint64_t                            block,
               const std::vector<Coupling>                   &couplings,
               std::vector<std::vector<std::vector<double>>> &multipliers)
    {
      using Face = std::pair<CellNumber, unsigned int>;
      std::vector<std::map<Face, unsigned int>> faces;
      std::vector<std::vector<bool>>            filled;
      for (const Coupling &coupling : couplings)
        {
          const BodySurface &slave = coupling.interface->slave();
          multipliers.emplace_back(slave.faces.size());
          filled.emplace_back(slave.faces.size(), false);
          faces.emplace_back();
          for (unsigned int s = 0; s < slave.faces.size(); ++s)
            faces.back()[{slave.cells[s]->id().to_binary<dim>(),
                          slave.face_numbers[s]}] = s;
        }
      const auto name = [&](const unsigned int i) {
        return "interface " + in_quotes(couplings[i].interface->name());
      };
      std::string problem =
        read_records(file, of_faces, block, [&](const Record &record) {
          const unsigned int i = record.part;
          if (i >= faces.size())
            return std::string(unknown_record);
          const auto found = faces[i].find({record.cell, record.face});
          if (found == faces[i].end())
            return std::string();
          const unsigned int s     = found->second;
          const FaceTrace   &trace = couplings[i].interface->slave().traces[s];
          if (record.values.size() != dim * trace.n_functions())
            return name(i) + " has other degrees on its slave faces than now";
          if (filled[i][s])
            return name(i) + " has two records of the same slave face";
          multipliers[i][s] = record.values;
          filled[i][s]      = true;
          return std::string();
        });
      for (unsigned int i = 0; i < faces.size(); ++i)
        if (problem.empty() && !all(filled[i]))
          problem =
            name(i) +
            " has no values for some of the slave faces that it has now";
      return problem;
    }
  } // namespace

  void
  write_checkpoint(const std::string           &directory,
                   Sections                     sections,
                   const SceneValues           &values,
                   const Bodies                &bodies,
                   const std::vector<Coupling> &couplings,
                   const MPI_Comm               comm)
  {
    AssertDimension(values.solutions.size(), bodies.size());
    AssertDimension(values.multipliers.size(), couplings.size());
    sections[of_scene] = to_bytes(describe_scene(bodies, couplings, comm));
    Sections records;
    for (const FieldKind &kind : field_kinds)
      for (const auto &body : bodies)
        if (std::string &bytes = records[kind.section];
            !kind.is_pressure || body->pressure)
          append_cells(*body, values.solutions[body->index], kind, bytes);
    for (const BodySolution &increment : values.increments)
      append_cells(*bodies[&increment - values.increments.data()],
                   increment,
                   of_increments,
                   records[of_increments.section]);
    for (const auto &body : bodies)
      if (remembers(*body))
        append_histories(*body,
                         values.solutions[body->index],
                         records[histories_section]);
    std::string &of_multipliers = records[of_faces];
    for (unsigned int i = 0; i < couplings.size(); ++i)
      {
        const BodySurface &slave = couplings[i].interface->slave();
        for (unsigned int s = 0; s < slave.faces.size(); ++s)
          of_multipliers +=
            to_bytes(to_bytes(Record{i,
                                     slave.face_numbers[s],
                                     slave.cells[s]->id().to_binary<dim>(),
                                     {},
                                     values.multipliers[i][s]}));
      }
    write_checkpoint_file(checkpoint_file_name(directory),
                          sections,
                          records,
                          comm);
  }

  SceneValues
  read_scene(const CheckpointFile        &file,
             const Bodies                &bodies,
             const std::vector<Coupling> &couplings,
             const MPI_Comm               comm,
             const std::uint64_t          block)
  {
    const auto fail_if = [&](const std::string &how) {
      throw_if_any(
        how.empty() ?
          "" :
          "The checkpoint " + file.name() + " is of another scene: " + how +
            "; allowed: the bodies, meshes, degrees and interfaces with which "
            "it was written",
        comm);
    };
    const auto then = file.get<SceneDescription>(of_scene);
    try
      {
        check(then);
      }
    catch (const std::out_of_range &error)
      {
        throw file.damaged(error.what());
      }
    std::string how;
    for (const std::string &one :
         differences(then, describe_scene(bodies, couplings, comm)))
      how += (how.empty() ? "" : "; ") + one;
    fail_if(how);

    SceneValues result;
    result.solutions.resize(bodies.size());
    for (const FieldKind &kind : field_kinds)
      fail_if(read_cells(file, kind, block, bodies, result.solutions));
    if (file.has(of_increments.section))
      {
        result.increments.resize(bodies.size());
        fail_if(
          read_cells(file, of_increments, block, bodies, result.increments));
      }
    fail_if(read_histories(file, block, bodies, result.solutions));
    fail_if(read_faces(file, block, couplings, result.multipliers));
    for (auto *solutions : {&result.solutions, &result.increments})
      for (BodySolution &solution : *solutions)
        for (BodyVector *values : {&solution.displacement, &solution.pressure})
          if (values->size() > 0)
            values->update_ghost_values();
    return result;
  }
} // namespace mortise
