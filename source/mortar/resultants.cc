// Resultants of the tractions of an interface, resultants().
#include <deal.II/base/mpi.h>

#include <mortise/mortar/coupling.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "multiplier_sums.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The coefficients in the functions N of the positions on a slave face.
    std::vector<Tensor<1, dim>>
    positions(const LocalCoupling &local)
    {
      const unsigned int n = local.constraint.m();
      FullMatrix<double> inverse(n, n);
      inverse.invert(local.constraint);
      std::vector<Tensor<1, dim>> result(n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          result[j] += inverse(j, i) * local.position_moment[i];
      return result;
    }

    /// Of pressures normal to the master at each point, see LocalCoupling.
    class OfPressures
    {
    public:
      OfPressures(const Coupling &coupling, const unsigned int s)
        : coupling(coupling)
        , s(s)
        , local(coupling.local[s])
        , x(positions(local))
      {}

      /// int psi_i d on the slave.
      Tensor<1, dim>
      force(const unsigned int i) const
      {
        return on_constants(local.directed,
                            i,
                            coupling.interface->slave().traces[s].basis());
      }

      /// The same less that on the master.
      Tensor<1, dim>
      imbalance(const unsigned int i) const
      {
        Tensor<1, dim> result = force(i);
        for (const auto &partner : local.partners)
          result -= on_constants(
            partner.directed,
            i,
            coupling.interface->master_traces()[partner.master].basis());
        return result;
      }

      /// int psi_i x cross d
      Tensor<1, dim>
      moment(const unsigned int i) const
      {
        Tensor<1, dim> result;
        for (unsigned int j = 0; j < x.size(); ++j)
          {
            Tensor<1, dim> direction;
            for (unsigned int c = 0; c < dim; ++c)
              direction[c] = local.directed[c](i, j);
            result += cross_product_3d(x[j], direction);
          }
        return result;
      }

    private:
      const Coupling                   &coupling;
      const unsigned int                s;
      const LocalCoupling              &local;
      const std::vector<Tensor<1, dim>> x;
    };
  } // namespace

  Resultants
  resultants(const Coupling &coupling,
             const Vector   &multiplier,
             const MPI_Comm  comm)
  {
    const auto coefficients =
      multiplier_coefficients(coupling, multiplier, comm);
    Resultants     result;
    Tensor<1, dim> force, moment; // imbalance
    double         squared = 0.;
    for (unsigned int s = 0; s < coupling.local.size(); ++s)
      if (!coupling.local[s].partners.empty())
        {
          const LocalCoupling       &local = coupling.local[s];
          const unsigned int         n     = local.mass.m();
          std::optional<OfPressures> of_pressures;
          if (local.is_directed())
            of_pressures.emplace(coupling, s);
          for (unsigned int i = 0; i < n; ++i)
            {
              Tensor<1, dim> value;
              for (unsigned int c = 0; c < dim; ++c)
                {
                  value[c] = coefficients[s][c * n + i];
                  for (unsigned int j = 0; j < n; ++j)
                    squared += value[c] * multiplier_product(local, i, j) *
                               coefficients[s][c * n + j];
                }
              if (of_pressures)
                {
                  const Tensor<1, dim> &normal   = coupling.frames[s][i][0];
                  const double          pressure = value * normal;
                  result.force += pressure * of_pressures->force(i);
                  result.moment += pressure * of_pressures->moment(i);
                  force += pressure * of_pressures->imbalance(i);
                  value -= pressure * normal;
                }
              result.force += integral(coupling, s, i) * value;
              result.moment +=
                cross_product_3d(local.position_moment[i], value);
              force += row_difference(coupling, s, i) * value;
              moment += cross_product_3d(local.gap_moment[i], value);
            }
        }
    result.force      = Utilities::MPI::sum(result.force, comm);
    result.moment     = Utilities::MPI::sum(result.moment, comm);
    force             = Utilities::MPI::sum(force, comm);
    moment            = Utilities::MPI::sum(moment, comm);
    const double area = coupling.interface->report().covered_area;
    const double carried =
      std::sqrt(std::max(0., Utilities::MPI::sum(squared, comm)) * area);
    if (carried > 0.)
      {
        result.force_residual  = force.norm() / carried;
        result.moment_residual = moment.norm() / (carried * std::sqrt(area));
      }
    return result;
  }
} // namespace mortise
