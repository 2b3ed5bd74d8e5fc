#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <mortise/body/pieces.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Label = types::global_cell_index;

    constexpr Label no_label = std::numeric_limits<Label>::max();

    /// Connected groups of the vertices of owned and ghost cells on this rank.
    class LocalGroups
    {
    public:
      explicit LocalGroups(const Body &body)
        : parents(body.triangulation().n_vertices())
      {
        std::iota(parents.begin(), parents.end(), 0);
        for (const auto &cell : body.dof_handler.active_cell_iterators())
          if (!cell->is_artificial())
            for (const unsigned int v : cell->vertex_indices())
              parents[root(cell->vertex_index(v))] =
                root(cell->vertex_index(0));
      }

      unsigned int
      root(unsigned int vertex)
      {
        while (parents[vertex] != vertex)
          vertex = parents[vertex] = parents[parents[vertex]];
        return vertex;
      }

    private:
      std::vector<unsigned int> parents;
    };
  } // namespace

  Pieces
  find_pieces(const Body &body)
  {
    const MPI_Comm comm  = body.triangulation().get_communicator();
    const auto     cells = body.dof_handler.active_cell_iterators();
    LocalGroups    groups(body);
    // the least number of a cell of each piece passes on from rank to rank
    std::vector<Label> label(body.triangulation().n_active_cells(), no_label),
      of_group(body.triangulation().n_vertices(), no_label);
    for (const auto &cell : cells)
      if (!cell->is_artificial())
        label[cell->active_cell_index()] = cell->global_active_cell_index();
    for (bool changes = true; changes;)
      {
        changes = false;
        for (const auto &cell : cells)
          if (!cell->is_artificial())
            {
              Label &least = of_group[groups.root(cell->vertex_index(0))];
              least        = std::min(least, label[cell->active_cell_index()]);
            }
        for (const auto &cell : cells)
          if (!cell->is_artificial())
            {
              Label      &own   = label[cell->active_cell_index()];
              const Label least = of_group[groups.root(cell->vertex_index(0))];
              changes           = changes || own != least;
              own               = least;
            }
        changes = Utilities::MPI::max(changes ? 1 : 0, comm) == 1;
        if (changes && Utilities::MPI::n_mpi_processes(comm) > 1)
          GridTools::exchange_cell_data_to_ghosts<Label, DoFHandler<dim>>(
            body.dof_handler,
            [&](const auto &cell) { return label[cell->active_cell_index()]; },
            [&](const auto &cell, const Label received) {
              label[cell->active_cell_index()] = received;
            });
      }

    std::map<Label, unsigned int> numbers;
    for (const auto &cell : cells)
      if (cell->is_locally_owned())
        numbers.emplace(label[cell->active_cell_index()], 0);
    std::vector<Label> mine;
    for (const auto &[own, number] : numbers)
      mine.push_back(own);
    numbers.clear();
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, mine))
      for (const Label own : of_rank)
        numbers.emplace(own, 0);
    Pieces result;
    result.n = 0;
    for (auto &[own, number] : numbers)
      number = result.n++;
    result.of_cell.resize(label.size(), 0);
    for (const auto &cell : cells)
      if (!cell->is_artificial())
        result.of_cell[cell->active_cell_index()] =
          numbers.at(label[cell->active_cell_index()]);
    return result;
  }
} // namespace mortise
