// Tangents of coarse levels from those at the points of the finest.
#include <deal.II/base/quadrature_lib.h>

#include <mortise/operators/matrix_free/matrix_free_elasticity.h>
#include <mortise/operators/matrix_free/simplex_tables.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// By point of a coarse rule: numbers of points of a fine one and weights,
    /// which are positive and have the sum one.
    using Means = std::vector<std::vector<std::pair<unsigned int, double>>>;

    /// Linear between the points of a rule on the line.
    Means
    means_on_line(const std::vector<Point<1>> &fine,
                  const std::vector<Point<1>> &coarse)
    {
      Means result;
      for (const Point<1> &x : coarse)
        {
          const auto above =
            std::lower_bound(fine.begin(),
                             fine.end(),
                             x,
                             [](const Point<1> &a, const Point<1> &b) {
                               return a[0] < b[0];
                             });
          const unsigned int i = above - fine.begin();
          if (i == 0 || i == fine.size())
            {
              result.push_back({{i == 0 ? 0 : i - 1, 1.}});
              continue;
            }
          const double share =
            (x[0] - fine[i - 1][0]) / (fine[i][0] - fine[i - 1][0]);
          result.push_back({{i - 1, 1. - share}, {i, share}});
        }
      return result;
    }

    Means
    means_on_hexahedra(const unsigned int n_fine, const unsigned int n_coarse)
    {
      const Means line = means_on_line(QGauss<1>(n_fine).get_points(),
                                       QGauss<1>(n_coarse).get_points());
      Means       result;
      for (const auto &z : line)
        for (const auto &y : line)
          for (const auto &x : line)
            {
              result.emplace_back();
              for (const auto &[k, c] : z)
                for (const auto &[j, b] : y)
                  for (const auto &[i, a] : x)
                    if (a * b * c > 0.)
                      result.back().emplace_back(i + n_fine * (j + n_fine * k),
                                                 a * b * c);
            }
      return result;
    }

    /// By the inverse squares of distances from the nearest ones.
    Means
    means_of_nearest(const std::vector<Point<dim>> &fine,
                     const std::vector<Point<dim>> &coarse)
    {
      const unsigned int n_nearest = std::min<unsigned int>(4, fine.size());
      Means              result;
      for (const Point<dim> &x : coarse)
        {
          std::vector<std::pair<double, unsigned int>> by_distance;
          for (unsigned int i = 0; i < fine.size(); ++i)
            by_distance.emplace_back(fine[i].distance_square(x), i);
          std::sort(by_distance.begin(), by_distance.end());
          result.emplace_back();
          double sum = 0.;
          for (unsigned int k = 0; k < n_nearest; ++k)
            {
              const double weight = 1. / (by_distance[k].first + 1e-12);
              result.back().emplace_back(by_distance[k].second, weight);
              sum += weight;
            }
          for (auto &entry : result.back())
            entry.second /= sum;
        }
      return result;
    }

    template <typename Number>
    Means
    means(const CellBatches<double> &fine, const CellBatches<Number> &coarse)
    {
      if (!fine.tetrahedra)
        return means_on_hexahedra(fine.degree + 1, coarse.degree + 1);
      return means_of_nearest(simplex_rule<double>(fine.degree).get_points(),
                              simplex_rule<Number>(coarse.degree).get_points());
    }

    /// The metric at a point, of one cell, [a][e].
    template <typename Number>
    Tensor<2, dim>
    metric_at(const Number *metric, const unsigned int lane)
    {
      Tensor<2, dim> result;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int e = 0; e < dim; ++e)
          result[a][e] = metric[(dim * a + e) * Batch<Number>::size + lane];
      return result;
    }

    /// Takes the numbers of one group from a finer one, cell by cell.
    template <typename Number>
    class GroupTransfer
    {
    public:
      GroupTransfer(const CellBatches<double> &fine,
                    CellBatches<Number>       &coarse,
                    const bool                 initial_stress)
        : fine(fine)
        , coarse(coarse)
        , points(means(fine, coarse))
        , n_common(initial_stress ? n_tangent(fine.nonlinear->form()) :
                                    n_moduli(fine.nonlinear->form()))
      {}

      void
      transfer()
      {
        const bool finite = is_finite(fine.nonlinear->form());
        for (unsigned int cell = 0; cell < fine.n_cells; ++cell)
          {
            take_numbers(cell);
            if (finite)
              take_metric(cell);
          }
      }

    private:
      static constexpr unsigned int from = Batch<double>::size,
                                    to   = Batch<Number>::size;

      std::size_t
      fine_point(const unsigned int cell, const unsigned int q) const
      {
        return std::size_t(cell / from) * fine.n_points + q;
      }

      std::size_t
      coarse_point(const unsigned int cell, const unsigned int q) const
      {
        return std::size_t(cell / to) * coarse.n_points + q;
      }

      void
      take_numbers(const unsigned int cell)
      {
        with_form(fine.nonlinear->form(), [&](const auto form) {
          using Stored                  = StoredTangent<Number, form()>;
          constexpr unsigned int n_from = n_tangent(form()),
                                 n_to   = n_stored<Stored>(form());
          const auto *numbers           = fine.tangent_of<form()>() +
                                fine_point(cell, 0) * n_from * from +
                                cell % from;
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              double mean[n_from] = {};
              for (const auto &[r, weight] : points[q])
                for (unsigned int k = 0; k < n_common; ++k)
                  mean[k] += weight * numbers[(r * n_from + k) * from];
              Stored *target = coarse.template tangent_of<form()>() +
                               coarse_point(cell, q) * n_to * to + cell % to;
              if constexpr (in_two_parts<Stored>(form()))
                split_moduli(mean, target + n_from * to);
              for (unsigned int k = 0; k < n_common; ++k)
                store(mean[k], target[k * to]);
            }
        });
      }

      static void
      store(const double x, double &to)
      {
        to = x;
      }

      static void
      store(const double x, float &to)
      {
        to = x;
      }

      static void
      store(const double x, UpperHalf &to)
      {
        to = upper_half(x);
      }

      /// Take an isotropic law from @p moduli, whose mu' and lambda' are stored
      /// at @p isotropic.
      static void
      split_moduli(double *moduli, UpperHalf *isotropic)
      {
        // those of yz, zx, xy; of xx with yy, xx with zz, yy with zz
        store((moduli[15] + moduli[18] + moduli[20]) / 3., isotropic[0]);
        store((moduli[1] + moduli[2] + moduli[7]) / 3., isotropic[to]);
        for_isotropic_moduli(from_upper_half(isotropic[0]),
                             from_upper_half(isotropic[to]),
                             [=](const unsigned int k, const double modulus) {
                               moduli[k] -= modulus;
                             });
      }

      void
      take_metric(const unsigned int cell)
      {
        inverses.clear();
        for (unsigned int r = 0; r < fine.n_points; ++r)
          {
            const std::size_t at = fine_point(cell, r) * dim * dim * from;
            // F^{-1} = G^{-1} G_x
            inverses.push_back(
              invert(metric_at(&fine.metric[at], cell % from)) *
              metric_at(&fine.deformed_metric[at], cell % from));
          }
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            const std::size_t at = coarse_point(cell, q) * dim * dim * to;
            Tensor<2, dim>    mean;
            for (const auto &[r, weight] : points[q])
              mean += weight * inverses[r];
            const Tensor<2, dim> deformed =
              metric_at(&coarse.metric[at], cell % to) * mean;
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int e = 0; e < dim; ++e)
                coarse.deformed_metric[at + (dim * a + e) * to + cell % to] =
                  deformed[a][e];
          }
      }

      const CellBatches<double>  &fine;
      CellBatches<Number>        &coarse;
      const Means                 points;
      const unsigned int          n_common;
      std::vector<Tensor<2, dim>> inverses;
    };
  } // namespace

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::take_tangent(
    const MatrixFreeElasticity<double> &fine,
    const bool                          initial_stress)
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      if (groups[g].nonlinear && groups[g].n_cells > 0)
        GroupTransfer<Number>(fine.cells()[g], groups[g], initial_stress)
          .transfer();
  }

  template void
  MatrixFreeElasticity<float>::take_tangent(
    const MatrixFreeElasticity<double> &,
    bool);
  template void
  MatrixFreeElasticity<double>::take_tangent(
    const MatrixFreeElasticity<double> &,
    bool);
} // namespace mortise
