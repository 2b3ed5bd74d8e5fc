#include <deal.II/base/mpi.h>

#include <mortise/body/boundary_faces.h>
#include <mortise/problem/rigid_support.h>

#include <algorithm>
#include <limits>

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

  Support
  support_of(const Body                            &body,
             const std::vector<DirichletCondition> &dirichlet,
             const Extent                          &where,
             const PartOfBody                      &part)
  {
    Support support(1);
    for (const DirichletCondition &condition : dirichlet)
      for (const auto &[cell, f] : boundary_faces(body, condition.boundary))
        if (cell->is_locally_owned() && part.has(cell))
          for (const unsigned int v : cell->face(f)->vertex_indices())
            for (unsigned int c = 0; c < dim; ++c)
              if (condition.fixed[c])
                support.add({row_of(where, c, cell->face(f)->vertex(v))});
    support.finish(body.triangulation().get_communicator());
    return support;
  }

  Support
  support_of(const TieSupport &tie,
             const Extent     &slave,
             const Extent     &master,
             const MPI_Comm    comm)
  {
    Support support(2);
    for (const MultiplierMoment &m : tie.multipliers)
      {
        Motion minus = row_of(master, m);
        for (double &entry : minus)
          entry *= -1.;
        support.add({row_of(slave, m), minus}, 1., m.weight.norm_square());
      }
    support.finish(comm);
    return support;
  }

  /// Add the block of bodies @p a, @p b of @p support in the place of @p i, @p j.
  void
  add_block(RigidMatrix       &matrix,
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

  // Singular values: LAPACK's iteration for eigenvectors fails now and then
  // where many eigenvalues are equal.
  Spectrum
  spectrum(RigidMatrix matrix)
  {
    matrix.compute_svd();
    const RigidMatrix &columns = matrix.get_svd_u();
    Spectrum           result;
    for (unsigned int k = 0; k < matrix.m(); ++k)
      {
        result.values.push_back(matrix.singular_value(k));
        result.vectors.emplace_back(matrix.m());
        for (unsigned int i = 0; i < matrix.m(); ++i)
          result.vectors.back()[i] = columns(i, k);
      }
    return result;
  }

  std::vector<std::vector<double>>
  null_space(RigidMatrix matrix, const double zero)
  {
    Spectrum                         all = spectrum(std::move(matrix));
    std::vector<std::vector<double>> result;
    for (unsigned int k = 0; k < all.values.size(); ++k)
      if (!(all.values[k] > zero * all.values[0]))
        result.push_back(std::move(all.vectors[k]));
    return result;
  }
} // namespace mortise
