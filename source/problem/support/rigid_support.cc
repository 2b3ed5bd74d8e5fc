#include <deal.II/base/mpi.h>

#include <mortise/body/boundary_faces.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/problem/support/rigid_support.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  Extent
  extent(const Body &body, const PartOfBody &part)
  {
    std::vector<double> lower(dim, std::numeric_limits<double>::max()),
      upper(dim, -lower[0]);
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && part.has(cell))
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
         const double          weight)
  {
    const Tensor<1, dim> r =
      (position - weight * Tensor<1, dim>(where.centre)) / where.size;
    Motion row{};
    row[c]               = weight;
    row[3 + (c + 1) % 3] = r[(c + 2) % 3];
    row[3 + (c + 2) % 3] = -r[(c + 1) % 3];
    return row;
  }

  Motion
  row_of(const Extent &where, const MultiplierMoment &multiplier)
  {
    Motion sum{};
    for (unsigned int c = 0; c < dim; ++c)
      {
        const Motion row =
          row_of(where, c, multiplier.moment[c], multiplier.weight[c]);
        for (unsigned int i = 0; i < sum.size(); ++i)
          sum[i] += row[i];
      }
    return sum;
  }

  // Singular values: LAPACK's iteration for eigenvectors fails now and then
  // where many eigenvalues are equal.
  Spectrum
  spectrum(RigidMatrix matrix)
  {
    Spectrum result;
    if (matrix.m() == 0)
      return result;
    matrix.compute_svd();
    const RigidMatrix &columns = matrix.get_svd_u();
    for (unsigned int k = 0; k < matrix.m(); ++k)
      {
        result.values.push_back(matrix.singular_value(k));
        result.vectors.emplace_back(matrix.m());
        for (unsigned int i = 0; i < matrix.m(); ++i)
          result.vectors.back()[i] = columns(i, k);
      }
    return result;
  }

  RigidMatrix
  restricted(const RigidMatrix                      &matrix,
             const std::vector<std::vector<double>> &basis)
  {
    RigidMatrix result(basis.size(), basis.size());
    for (unsigned int a = 0; a < basis.size(); ++a)
      for (unsigned int b = 0; b < basis.size(); ++b)
        {
          double sum = 0.;
          for (unsigned int i = 0; i < matrix.m(); ++i)
            for (unsigned int j = 0; j < matrix.m(); ++j)
              sum += basis[a][i] * matrix(i, j) * basis[b][j];
          result(a, b) = sum;
        }
    return result;
  }

  namespace
  {
    /// What @p m does on a master that is moved by @p placement, as moments of
    /// its own displacements where it is.
    MultiplierMoment
    where_master_is(const RigidMotion &placement, const MultiplierMoment &m)
    {
      const auto back = transpose(placement.rotation);
      return {back * m.weight,
              back *
                (m.moment - outer_product(m.weight, placement.translation)) *
                placement.rotation};
    }

    /// Do the multipliers hold along one direction, as on a plane? Collective.
    bool
    is_plane(const TieSupport &tie, const MPI_Comm comm)
    {
      constexpr double    rounding = 1e-12; // a millionth of an angle, squared
      std::vector<double> squares(dim * dim, 0.);
      for (const MultiplierMoment &m : tie.multipliers)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            squares[dim * c + d] += m.weight[c] * m.weight[d];
      Utilities::MPI::sum(squares, comm, squares);
      RigidMatrix matrix(dim, dim);
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          matrix(c, d) = squares[dim * c + d];
      const auto values = spectrum(matrix).values;
      return values[1] <= rounding * values[0];
    }
  } // namespace

  TieResistance
  resistance_of(const TieSupport &tie,
                const Extent     &slave,
                const Extent     &master,
                const MPI_Comm    comm)
  {
    TieResistance result{Support(2),
                         Support(2),
                         tie.constrained == ConstrainedDirections::normal &&
                           !is_plane(tie, comm)};
    const auto    rows = [&](const MultiplierMoment &m) {
      Motion minus = row_of(master, where_master_is(tie.placement, m));
      for (double &entry : minus)
        entry *= -1.;
      return std::vector<Motion>{row_of(slave, m), minus};
    };
    const auto add = [&](const MultiplierMoment &m, Support &support) {
      support.add(rows(m), 1., m.weight.norm_square());
    };
    for (const MultiplierMoment &m : tie.multipliers)
      {
        add(m, result.along_directions);
        // what holds along a direction n, along all of them: by n_c, of which
        // the squares are one
        for (unsigned int c = 0; c < dim && result.curved; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            {
              MultiplierMoment turned;
              turned.weight[d] = m.weight[c];
              turned.moment[d] = m.moment[c];
              add(turned, result.along_all);
            }
      }
    // however little, it is not what facets of a curved surface hold
    constexpr double of_friction = 100.;
    for (const MultiplierMoment &m : tie.across_slip)
      result.along_directions.add(rows(m), of_friction, 0.);
    if (tie.released)
      {
        // rows as if they had an unknown more, the shortening, of which each
        // has what it feels of a translation along the normal
        MultiplierMoment sum;
        double           squares = 0.;
        for (const MultiplierMoment &m : tie.multipliers)
          {
            const double along = m.weight * *tie.released;
            squares += along * along;
            sum.weight += along * m.weight;
            sum.moment += along * m.moment;
          }
        squares    = Utilities::MPI::sum(squares, comm);
        sum.weight = Utilities::MPI::sum(sum.weight, comm);
        sum.moment = Utilities::MPI::sum(sum.moment, comm);
        if (squares > 0. && Utilities::MPI::this_mpi_process(comm) == 0)
          result.along_directions.add(rows(sum), -1. / squares, 0.);
      }
    result.along_directions.finish(comm);
    result.along_all.finish(comm);
    return result;
  }

  Resistance::Resistance(const unsigned int n_bodies)
  {
    for (RigidMatrix *matrix : {&constrained, &across, &moved})
      matrix->reinit(6 * n_bodies);
  }

  /// Add the block of bodies @p a, @p b of @p support in the place of @p i, @p j.
  void
  Resistance::add_block(RigidMatrix       &matrix,
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

  void
  Resistance::add(const unsigned int b, const Support &support)
  {
    add_block(constrained, b, b, support, 0, 0);
  }

  void
  Resistance::add(const int slave, const int master, const TieResistance &tie)
  {
    const int sides[] = {slave, master};
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        if (sides[i] >= 0 && sides[j] >= 0)
          {
            add_block(tie.curved ? across : constrained,
                      sides[i],
                      sides[j],
                      tie.along_directions,
                      i,
                      j);
            if (tie.curved)
              add_block(moved, sides[i], sides[j], tie.along_all, i, j);
          }
  }

  namespace
  {
    using Vectors = std::vector<std::vector<double>>;

    /// Sums of @p vectors.
    Vectors
    combined(const Vectors &vectors, const Vectors &coefficients)
    {
      Vectors result;
      for (const auto &of_one : coefficients)
        {
          result.emplace_back(vectors.front().size(), 0.);
          for (unsigned int k = 0; k < vectors.size(); ++k)
            for (unsigned int i = 0; i < vectors[k].size(); ++i)
              result.back()[i] += of_one[k] * vectors[k][i];
        }
      return result;
    }

    /// Eigenvectors of values up to @p zero.
    Vectors
    null_space(const Spectrum &all, const double zero)
    {
      Vectors result;
      for (unsigned int k = 0; k < all.values.size(); ++k)
        if (!(all.values[k] > zero))
          result.push_back(all.vectors[k]);
      return result;
    }

    /// Of the same space, orthonormal.
    Vectors
    orthonormal(const Vectors &vectors)
    {
      Vectors result;
      for (std::vector<double> vector : vectors)
        {
          const auto product = [&](const std::vector<double> &other) {
            return std::inner_product(vector.begin(),
                                      vector.end(),
                                      other.begin(),
                                      0.);
          };
          const auto normalise = [&]() {
            const double norm = std::sqrt(product(vector));
            for (double &entry : vector)
              entry /= norm;
          };
          normalise();
          for (unsigned int twice = 0; twice < 2; ++twice)
            {
              for (const auto &other : result)
                {
                  const double along = product(other);
                  for (unsigned int i = 0; i < vector.size(); ++i)
                    vector[i] -= along * other[i];
                }
              normalise();
            }
          result.push_back(vector);
        }
      return result;
    }
  } // namespace

  std::vector<std::vector<double>>
  Resistance::free_motions() const
  {
    // surfaces that are approximated leave, squared, up to 1e-6, more in short
    // bodies; the slenderest tapers, 1 : 100 in diameter, 2.5e-5
    constexpr double zero_constrained = 1e-10, zero_across = 1e-5;
    const Spectrum   by_constrained = spectrum(constrained);
    const Vectors    left =
      null_space(by_constrained, zero_constrained * by_constrained.values[0]);
    if (left.empty())
      return left;
    const Spectrum of_left = spectrum(restricted(moved, left));
    const double   still   = rounding_of_squares * of_left.values[0];
    // those that move nothing that slides
    Vectors free = combined(left, null_space(of_left, still));
    Vectors unit; // those that move it by one
    for (unsigned int k = 0; k < of_left.values.size(); ++k)
      if (of_left.values[k] > still)
        {
          unit.push_back(combined(left, {of_left.vectors[k]}).front());
          for (double &entry : unit.back())
            entry /= std::sqrt(of_left.values[k]);
        }
    if (!unit.empty())
      for (auto &motion : combined(
             unit, null_space(spectrum(restricted(across, unit)), zero_across)))
        free.push_back(std::move(motion));
    return orthonormal(free);
  }
} // namespace mortise
