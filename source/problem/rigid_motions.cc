#include <deal.II/base/mpi.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/problem/rigid_motions.h>

#include <cmath>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A translation a and a rotation w about the centre of a group, the latter
    /// times its size.
    using Motion = std::array<double, 6>;

    /// Bodies that are tied together, by the smallest index among them.
    std::vector<unsigned int>
    group_of_body(
      const unsigned int                                        n_bodies,
      const std::vector<std::pair<unsigned int, unsigned int>> &ties)
    {
      std::vector<unsigned int> group(n_bodies);
      std::iota(group.begin(), group.end(), 0);
      for (unsigned int sweep = 0; sweep < n_bodies; ++sweep)
        for (const auto &tie : ties)
          group[tie.first] = group[tie.second] =
            std::min(group[tie.first], group[tie.second]);
      return group;
    }

    struct Extent
    {
      Point<dim> centre;
      double     size = 0.;
    };

    Extent
    extent(const Bodies                    &bodies,
           const std::vector<unsigned int> &group,
           const unsigned int               g)
    {
      std::vector<double> lower(dim, std::numeric_limits<double>::max()),
        upper(dim, -lower[0]);
      for (const auto &body : bodies)
        if (group[body->index] == g)
          for (const auto &cell : body->dof_handler.active_cell_iterators())
            if (cell->is_locally_owned())
              for (const unsigned int v : cell->vertex_indices())
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    lower[c] = std::min(lower[c], cell->vertex(v)[c]);
                    upper[c] = std::max(upper[c], cell->vertex(v)[c]);
                  }
      const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
      Extent         result;
      for (unsigned int c = 0; c < dim; ++c)
        {
          const double low = Utilities::MPI::min(lower[c], comm);
          const double up  = Utilities::MPI::max(upper[c], comm);
          result.centre[c] = (low + up) / 2.;
          result.size      = std::max(result.size, up - low);
        }
      return result;
    }

    /// Sum of the squares of the prescribed components of each rigid motion: 6
    /// x 6.
    LAPACKFullMatrix<double>
    support_matrix(
      const Bodies                                       &bodies,
      const std::vector<std::vector<DirichletCondition>> &dirichlet,
      const std::vector<unsigned int>                    &group,
      const unsigned int                                  g,
      const Extent                                       &where)
    {
      std::vector<double> sums(36, 0.);
      const auto add = [&](const unsigned int c, const Tensor<1, dim> &r) {
        Motion row{}; // component c of a + w x r
        row[c]               = 1.;
        row[3 + (c + 1) % 3] = r[(c + 2) % 3];
        row[3 + (c + 2) % 3] = -r[(c + 1) % 3];
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
            sums[6 * i + j] += row[i] * row[j];
      };
      for (const auto &body : bodies)
        if (group[body->index] == g)
          for (const DirichletCondition &condition : dirichlet[body->index])
            for (const auto &[cell, f] :
                 boundary_faces(*body, condition.boundary))
              if (cell->is_locally_owned())
                for (const unsigned int v : cell->face(f)->vertex_indices())
                  for (unsigned int c = 0; c < dim; ++c)
                    if (condition.fixed[c])
                      add(c,
                          (cell->face(f)->vertex(v) - where.centre) /
                            where.size);
      Utilities::MPI::sum(sums,
                          bodies.front()->triangulation().get_communicator(),
                          sums);
      LAPACKFullMatrix<double> matrix(6, 6);
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          matrix(i, j) = sums[6 * i + j];
      return matrix;
    }

    std::string
    direction_name(const std::array<double, 3> &direction)
    {
      const double norm = std::hypot(direction[0], direction[1], direction[2]);
      std::string  text;
      for (unsigned int c = 0; c < dim; ++c)
        {
          if (std::fabs(direction[c]) > 0.999 * norm)
            return std::string(1, "xyz"[c]);
          char number[32];
          std::snprintf(number,
                        sizeof(number),
                        "%s%.3g",
                        c ? ", " : "",
                        direction[c] / norm + 0.);
          text += number;
        }
      return "(" + text + ")";
    }

    /// The free motions as words; the basis of the null space is brought to
    /// echelon form, pure translations first, so that the axes come out where
    /// they can.
    std::string
    describe(std::vector<Motion> motions)
    {
      // reduce from the last column (rotations) so that translations are left
      // without rotation
      std::vector<Motion> reduced;
      for (int column = 5; column >= 0 && !motions.empty(); --column)
        {
          std::size_t pivot = 0;
          for (std::size_t m = 1; m < motions.size(); ++m)
            if (std::fabs(motions[m][column]) >
                std::fabs(motions[pivot][column]))
              pivot = m;
          if (std::fabs(motions[pivot][column]) < 1e-6)
            continue;
          Motion row = motions[pivot];
          motions.erase(motions.begin() + pivot);
          const double scale = row[column];
          for (double &entry : row)
            entry /= scale;
          const auto eliminate = [&](std::vector<Motion> &others) {
            for (Motion &other : others)
              {
                const double factor = other[column];
                for (unsigned int i = 0; i < 6; ++i)
                  other[i] -= factor * row[i];
              }
          };
          eliminate(motions);
          eliminate(reduced);
          reduced.push_back(row);
        }
      std::string text;
      for (auto motion = reduced.rbegin(); motion != reduced.rend(); ++motion)
        {
          const auto &m        = *motion;
          const bool  rotation = std::hypot(m[3], m[4], m[5]) > 1e-6;
          text +=
            (text.empty() ? "" : ", ") +
            std::string(rotation ? "rotation about " : "translation along ") +
            direction_name(rotation ?
                             std::array<double, 3>{{m[3], m[4], m[5]}} :
                             std::array<double, 3>{{m[0], m[1], m[2]}});
        }
      return text;
    }
  } // namespace

  void
  check_rigid_motions(
    const Bodies                                             &bodies,
    const std::vector<std::vector<DirichletCondition>>       &dirichlet,
    const std::vector<std::pair<unsigned int, unsigned int>> &ties)
  {
    const auto  group = group_of_body(bodies.size(), ties);
    std::string message;
    for (unsigned int g = 0; g < bodies.size(); ++g)
      if (group[g] == g)
        {
          const Extent where = extent(bodies, group, g);
          auto matrix = support_matrix(bodies, dirichlet, group, g, where);
          FullMatrix<double>     vectors(6, 6);
          dealii::Vector<double> values(6);
          matrix.compute_eigenvalues_symmetric(-1., 1e300, 0., values, vectors);

          std::vector<Motion> free;
          const double        largest = values(5);
          for (unsigned int k = 0; k < 6; ++k)
            if (!(values(k) > 1e-10 * largest))
              {
                Motion motion;
                for (unsigned int i = 0; i < 6; ++i)
                  motion[i] = vectors(i, k);
                free.push_back(motion);
              }
          if (free.empty())
            continue;
          std::vector<std::string> names;
          for (const auto &body : bodies)
            if (group[body->index] == g)
              names.push_back(body->name);
          message +=
            (message.empty() ? "" : "; ") +
            std::string(names.size() > 1 ? "the tied bodies " : "the body ") +
            join_names(names) + " can move freely: " + describe(free);
        }
    if (!message.empty())
      throw InputError(
        "Boundary conditions leave rigid motions free: " + message +
        ". Prescribe displacements (Boundary ... / Displacement) that prevent "
        "them, or tie the body to one that is held");
  }
} // namespace mortise
