// See checkpoint_records.h.
#include <mortise/base/quotes.h>
#include <mortise/material/nonlinear_law.h>

#include "checkpoint_records.h"

namespace mortise
{
  bool
  remembers(const Body &body)
  {
    const auto &law = body.material.nonlinear();
    return law && law->n_history() > 0;
  }

  void
  append_histories(const Body         &body,
                   const BodySolution &solution,
                   std::string        &records)
  {
    for (const auto &[number, cell] : cells_by_number(body))
      if (cell->is_locally_owned())
        records += to_bytes(
          to_bytes(Record{body.index,
                          0,
                          number,
                          {},
                          solution.history[cell->active_cell_index()]}));
  }

  std::string
  read_histories(const CheckpointFile      &file,
                 const std::uint64_t        block,
                 const Bodies              &bodies,
                 std::vector<BodySolution> &solutions)
  {
    std::map<unsigned int, CellsByNumber> cells; // by body
    for (const auto &body : bodies)
      if (remembers(*body))
        {
          cells[body->index] = cells_by_number(*body);
          solutions[body->index].history.resize(
            body->triangulation().n_active_cells());
        }
    if (cells.empty())
      return "";
    std::string problem =
      read_records(file, histories_section, block, [&](const Record &record) {
        const auto of_body = cells.find(record.part);
        if (of_body == cells.end())
          return std::string(unknown_record);
        const auto  found = of_body->second.find(record.cell);
        const auto &body  = *bodies[record.part];
        if (found == of_body->second.end())
          return std::string();
        const auto &cell = found->second;
        if (record.values.size() !=
            body.material.nonlinear()->n_history() *
              points_of_forces(body, cell->active_fe_index()).size())
          return "body " + in_quotes(body.name) +
                 " remembers other numbers than now";
        solutions[record.part].history[cell->active_cell_index()] =
          record.values;
        return std::string();
      });
    for (const auto &[b, of_body] : cells)
      for (const auto &[number, cell] : of_body)
        if (problem.empty() && cell->is_locally_owned() &&
            solutions[b].history[cell->active_cell_index()].empty())
          problem = "body " + in_quotes(bodies[b]->name) +
                    " has no histories for some of its cells";
    return problem;
  }
} // namespace mortise
