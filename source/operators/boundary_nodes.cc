#include <mortise/body/boundary_faces.h>
#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/operators/boundary_nodes.h>
#include <mortise/operators/cells/cell_order.h>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  LevelVector<double>
  boundary_nodes(const MultigridLevel    &level,
                 const Body              &body,
                 const types::boundary_id boundary)
  {
    LevelVector<double> result;
    result.reinit(level.layout);
    for (const auto &[cell, f] : boundary_faces(body, boundary))
      if (cell->is_locally_owned())
        for (const auto node : level.space->face_nodes(body, cell, f).nodes)
          for (unsigned int c = 0; c < dim; ++c)
            result.local_element(
              level.layout->global_to_local(dim * node + c)) = 1.;
    result.compress(VectorOperation::max);
    return result;
  }

  namespace
  {
    /// In the unit cell, by index of CellOrder::values.
    std::vector<Point<dim>>
    unit_nodes(const FiniteElement<dim> &element)
    {
      const unsigned int      p = element.degree;
      std::vector<Point<dim>> result;
      if (element.reference_cell() == ReferenceCells::Tetrahedron)
        {
          const VertexOrder &order = SimplexElements::base(element).order;
          for (const Point<dim> &node : simplex_nodes(p))
            {
              const auto by_rank = barycentric_coordinates(node);
              result.emplace_back();
              for (unsigned int k = 0; k < order.size(); ++k)
                if (order[k] > 0)
                  result.back()[order[k] - 1] = by_rank[k];
            }
          return result;
        }
      // the second function of a line is the coordinate along it
      const FullMatrix<double> &line = modes_to_nodes(p);
      for (unsigned int k = 0; k <= p; ++k)
        for (unsigned int j = 0; j <= p; ++j)
          for (unsigned int i = 0; i <= p; ++i)
            result.emplace_back(line(i, 1), line(j, 1), line(k, 1));
      return result;
    }
  } // namespace

  LevelVector<double>
  node_positions(const MultigridLevel      &level,
                 const Body                &body,
                 const LevelVector<double> &wanted)
  {
    struct Nodes
    {
      std::vector<unsigned int> numbers; ///< in get_nodes()
      std::vector<Point<dim>>   units;
    };
    LevelVector<double> result;
    result.reinit(level.layout);
    std::map<unsigned int, Nodes>  by_element;
    std::vector<NodalSpace::Index> nodes;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          level.space->get_nodes(body.index, cell, nodes);
          const auto is_wanted = [&](const NodalSpace::Index node) {
            return level.layout->in_local_range(dim * node) &&
                   wanted.local_element(
                     level.layout->global_to_local(dim * node)) != 0.;
          };
          if (std::none_of(nodes.begin(), nodes.end(), is_wanted))
            continue;
          Nodes &of = by_element[cell->active_fe_index()];
          if (of.units.empty())
            of = {CellOrder(cell->get_fe()).scalar,
                  unit_nodes(cell->get_fe().base_element(0))};
          for (unsigned int i = 0; i < of.units.size(); ++i)
            if (const auto node = nodes[of.numbers[i]]; is_wanted(node))
              {
                const Point<dim> x =
                  body.mapping->transform_unit_to_real_cell(cell, of.units[i]);
                for (unsigned int c = 0; c < dim; ++c)
                  result.local_element(
                    level.layout->global_to_local(dim * node + c)) = x[c];
              }
        }
    return result;
  }
} // namespace mortise
