#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <mortise/adapt/remeshing.h>
#include <mortise/base/of_all_ranks.h>
#include <mortise/body/elements/simplex_quadrature.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of squares of changes from degree to degree, which meshes that are small
    /// towards a corner do not undercut.
    constexpr double ratio_beside_corner = 0.15;

    /// Of the error around a vertex with most of it, that another one of the
    /// same cells has if a solution is not smooth there, too: beside a corner a
    /// fifth.
    constexpr double least_part_of_vertex = 0.5;

    /// The same relative to the vertex with the largest error; other vertices
    /// follow in later cycles.
    constexpr double least_part_of_all = 0.3;

    /// The mean length of the edges.
    double
    size_of(const Triangulation<dim>::active_cell_iterator &cell)
    {
      double sum = 0.;
      for (const unsigned int l : cell->line_indices())
        sum += cell->line(l)->diameter();
      return sum / cell->n_lines();
    }

    using Cell = Triangulation<dim>::active_cell_iterator;

    /// Call @p visit(vertex, value) for the vertices of all cells, also of ghosts, with what @p own has of the cell. Collective.
    template <typename Own, typename Visit>
    void
    visit_vertices(const Triangulation<dim> &triangulation,
                   const Own                &own,
                   const Visit              &visit)
    {
      const auto of_cell = [&](const Cell &cell, const double value) {
        for (const unsigned int v : cell->vertex_indices())
          visit(cell->vertex_index(v), value);
      };
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          of_cell(cell, own(cell));
      GridTools::exchange_cell_data_to_ghosts<double, Triangulation<dim>>(
        triangulation, own, of_cell);
    }

    /// By vertex of owned cells, the geometric mean of the sizes of the cells
    /// around it.
    std::vector<double>
    sizes_at_vertices(const Triangulation<dim> &triangulation)
    {
      std::vector<double>       result(triangulation.n_vertices(), 0.);
      std::vector<unsigned int> number(result.size(), 0);
      visit_vertices(
        triangulation,
        [](const Cell &cell) { return std::log(size_of(cell)); },
        [&](const unsigned int v, const double value) {
          result[v] += value;
          ++number[v];
        });
      for (unsigned int v = 0; v < result.size(); ++v)
        result[v] = std::exp(result[v] / std::max(1u, number[v]));
      return result;
    }

    /// By vertex of owned cells: what is to be left of its size, so that each of those cells around it that are @p split
    /// gets the square @p target of the error: powers of one half down to 2^-@p most. One at vertices that have far less of the error
    /// around them than others of the same cells: what is not smooth is there.
    std::vector<double>
    factors_at_vertices(const Triangulation<dim>  &triangulation,
                        const std::vector<double> &split,
                        const double               target,
                        const unsigned int         most)
    {
      std::vector<double> sum(triangulation.n_vertices(), 0.), largest(sum);
      std::vector<unsigned int> number(sum.size(), 0);
      visit_vertices(
        triangulation,
        [&](const Cell &cell) { return split[cell->active_cell_index()]; },
        [&](const unsigned int v, const double error) {
          sum[v] += error;
          number[v] += error > 0. ? 1 : 0;
        });
      visit_vertices(
        triangulation,
        [&](const Cell &cell) {
          double result = 0.;
          for (const unsigned int v : cell->vertex_indices())
            result = std::max(result, sum[cell->vertex_index(v)]);
          return result;
        },
        [&](const unsigned int v, const double error) {
          largest[v] = std::max(largest[v], error);
        });
      const double most_of_all =
        Utilities::MPI::max(*std::max_element(sum.begin(), sum.end()),
                            triangulation.get_communicator());
      std::vector<double> result(sum.size(), 1.);
      for (unsigned int v = 0; v < result.size(); ++v)
        if (number[v] > 0 && sum[v] >= least_part_of_vertex * largest[v] &&
            sum[v] >= least_part_of_all * most_of_all)
          {
            // beside an edge, where u is as r^(1/2), a cell has as much of the
            // square of the error as the square of its size
            const double halvings =
              std::ceil(0.5 * std::log2(sum[v] / number[v] / target));
            result[v] =
              std::pow(0.5, std::min<double>(most, std::max(1., halvings)));
          }
      return result;
    }

    /// The integral of size^-3 over a cell of volume one, where it is linear.
    double
    cells_per_volume(const std::array<double, 4> &sizes)
    {
      static const Quadrature<dim> rule = simplex_quadrature<dim>(8);
      double                       sum  = 0.;
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Point<dim> &x    = rule.point(q);
          const double      size = (1. - x[0] - x[1] - x[2]) * sizes[0] +
                              x[0] * sizes[1] + x[1] * sizes[2] +
                              x[2] * sizes[3];
          sum += rule.weight(q) / std::pow(size, 3);
        }
      return 6. * sum;
    }

    /// Of a vertex, which ranks compute from other numberings, so that all have
    /// the same to the last digit.
    double
    rounded(const double size)
    {
      return static_cast<float>(size);
    }

    /// Of a cell: vertices, sizes at them, degree.
    using Row = std::array<double, 17>;

    Remeshing
    remeshing_of(const std::vector<Row> &rows)
    {
      Remeshing                    result;
      std::vector<SizeField::Cell> cells;
      for (const Row &row : rows)
        {
          SizeField::Cell cell;
          for (unsigned int v = 0; v < 4; ++v)
            {
              cell.vertices[v] =
                Point<dim>(row[3 * v], row[3 * v + 1], row[3 * v + 2]);
              cell.sizes[v] = row[12 + v];
            }
          cells.push_back(cell);
          result.degrees.push_back(row[16]);
        }
      result.sizes = std::make_shared<SizeField>(std::move(cells));
      return result;
    }
  } // namespace

  Remeshing
  plan_remeshing(const Body                    &body,
                 const std::vector<Refinement> &refinements,
                 const std::vector<CellState>  &states,
                 const RemeshingOptions        &options)
  {
    const auto         &triangulation = body.triangulation();
    std::vector<double> split(states.size(), 0.);
    for (unsigned int k = 0; k < states.size(); ++k)
      if (refinements[k] == Refinement::split)
        split[k] = certain_error(states[k].history);
    const auto       sizes   = sizes_at_vertices(triangulation);
    const auto       factors = factors_at_vertices(triangulation,
                                             split,
                                             options.target,
                                             options.most_halvings);
    std::vector<Row> own;
    double           number[2] = {0., 0.};
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          Row                   row;
          std::array<double, 4> before, after;
          for (const unsigned int v : cell->vertex_indices())
            {
              const Point<dim> x = options.motion.inverse(cell->vertex(v));
              std::copy(x.begin_raw(), x.end_raw(), &row[3 * v]);
              const unsigned int i = cell->vertex_index(v);
              before[v]            = sizes[i];
              after[v]             = sizes[i] * factors[i];
              row[12 + v] = rounded(after[v] * std::pow(2., options.n_cuts));
            }
          // a high degree is of no use where a solution is not smooth
          const unsigned int k = cell->active_cell_index();
          row[16]              = split[k] > 0. ?
                                   options.least_degree :
                                   std::max(options.least_degree + 2, states[k].degree) - 2;
          own.push_back(row);
          number[0] += cell->measure() * cells_per_volume(before);
          number[1] += cell->measure() * cells_per_volume(after);
        }
    const MPI_Comm   comm = triangulation.get_communicator();
    std::vector<Row> all  = of_all_ranks(own, comm);
    std::sort(all.begin(), all.end()); // the same whatever the ranks
    Remeshing result = remeshing_of(all);
    Utilities::MPI::sum(number, comm, number);
    result.growth = number[1] / number[0];
    return result;
  }

  std::vector<CellState>
  states_after(const Body        &body,
               const Remeshing   &remeshing,
               const RigidMotion &motion)
  {
    std::vector<CellState> result(body.triangulation().n_active_cells());
    for (const auto &cell : body.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          CellHistory &history = result[cell->active_cell_index()].history;
          history.least_ratio  = ratio_beside_corner;
          history.degree       = remeshing.degrees[remeshing.sizes->cell_at(
            motion.inverse(cell->center()))];
        }
    return result;
  }
} // namespace mortise
