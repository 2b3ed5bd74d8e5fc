// The rigid parts of a scene at one time: a member of SceneData.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/expression.h>
#include <mortise/base/quotes.h>
#include <mortise/base/run_log.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/operators/boundary_area.h>
#include <mortise/problem/scene/scene_data.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What is prescribed of a motion, by least squares.
    class MotionEquations
    {
    public:
      void
      add(const Motion &row, const double value)
      {
        for (unsigned int i = 0; i < 6; ++i)
          {
            for (unsigned int j = 0; j < 6; ++j)
              sums[6 * i + j] += row[i] * row[j];
            sums[36 + i] += row[i] * value;
          }
        sums[42] += value * value;
        sums[43] += 1.;
      }

      /// Set the free and the given motion of @p part. The result is by how
      /// much, a length, displacements differ from it in the mean. Collective.
      double
      solve(const MPI_Comm comm, RigidPart &part)
      {
        constexpr double zero = 1e-10; // of squares
        Utilities::MPI::sum(sums, comm, sums);
        RigidMatrix matrix(6, 6);
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
            matrix(i, j) = sums[6 * i + j];
        const Spectrum all  = spectrum(matrix);
        double         rest = sums[42];
        for (unsigned int k = 0; k < 6; ++k)
          {
            const std::vector<double> &vector = all.vectors[k];
            if (!(all.values[k] > zero * all.values[0]))
              {
                part.free.emplace_back();
                std::copy(vector.begin(),
                          vector.end(),
                          part.free.back().begin());
                continue;
              }
            const double along = std::inner_product(vector.begin(),
                                                    vector.end(),
                                                    sums.begin() + 36,
                                                    0.);
            rest -= along * along / all.values[k];
            for (unsigned int i = 0; i < 6; ++i)
              part.given[i] += along / all.values[k] * vector[i];
          }
        return std::sqrt(std::max(0., rest) / std::max(1., sums[43]));
      }

      /// Of what is prescribed, in the mean.
      double
      size() const
      {
        return std::sqrt(sums[42] / std::max(1., sums[43]));
      }

    private:
      std::vector<double> sums = std::vector<double>(44, 0.);
    };

    /// The vertices of the local faces of @p part.
    std::set<unsigned int>
    vertices_of(const Body &body, const RigidPart &part)
    {
      std::set<unsigned int> result;
      for (const auto &[cell, f] : boundary_faces(body, part.boundaries))
        for (unsigned int k = 0; k < cell->face(f)->n_vertices(); ++k)
          result.insert(cell->vertex_index(CellFace(cell, f).vertices[k]));
      return result;
    }

    /// The displacements that @p dirichlet prescribes at vertices of @p part.
    void
    add_displacements(const Body                            &body,
                      const std::vector<DirichletCondition> &dirichlet,
                      const RigidPart                       &part,
                      MotionEquations                       &equations)
    {
      const std::set<unsigned int> own = vertices_of(body, part);
      for (const DirichletCondition &condition : dirichlet)
        if (!condition.is_rigid)
          for (const auto &[cell, f] : faces_of(body, condition))
            if (cell->is_locally_owned())
              for (unsigned int k = 0; k < cell->face(f)->n_vertices(); ++k)
                {
                  const unsigned int v = CellFace(cell, f).vertices[k];
                  if (own.count(cell->vertex_index(v)) == 0 ||
                      !prescribes_vertex(condition, cell, v))
                    continue;
                  const Point<dim>     x = cell->vertex(v);
                  const Tensor<1, dim> u =
                    condition.value ? condition.value(x) : Tensor<1, dim>();
                  for (unsigned int c = 0; c < dim; ++c)
                    if (condition.fixed[c])
                      equations.add(row_of(part.where, c, x), u[c]);
                }
    }
  } // namespace

  std::vector<double>
  SceneData::given_components(const std::optional<Components> &texts,
                              const std::string               &path) const
  {
    std::vector<double> result;
    const std::string   where = parameters.where(path);
    for (unsigned int c = 0; c < dim; ++c)
      {
        const std::string text = texts ? (*texts)[c] : "-";
        result.push_back(
          text == "-" ?
            std::numeric_limits<double>::quiet_NaN() :
            checks(Expression(text, where, time).value(Point<dim>()),
                   Point<dim>(),
                   where + ": " + in_quotes(text)));
      }
    return result;
  }

  Tensor<1, dim>
  SceneData::total(const std::optional<Components> &texts,
                   const std::string               &path) const
  {
    Tensor<1, dim> result;
    if (texts)
      {
        const std::vector<double> given = given_components(texts, path);
        std::copy(given.begin(), given.end(), result.begin_raw());
      }
    return result;
  }

  std::vector<RigidPart>
  SceneData::rigid_parts_without_motions(const Body &body) const
  {
    const BodyParameters  &given = parameters.bodies[body.index];
    std::vector<RigidPart> result;
    const auto             add = [&](const std::string                     &name,
                         const std::vector<types::boundary_id> &boundaries) {
      result.push_back({name, body.index, boundaries, extent(body)});
      result.back().is_finite = have_finite_strain(parameters);
    };
    const bool is_whole = is_rigid(given.material);
    if (is_whole)
      add(given.name, all_boundaries(body));
    for (const auto &[name, boundary] : given.boundaries)
      if (boundary.is_rigid())
        {
          const std::string path = "Body " + given.name + "/Boundary " + name;
          const auto        id = body.boundary_id(name, parameters.where(path));
          if (!is_whole)
            add(given.name + ": " + name, {id});
          RigidPart       &part  = result.back();
          const Point<dim> point = reference_point(body, boundary, id);
          if (part.loads.empty())
            part.where.centre = point;
          part.loads.push_back(
            {name,
             point,
             factor * total(boundary.force, path + "/Force"),
             factor * total(boundary.moment, path + "/Moment")});
        }
    return result;
  }

  void
  SceneData::set_motion(const Body                            &body,
                        const std::vector<DirichletCondition> &dirichlet,
                        RigidPart                             &part) const
  {
    constexpr double      rounding = 1e-6;
    const BodyParameters &given    = parameters.bodies[body.index];
    const MPI_Comm        comm     = body.triangulation().get_communicator();
    const std::string     path     = "Body " + given.name;
    MotionEquations       equations;
    for (const RigidPart::PointLoad &at : part.loads)
      {
        const BoundaryParameters &boundary = given.boundaries.at(at.boundary);
        const std::string         where    = path + "/Boundary " + at.boundary;
        const auto displacement = given_components(boundary.displacement,
                                                   where + "/Displacement"),
                   rotation =
                     given_components(boundary.rotation, where + "/Rotation");
        if (Utilities::MPI::this_mpi_process(comm) != 0)
          continue;
        for (unsigned int c = 0; c < dim; ++c)
          {
            Motion turn{};
            turn[dim + c] = 1.;
            if (!std::isnan(displacement[c]))
              equations.add(row_of(part.where, c, at.point),
                            factor * displacement[c]);
            if (!std::isnan(rotation[c]))
              equations.add(turn,
                            factor * numbers::PI / 180. * rotation[c] *
                              part.where.size);
          }
      }
    add_displacements(body, dirichlet, part, equations);
    const double off = equations.solve(comm, part);
    if (off > rounding * equations.size())
      parameters.fail(is_rigid(given.material) ?
                        path + "/Material/Law" :
                        path + "/Boundary " + part.loads.front().boundary +
                          "/Coupling",
                      "rigid, but the displacements prescribed on " +
                        part.name + " differ by " + RunLog::number(off) +
                        " in the mean from the nearest rigid motion",
                      "displacements and rotations that are one rigid motion");
  }

  std::vector<RigidPart>
  SceneData::rigid_parts(const Bodies &bodies) const
  {
    std::vector<RigidPart> result;
    for (const auto &body : bodies)
      {
        std::vector<RigidPart> own = rigid_parts_without_motions(*body);
        if (own.empty())
          continue;
        const auto             conditions = dirichlet(*body);
        std::set<unsigned int> others;
        for (RigidPart &part : own)
          {
            const std::set<unsigned int> vertices = vertices_of(*body, part);
            const bool                   shared =
              std::any_of(vertices.begin(), vertices.end(), [&](const auto v) {
                return others.count(v) > 0;
              });
            throw_if_any(shared ?
                           "Body " + body->name +
                             ": boundaries with Coupling = rigid share "
                             "vertices (" +
                             part.name + "); allowed: one boundary for both" :
                           "",
                         body->triangulation().get_communicator());
            others.insert(vertices.begin(), vertices.end());
            set_motion(*body, conditions, part);
            result.push_back(std::move(part));
          }
      }
    return result;
  }
} // namespace mortise
