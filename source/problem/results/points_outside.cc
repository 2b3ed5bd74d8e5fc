#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/output/functionals.h>
#include <mortise/problem/results/points_outside.h>

#include <limits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::string
    text_of(const Point<dim> &x)
    {
      return "(" + RunLog::number(x[0]) + ", " + RunLog::number(x[1]) + ", " +
             RunLog::number(x[2]) + ")";
    }

    /// The vertex of @p body that is nearest to @p point. Collective.
    Point<dim>
    nearest_vertex(const Body &body, const Point<dim> &point)
    {
      Point<dim> nearest;
      double     distance = std::numeric_limits<double>::max();
      for (const auto &cell : body.triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            if (const double d = cell->vertex(v).distance(point); d < distance)
              {
                nearest  = cell->vertex(v);
                distance = d;
              }
      for (const auto &[d, vertex] :
           Utilities::MPI::all_gather(body.triangulation().get_communicator(),
                                      std::make_pair(distance, nearest)))
        if (d < distance)
          {
            nearest  = vertex;
            distance = d;
          }
      return nearest;
    }

    /// "(2, 0, 0), lies outside of body ..."; empty if it does not. Collective.
    std::string
    why_outside(const Body &body, const Point<dim> &point)
    {
      if (contains(body, point))
        return {};
      const Point<dim> nearest = nearest_vertex(body, point);
      return text_of(point) + ", lies outside of body " + in_quotes(body.name) +
             ", whose nearest vertex " + text_of(nearest) + " is " +
             RunLog::number(nearest.distance(point)) + " away";
    }
  } // namespace

  void
  check_points(const RunContext &run, const Bodies &bodies)
  {
    const Parameters  &parameters = run.parameters;
    const std::string &quantity   = parameters.adaptivity.quantity;
    const std::string  asked =
      Utilities::trim(quantity.substr(0, quantity.rfind(',')));
    for (const PointQuantity &point : parameters.output.points)
      {
        const std::string why = why_outside(*bodies[point.body], point.point);
        if (why.empty())
          continue;
        if (!quantity.empty() && point.name == asked)
          parameters.fail("Adaptivity/Quantity",
                          in_quotes(quantity) + ", whose point, " + why,
                          "a point of Output/Points in its body");
        run.log.warning(parameters.where("Output/Points") + ": the point of " +
                        in_quotes(point.name) + ", " + why +
                        "; it has no displacement");
      }
  }
} // namespace mortise
