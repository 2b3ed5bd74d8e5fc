#include <deal.II/base/mpi.h>

#include <mortise/problem/support/weak_ties.h>

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
      for (const auto &sample : tie.samples)
        {
          area += sample.area;
          centre += sample.area * Tensor<1, dim>(sample.point);
        }
      area = Utilities::MPI::sum(area, comm);
      Extent result;
      result.centre = Point<dim>(Utilities::MPI::sum(centre, comm) / area);
      for (const auto &sample : tie.samples)
        square +=
          sample.area * sample.point.distance_square(result.centre) / area;
      result.size = std::sqrt(Utilities::MPI::sum(square, comm));
      return result;
    }

    /// The smallest x A x / x B x over all x that B resists.
    double
    smallest_ratio(const Resistance &A, const Resistance &B)
    {
      // what is orthogonal to the motions that B leaves free
      RigidMatrix projector = B.sum();
      projector             = 0.;
      const auto free       = B.free_motions();
      for (const auto &vector : free)
        for (unsigned int i = 0; i < projector.m(); ++i)
          for (unsigned int j = 0; j < projector.m(); ++j)
            projector(i, j) += vector[i] * vector[j];
      auto resisted = spectrum(projector).vectors;
      resisted.erase(resisted.begin(), resisted.begin() + free.size());
      const Spectrum all = spectrum(restricted(B.sum(), resisted));
      std::vector<std::vector<double>> unit; // x B x = 1
      for (unsigned int k = 0; k < all.values.size(); ++k)
        if (all.values[k] > rounding_of_squares * all.values[0])
          {
            unit.emplace_back(projector.m(), 0.);
            for (unsigned int l = 0; l < resisted.size(); ++l)
              for (unsigned int i = 0; i < projector.m(); ++i)
                unit.back()[i] +=
                  all.vectors[k][l] * resisted[l][i] / std::sqrt(all.values[k]);
          }
      return unit.empty() ? 1. :
                            spectrum(restricted(A.sum(), unit)).values.back();
    }

    /// Ratios are 1 where multipliers are dense, .3 for two in a row, and 0 for
    /// a single constant. Collective.
    bool
    is_weak(const TieSupport                                   &tie,
            const Bodies                                       &bodies,
            const std::vector<std::vector<DirichletCondition>> &dirichlet,
            const std::vector<RigidPart>                       &parts,
            const MPI_Comm                                      comm)
    {
      constexpr double least_ratio = 0.02;
      double           area        = 0.;
      for (const auto &sample : tie.samples)
        area += sample.area;
      area = Utilities::MPI::sum(area, comm);
      if (area == 0.)
        return false; // contact that is yet to come
      const Extent where = extent(tie, comm);
      TieSupport   ideal = tie;
      ideal.multipliers.clear();
      for (const auto &sample : tie.samples)
        {
          const double root = std::sqrt(sample.area / area);
          const auto   add  = [&](const Tensor<1, dim> &direction) {
            ideal.multipliers.push_back(
              {root * direction,
               root * outer_product(direction, Tensor<1, dim>(sample.point))});
          };
          if (tie.constrained == ConstrainedDirections::normal)
            add(sample.normal);
          else
            for (unsigned int c = 0; c < dim; ++c)
              {
                Tensor<1, dim> direction;
                direction[c] = 1.;
                add(direction);
              }
        }
      const auto resistance = [&](const TieSupport &with) {
        Resistance result(2);
        for (unsigned int i = 0; i < 2; ++i)
          {
            const unsigned int b = i == 0 ? tie.slave : tie.master;
            result.add(i, support_of(*bodies[b], dirichlet[b], parts, where));
          }
        result.add(0, 1, resistance_of(with, where, where, comm));
        return result;
      };
      return !(smallest_ratio(resistance(tie), resistance(ideal)) >
               least_ratio);
    }
  } // namespace

  std::vector<unsigned int>
  weak_ties(const Bodies                                       &bodies,
            const std::vector<std::vector<DirichletCondition>> &dirichlet,
            const std::vector<RigidPart>                       &parts,
            const std::vector<TieSupport>                      &ties,
            const std::vector<bool>                            &asked)
  {
    const MPI_Comm comm = bodies.front()->triangulation().get_communicator();
    std::vector<unsigned int> weak;
    for (unsigned int t = 0; t < ties.size(); ++t)
      if (asked[t] && ties[t].slave != ties[t].master &&
          ties[t].master != TieSupport::ground &&
          is_weak(ties[t], bodies, dirichlet, parts, comm))
        weak.push_back(t);
    std::sort(weak.begin(), weak.end(), [&](const auto a, const auto b) {
      return ties[a].name < ties[b].name;
    });
    return weak;
  }
} // namespace mortise
