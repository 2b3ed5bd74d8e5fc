// The multipliers of a scene as functions on the covered slave faces: how
// independent they are and what they come close to.
#pragma once

#include <deal.II/lac/lapack_full_matrix.h>

#include "tied_scene.h"

namespace mortise::testing
{
  using namespace dealii;

  /// Whatever little.
  inline bool
  is_covered(const TiedScene &scene, const unsigned int s)
  {
    return scene.coupling().interface->coverage()[s] > 1e-6;
  }

  /// The multipliers of a scene as functions on the covered slave faces.
  class Functions
  {
  public:
    explicit Functions(const TiedScene &scene)
      : scene(scene)
      , n(scene.owned_multiplier.size())
      , gram(n)
    {
      std::vector<double> sums(n * n);
      for_each_point([&](const auto &, const auto &row, const double weight) {
        for (const auto &[i, value] : row)
          for (const auto &[j, other] : row)
            sums[i * n + j] += weight * (value * other);
      });
      Utilities::MPI::sum(sums, scene.comm, sums);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          gram(i, j) =
            sums[i * n + j] / std::sqrt(sums[i * n + i] * sums[j * n + j]);
      for (unsigned int i = 0; i < n; ++i)
        scale.push_back(std::sqrt(sums[i * n + i]));
    }

    /// Smallest eigenvalue of their mass matrix, scaled to a diagonal of one.
    double
    smallest_eigenvalue() const
    {
      LAPACKFullMatrix<double> copy = gram;
      FullMatrix<double>       vectors;
      dealii::Vector<double>   values;
      copy.compute_eigenvalues_symmetric(-1., 1e4, 1e-14, values, vectors);
      return values(0);
    }

    /// The distance of @p function to them in L2 over the covered faces,
    /// relative.
    double
    distance(const Field &function) const
    {
      std::vector<double> sums(n);
      for_each_point([&](const auto &x, const auto &row, const double weight) {
        for (const auto &[i, value] : row)
          sums[i] += weight * (value * function(x)) / scale[i];
      });
      Utilities::MPI::sum(sums, scene.comm, sums);
      LAPACKFullMatrix<double> factor = gram;
      factor.set_property(LAPACKSupport::symmetric);
      factor.compute_cholesky_factorization();
      dealii::Vector<double> best(sums.begin(), sums.end());
      factor.solve(best);
      double squared = 0., norm = 0.;
      for_each_point([&](const auto &x, const auto &row, const double weight) {
        const Tensor<1, dim> target     = function(x);
        Tensor<1, dim>       difference = target;
        for (const auto &[i, value] : row)
          difference -= best(i) / scale[i] * value;
        squared += weight * difference.norm_square();
        norm += weight * target.norm_square();
      });
      return std::sqrt(Utilities::MPI::sum(squared, scene.comm) /
                       Utilities::MPI::sum(norm, scene.comm));
    }

  private:
    /// visit(x, {(multiplier, value)}, weight) for points of all faces that
    /// are covered, whatever little.
    template <typename Visit>
    void
    for_each_point(const Visit &visit) const
    {
      const BodySurface &slave = scene.coupling().interface->slave();
      for (unsigned int s = 0; s < slave.faces.size(); ++s)
        if (is_covered(scene, s))
          {
            const TraceBasis   &basis = slave.traces[s].basis();
            const auto         &rows  = scene.coupling().multipliers->rows()[s];
            const auto          rule = face_rule(basis.shape, basis.degree + 2);
            std::vector<double> values(basis.size());
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                const Point<2> &xi = rule.point(q);
                basis.evaluate(xi[0], xi[1], values.data());
                const auto         &psi = scene.coupling().local[s].multiplier;
                std::vector<double> multipliers(basis.size());
                for (unsigned int i = 0; i < basis.size(); ++i)
                  for (unsigned int j = 0; j < basis.size(); ++j)
                    multipliers[i] += psi(i, j) * values[j];
                std::map<Index, Tensor<1, dim>> row;
                for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
                  for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1];
                       ++e)
                    row[rows.index[e]][r / basis.size()] +=
                      rows.weight[e] * multipliers[r % basis.size()];
                visit(face_point(slave.faces[s], xi), row, rule.weight(q));
              }
          }
    }

    using Index = types::global_dof_index;

    const TiedScene         &scene;
    const unsigned int       n;
    LAPACKFullMatrix<double> gram;
    std::vector<double>      scale;
  };
} // namespace mortise::testing
