#include <deal.II/base/mpi.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/problem/rigid_motions.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A translation a and a rotation w about the centre of a body, the latter
    /// times its size.
    using Motion = std::array<double, 6>;

    struct Extent
    {
      Point<dim> centre;
      double     size = 0.;
    };

    Extent
    extent(const Body &body)
    {
      std::vector<double> lower(dim, std::numeric_limits<double>::max()),
        upper(dim, -lower[0]);
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            for (unsigned int c = 0; c < dim; ++c)
              {
                lower[c] = std::min(lower[c], cell->vertex(v)[c]);
                upper[c] = std::max(upper[c], cell->vertex(v)[c]);
              }
      const MPI_Comm comm = body.triangulation().get_communicator();
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

    /// Component @p c of a + w x (position - centre), for position / weight.
    Motion
    row_of(const Extent         &where,
           const unsigned int    c,
           const Tensor<1, dim> &position,
           const double          weight = 1.)
    {
      const Tensor<1, dim> r =
        (position - weight * Tensor<1, dim>(where.centre)) / where.size;
      Motion row{};
      row[c]               = weight;
      row[3 + (c + 1) % 3] = r[(c + 2) % 3];
      row[3 + (c + 2) % 3] = -r[(c + 1) % 3];
      return row;
    }

    /// Weighted means of squares of rows, each on @p n_bodies bodies: what is
    /// prevented.
    class Support
    {
    public:
      explicit Support(const unsigned int n_bodies = 0)
        : size(6 * n_bodies)
        , sums(size * size + 1, 0.)
      {}

      void
      add(const std::vector<Motion> &row,
          const double               factor = 1.,
          const double               weight = 1.)
      {
        for (unsigned int i = 0; i < size; ++i)
          for (unsigned int j = 0; j < size; ++j)
            sums[size * i + j] +=
              factor * row[i / 6][i % 6] * row[j / 6][j % 6];
        sums.back() += factor * weight;
      }

      /// Over all ranks. Collective.
      void
      finish(const MPI_Comm comm)
      {
        Utilities::MPI::sum(sums, comm, sums);
        total = sums.back();
        for (double &sum : sums)
          sum /= total > 0. ? total : 1.;
      }

      double
      operator()(const unsigned int i, const unsigned int j) const
      {
        return sums[size * i + j];
      }

      double total = 0.; ///< weight of all ranks' rows, behind finish()

    private:
      unsigned int        size;
      std::vector<double> sums;
    };

    using Matrix = LAPACKFullMatrix<double>;

    /// Add the block of bodies @p a, @p b of @p support in the place of @p i, @p j.
    void
    add_block(Matrix            &matrix,
              const unsigned int i,
              const unsigned int j,
              const Support     &support,
              const unsigned int a,
              const unsigned int b)
    {
      for (unsigned int k = 0; k < 6; ++k)
        for (unsigned int l = 0; l < 6; ++l)
          matrix(6 * i + k, 6 * j + l) += support(6 * a + k, 6 * b + l);
    }

    /// A basis of the null space of a sum of squares; columns.
    std::vector<std::vector<double>>
    null_space(Matrix matrix)
    {
      const unsigned int     n = matrix.m();
      FullMatrix<double>     vectors(n, n);
      dealii::Vector<double> values(n);
      matrix.compute_eigenvalues_symmetric(-1., 1e300, 0., values, vectors);
      std::vector<std::vector<double>> result;
      for (unsigned int k = 0; k < n; ++k)
        if (!(values(k) > 1e-10 * values(n - 1)))
          {
            result.emplace_back(n);
            for (unsigned int i = 0; i < n; ++i)
              result.back()[i] = vectors(i, k);
          }
      return result;
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

    /// Of the slave, then of the master. Collective.
    Support
    support_of(const TieSupport &tie,
               const Extent     &slave,
               const Extent     &master,
               const MPI_Comm    comm)
    {
      Support support(2);
      for (const MultiplierMoment &m : tie.multipliers)
        {
          Motion minus = row_of(master, m.component, m.moment, m.weight);
          for (double &entry : minus)
            entry *= -1.;
          support.add({row_of(slave, m.component, m.moment, m.weight), minus});
        }
      support.finish(comm);
      return support;
    }

    /// Centre and radius of the places. Collective.
    Extent
    extent(const TieSupport &tie, const MPI_Comm comm)
    {
      double         area = 0., square = 0.;
      Tensor<1, dim> centre;
      for (const auto &[place, weight] : tie.places)
        {
          area += weight;
          centre += weight * Tensor<1, dim>(place);
        }
      area = Utilities::MPI::sum(area, comm);
      Extent result;
      result.centre = Point<dim>(Utilities::MPI::sum(centre, comm) / area);
      for (const auto &[place, weight] : tie.places)
        square += weight * place.distance_square(result.centre) / area;
      result.size = std::sqrt(Utilities::MPI::sum(square, comm));
      return result;
    }

    /// The smallest ratio of what multipliers and what all places resist is 1
    /// where multipliers are dense, .3 for two in a row, and nothing for a
    /// single constant. Collective.
    bool
    is_weak(const TieSupport &tie, const MPI_Comm comm)
    {
      constexpr double least_ratio = 0.02;
      const Extent     where       = extent(tie, comm);
      Support          ideal(1), real(1);
      for (const auto &[place, weight] : tie.places)
        for (unsigned int c = 0; c < dim; ++c)
          ideal.add({row_of(where, c, place)}, weight);
      for (const MultiplierMoment &m : tie.multipliers)
        real.add({row_of(where, m.component, m.moment, m.weight)},
                 1.,
                 m.weight * m.weight);
      ideal.finish(comm);
      real.finish(comm);
      Matrix all(6, 6);
      all = 0.;
      add_block(all, 0, 0, ideal, 0, 0);
      FullMatrix<double>     vectors(6, 6);
      dealii::Vector<double> values(6);
      all.compute_eigenvalues_symmetric(-1., 1e300, 0., values, vectors);
      Matrix ratio(6, 6);
      for (unsigned int a = 0; a < 6; ++a)
        for (unsigned int b = 0; b < 6; ++b)
          {
            double sum = 0.;
            for (unsigned int i = 0; i < 6; ++i)
              for (unsigned int j = 0; j < 6; ++j)
                sum += vectors(i, a) * real(i, j) * vectors(j, b);
            ratio(a, b) = sum / std::sqrt(std::max(values(a), 1e-12) *
                                          std::max(values(b), 1e-12));
          }
      ratio.compute_eigenvalues_symmetric(-1., 1e300, 0., values, vectors);
      return !(values(0) > least_ratio);
    }

    /// What holds the bodies.
    class Supports
    {
    public:
      Supports(const Bodies                                       &bodies,
               const std::vector<std::vector<DirichletCondition>> &dirichlet,
               const std::vector<TieSupport>                      &ties)
        : ties(ties)
        , held(bodies.size(), false)
      {
        const MPI_Comm comm =
          bodies.front()->triangulation().get_communicator();
        std::vector<Extent> where;
        for (const auto &body : bodies)
          {
            where.push_back(extent(*body));
            Support &support = of_body.emplace_back(1);
            for (const DirichletCondition &condition : dirichlet[body->index])
              for (const auto &[cell, f] :
                   boundary_faces(*body, condition.boundary))
                if (cell->is_locally_owned())
                  for (const unsigned int v : cell->face(f)->vertex_indices())
                    for (unsigned int c = 0; c < dim; ++c)
                      if (condition.fixed[c])
                        support.add(
                          {row_of(where.back(), c, cell->face(f)->vertex(v))});
            support.finish(comm);
          }
        for (const TieSupport &tie : ties)
          of_tie.push_back(
            support_of(tie, where[tie.slave], where[tie.master], comm));
        find_held();
        if (std::find(held.begin(), held.end(), false) != held.end())
          find_free();
      }

      /// Of body @p b: what moves.
      std::string
      free_motions(const unsigned int b) const
      {
        std::vector<Motion> motions;
        for (const auto &vector : free)
          if (place[b] >= 0)
            {
              motions.emplace_back();
              std::copy_n(vector.begin() + 6 * place[b],
                          6,
                          motions.back().begin());
            }
        return describe(motions);
      }

      /// The interfaces of body @p b, and how much they are.
      std::string
      ties_of(const unsigned int b) const
      {
        std::string text;
        for (unsigned int t = 0; t < ties.size(); ++t)
          if (ties[t].slave == b || ties[t].master == b)
            {
              char covered[32];
              std::snprintf(covered,
                            sizeof(covered),
                            "%.3g",
                            100. * ties[t].coverage);
              text +=
                (text.empty() ? " (tied by " : ", ") + ties[t].name + ": " +
                std::to_string(static_cast<long>(of_tie[t].total)) +
                " multipliers, " + covered + " % of the slave surface covered";
            }
        return text.empty() ? "" : text + ")";
      }

    private:
      /// Those that cannot move where their prescribed displacements and
      /// bodies that cannot move hold them.
      void
      find_held()
      {
        for (bool again = true; again;)
          {
            again = false;
            for (unsigned int b = 0; b < held.size(); ++b)
              {
                if (held[b])
                  continue;
                Matrix matrix(6, 6);
                matrix = 0.;
                add_block(matrix, 0, 0, of_body[b], 0, 0);
                for (unsigned int t = 0; t < ties.size(); ++t)
                  {
                    const unsigned int sides[] = {ties[t].slave,
                                                  ties[t].master};
                    for (unsigned int i = 0; i < 2; ++i)
                      if (sides[i] == b && held[sides[1 - i]])
                        add_block(matrix, 0, 0, of_tie[t], i, i);
                  }
                again = held[b] = null_space(matrix).empty();
                if (again)
                  break;
              }
          }
      }

      /// Motions of the other bodies that nothing prevents.
      void
      find_free()
      {
        place.assign(held.size(), -1);
        int n = 0;
        for (unsigned int b = 0; b < held.size(); ++b)
          if (!held[b])
            place[b] = n++;
        Matrix matrix(6 * n, 6 * n);
        matrix = 0.;
        for (unsigned int b = 0; b < held.size(); ++b)
          if (!held[b])
            add_block(matrix, place[b], place[b], of_body[b], 0, 0);
        for (unsigned int t = 0; t < ties.size(); ++t)
          {
            const int sides[] = {place[ties[t].slave], place[ties[t].master]};
            for (unsigned int i = 0; i < 2; ++i)
              for (unsigned int j = 0; j < 2; ++j)
                if (sides[i] >= 0 && sides[j] >= 0)
                  add_block(matrix, sides[i], sides[j], of_tie[t], i, j);
          }
        free = null_space(matrix);
      }

      const std::vector<TieSupport>   &ties;
      std::vector<Support>             of_body, of_tie;
      std::vector<bool>                held;
      std::vector<int>                 place; ///< by body, in vectors of free
      std::vector<std::vector<double>> free;
    };
  } // namespace

  std::vector<unsigned int>
  weak_ties(const Bodies &bodies, const std::vector<TieSupport> &ties)
  {
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    std::vector<unsigned int> weak;
    for (unsigned int t = 0; t < ties.size(); ++t)
      if (ties[t].slave != ties[t].master && is_weak(ties[t], comm))
        weak.push_back(t);
    std::sort(weak.begin(), weak.end(), [&](const auto a, const auto b) {
      return ties[a].name < ties[b].name;
    });
    return weak;
  }

  void
  check_rigid_motions(
    const Bodies                                       &bodies,
    const std::vector<std::vector<DirichletCondition>> &dirichlet,
    const std::vector<TieSupport>                      &ties)
  {
    const Supports supports(bodies, dirichlet, ties);
    // bodies that move alike in one phrase
    std::map<std::string, std::vector<unsigned int>> moving;
    for (const auto &body : bodies)
      if (const std::string motions = supports.free_motions(body->index);
          !motions.empty())
        moving[motions].push_back(body->index);
    std::string message;
    for (const auto &[motions, group] : moving)
      {
        message += (message.empty() ? "" : "; ") +
                   std::string(group.size() > 1 ? "the bodies " : "the body ");
        for (const unsigned int b : group)
          message += (b == group.front() ? "" : ", ") + bodies[b]->name +
                     supports.ties_of(b);
        message += " can move freely: " + motions;
      }
    if (!message.empty())
      throw InputError(
        "Boundary conditions and interfaces leave rigid motions free: " +
        message +
        ". Prescribe displacements (Boundary ... / Displacement) that prevent "
        "them, tie the body to one that is held, or exchange slave and master "
        "of an interface with few multipliers");
  }
} // namespace mortise
