#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/output/checkpoint_scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Between 0 and 1, as if random, by cell and vertex (the finalizer of
    /// splitmix64).
    double
    weight_of(const CellNumber &cell, const unsigned int vertex)
    {
      std::uint64_t hash = vertex;
      for (const std::uint64_t word : cell)
        {
          hash += word + 0x9e3779b97f4a7c15u;
          hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
          hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
          hash ^= hash >> 31;
        }
      return std::ldexp(static_cast<double>(hash >> 11), -53);
    }

    /// Calls @p take(cell number, place, point) for the vertices and the centre of each owned cell.
    template <typename Take>
    void
    for_each_point(const Body &body, const Take &take)
    {
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const CellNumber number = cell->id().template to_binary<dim>();
            for (const unsigned int v : cell->vertex_indices())
              take(number, v, cell->vertex(v));
            take(number,
                 cell->n_vertices(),
                 body.mapping->transform_unit_to_real_cell(
                   cell, cell->reference_cell().template barycenter<dim>()));
          }
    }

    /// See SceneDescription.
    std::array<double, 9>
    geometry_of(const Body &body, const MPI_Comm comm)
    {
      constexpr double huge = std::numeric_limits<double>::max();
      double           box[2 * dim]; // the larger ones with the sign changed
      std::fill(std::begin(box), std::end(box), huge);
      for_each_point(
        body, [&](const CellNumber &, unsigned int, const Point<dim> &point) {
          for (unsigned int d = 0; d < dim; ++d)
            {
              box[d]       = std::min(box[d], point[d]);
              box[dim + d] = std::min(box[dim + d], -point[d]);
            }
        });
      Utilities::MPI::min(box, comm, box);

      long double   sums[dim] = {}; // their rounding must not count
      std::uint64_t n_points  = 0;
      for_each_point(body,
                     [&](const CellNumber  &number,
                         const unsigned int place,
                         const Point<dim>  &point) {
                       const double weight = weight_of(number, place);
                       for (unsigned int d = 0; d < dim; ++d)
                         sums[d] += weight * (point[d] - box[d]);
                       ++n_points;
                     });
      n_points = Utilities::MPI::sum(n_points, comm);
      std::array<double, 9> geometry;
      for (unsigned int d = 0; d < dim; ++d)
        {
          geometry[d]       = box[d];
          geometry[dim + d] = -box[dim + d];
          geometry[2 * dim + d] =
            Utilities::MPI::sum(static_cast<double>(sums[d]), comm) / n_points;
        }
      return geometry;
    }

    /// Index in @p bodies of the body whose faces @p surface has, on any rank; the number of
    /// bodies if there are no faces. Collective.
    unsigned int
    body_of(const BodySurface &surface,
            const Bodies      &bodies,
            const MPI_Comm     comm)
    {
      unsigned int index = bodies.size();
      if (!surface.cells.empty())
        for (const auto &body : bodies)
          if (&surface.cells.front()->get_dof_handler() == &body->dof_handler)
            index = body->index;
      return Utilities::MPI::min(index, comm);
    }

    std::string
    degree_words(const SceneDescription::OfBody &body)
    {
      return body.degree_min == body.degree_max ?
               "degree " + std::to_string(body.degree_min) :
               "degrees " + std::to_string(body.degree_min) + " to " +
                 std::to_string(body.degree_max);
    }

    /// The largest difference over the size of the body.
    double
    geometry_difference(const std::array<double, 9> &a,
                        const std::array<double, 9> &b)
    {
      double difference = 0., size = 0.;
      for (unsigned int i = 0; i < a.size(); ++i)
        difference = std::max(difference, std::fabs(a[i] - b[i]));
      for (unsigned int d = 0; d < dim; ++d)
        size = std::max(size, a[dim + d] - a[d]);
      return difference / size;
    }

    /// Of what differs, in the order of the reader's interest: what follows
    /// from it is not told.
    std::string
    body_difference(const SceneDescription::OfBody &then,
                    const SceneDescription::OfBody &now)
    {
      // on other numbers of ranks it differs by rounding, up to 1e-16
      constexpr double   allowed = 1e-11;
      std::ostringstream text;
      if (then.shape != now.shape)
        text << "consists of " << then.shape << ", now of " << now.shape;
      else if (then.cells != now.cells)
        text << "has " << then.cells << " cells, now " << now.cells;
      else if (then.degree_min != now.degree_min ||
               then.degree_max != now.degree_max)
        text << "has " << degree_words(then) << ", now " << degree_words(now);
      else if ((then.pressures > 0) != (now.pressures > 0))
        text << "has " << (then.pressures > 0 ? "pressures" : "no pressures")
             << ", now " << (now.pressures > 0 ? "it has" : "it has none");
      else if (then.dofs != now.dofs)
        text << "has " << then.dofs << " dofs of displacement, now "
             << now.dofs;
      else if (then.pressures != now.pressures)
        text << "has " << then.pressures << " dofs of pressure, now "
             << now.pressures;
      else if (const double difference =
                 geometry_difference(then.geometry, now.geometry);
               !(difference < allowed))
        text << "has another geometry or other numbers of cells than now (by "
             << difference << " of its size, allowed is " << allowed << ")";
      return text.str();
    }

    std::string
    interface_difference(const SceneDescription::OfInterface &then,
                         const SceneDescription::OfInterface &now)
    {
      if (then.slave != now.slave)
        return "has its slave on body " + in_quotes(then.slave) +
               ", now on body " + in_quotes(now.slave);
      if (then.faces != now.faces)
        return "has " + std::to_string(then.faces) + " slave faces, now " +
               std::to_string(now.faces);
      return "";
    }

    template <typename Part>
    std::string
    names_of(const std::vector<Part> &parts)
    {
      std::vector<std::string> names;
      for (const Part &part : parts)
        names.push_back(part.name);
      return join_names(names);
    }

    /// Differences of parts of one kind, @p plural.
    template <typename Part, typename Compare>
    void
    add_differences(const std::string        &plural,
                    const std::vector<Part>  &then,
                    const std::vector<Part>  &now,
                    const Compare            &compare,
                    std::vector<std::string> &result)
    {
      if (!std::equal(then.begin(),
                      then.end(),
                      now.begin(),
                      now.end(),
                      [](const Part &a, const Part &b) {
                        return a.name == b.name;
                      }))
        {
          result.push_back("it has the " + plural + " " + names_of(then) +
                           ", the scene has " + names_of(now));
          return;
        }
      const std::string kind = plural == "bodies" ? "body " : "interface ";
      for (unsigned int i = 0; i < then.size(); ++i)
        if (const std::string difference = compare(then[i], now[i]);
            !difference.empty())
          result.push_back(kind + in_quotes(then[i].name) + " " + difference);
    }
  } // namespace

  SceneDescription
  describe_scene(const Bodies                &bodies,
                 const std::vector<Coupling> &couplings,
                 const MPI_Comm               comm)
  {
    SceneDescription scene;
    for (const auto &body : bodies)
      {
        const Body::Statistics statistics = body->statistics();
        scene.bodies.push_back(
          {body->name,
           body->mesh.tetrahedra ? "tetrahedra" : "hexahedra",
           statistics.cells,
           statistics.degree_min,
           statistics.degree_max,
           body->dof_handler.n_dofs(),
           body->pressure ? body->pressure->dof_handler.n_dofs() : 0,
           geometry_of(*body, comm)});
      }
    for (const Coupling &coupling : couplings)
      {
        const BodySurface &slave = coupling.interface->slave();
        const unsigned int body  = body_of(slave, bodies, comm);
        scene.interfaces.push_back(
          {coupling.interface->name(),
           body < bodies.size() ? bodies[body]->name : "",
           Utilities::MPI::sum<std::uint64_t>(slave.faces.size(), comm)});
      }
    return scene;
  }

  void
  check(const SceneDescription &scene)
  {
    for (const auto &body : scene.bodies)
      {
        if (body.shape != "tetrahedra" && body.shape != "hexahedra")
          throw std::out_of_range("body " + in_quotes(body.name) +
                                  " consists of " + in_quotes(body.shape));
        for (const double x : body.geometry)
          if (!std::isfinite(x))
            throw std::out_of_range("body " + in_quotes(body.name) +
                                    " has no finite geometry");
      }
  }

  std::vector<std::string>
  differences(const SceneDescription &then, const SceneDescription &now)
  {
    std::vector<std::string> result;
    add_differences("bodies", then.bodies, now.bodies, body_difference, result);
    add_differences("interfaces",
                    then.interfaces,
                    now.interfaces,
                    interface_difference,
                    result);
    return result;
  }
} // namespace mortise
