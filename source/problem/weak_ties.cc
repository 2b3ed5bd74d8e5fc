#include <deal.II/base/mpi.h>

#include <mortise/problem/weak_ties.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Centre and radius of the places. Collective.
    Extent
    extent(const TieSupport &tie, const MPI_Comm comm)
    {
      double         area = 0., square = 0.;
      Tensor<1, dim> centre;
      for (const auto &place : tie.places)
        {
          area += place.area;
          centre += place.area * Tensor<1, dim>(place.point);
        }
      area = Utilities::MPI::sum(area, comm);
      Extent result;
      result.centre = Point<dim>(Utilities::MPI::sum(centre, comm) / area);
      for (const auto &place : tie.places)
        square +=
          place.area * place.point.distance_square(result.centre) / area;
      result.size = std::sqrt(Utilities::MPI::sum(square, comm));
      return result;
    }

    /// The smallest x A x / x B x over all x with x B x > 0.
    double
    smallest_ratio(const RigidMatrix &A,
                   const RigidMatrix &B,
                   const double       zero)
    {
      const unsigned int n     = A.m();
      const Spectrum     all   = spectrum(B);
      unsigned int       range = 0;
      while (range < n && all.values[range] > zero * all.values[0])
        ++range;
      if (range == 0)
        return 1.;
      RigidMatrix ratios(range, range);
      for (unsigned int a = 0; a < range; ++a)
        for (unsigned int b = 0; b < range; ++b)
          {
            double sum = 0.;
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                sum += all.vectors[a][i] * A(i, j) * all.vectors[b][j];
            ratios(a, b) = sum / std::sqrt(all.values[a] * all.values[b]);
          }
      return spectrum(ratios).values.back();
    }

    /// Ratios are 1 where multipliers are dense, .3 for two in a row, and 0 for
    /// a single constant. Collective.
    bool
    is_weak(const TieSupport                                   &tie,
            const Bodies                                       &bodies,
            const std::vector<std::vector<DirichletCondition>> &dirichlet,
            const MPI_Comm                                      comm)
    {
      constexpr double least_ratio = 0.02;
      const Extent     where       = extent(tie, comm);
      TieSupport       ideal       = tie;
      ideal.multipliers.clear();
      double area = 0.;
      for (const auto &place : tie.places)
        area += place.area;
      area = Utilities::MPI::sum(area, comm);
      for (const auto &place : tie.places)
        {
          const double root = std::sqrt(place.area / area);
          const auto   add  = [&](const Tensor<1, dim> &direction) {
            ideal.multipliers.push_back(
              {root * direction,
               root * outer_product(direction, Tensor<1, dim>(place.point))});
          };
          if (tie.directions == TiedDirections::normal)
            add(place.normal);
          else
            for (unsigned int c = 0; c < dim; ++c)
              {
                Tensor<1, dim> direction;
                direction[c] = 1.;
                add(direction);
              }
        }
      RigidMatrix matrices[2];
      for (unsigned int m = 0; m < 2; ++m)
        {
          matrices[m].reinit(12);
          const Support support =
            support_of(m == 0 ? tie : ideal, where, where, comm);
          for (unsigned int i = 0; i < 2; ++i)
            {
              const unsigned int b = i == 0 ? tie.slave : tie.master;
              add_block(matrices[m],
                        i,
                        i,
                        support_of(*bodies[b], dirichlet[b], where),
                        0,
                        0);
              for (unsigned int j = 0; j < 2; ++j)
                add_block(matrices[m], i, j, support, i, j);
            }
        }
      return !(smallest_ratio(matrices[0],
                              matrices[1],
                              tie.directions == TiedDirections::all ?
                                zero_support :
                                zero_support_of_sliding) > least_ratio);
    }
  } // namespace

  std::vector<unsigned int>
  weak_ties(const Bodies                                       &bodies,
            const std::vector<std::vector<DirichletCondition>> &dirichlet,
            const std::vector<TieSupport>                      &ties)
  {
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    std::vector<unsigned int> weak;
    for (unsigned int t = 0; t < ties.size(); ++t)
      if (ties[t].slave != ties[t].master &&
          ties[t].master != TieSupport::ground &&
          is_weak(ties[t], bodies, dirichlet, comm))
        weak.push_back(t);
    std::sort(weak.begin(), weak.end(), [&](const auto a, const auto b) {
      return ties[a].name < ties[b].name;
    });
    return weak;
  }
} // namespace mortise
