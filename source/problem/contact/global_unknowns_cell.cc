// The mean strain of a periodic cell, members of GlobalUnknowns.
#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact/global_unknowns.h>
#include <mortise/problem/input/periodic_cell.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  void
  GlobalUnknowns::find_enclosure()
  {
    constexpr double least = 0.5; // of the volume
    fluxes.reinit(all.size());
    for (const SystemVector &state : discretisation.free_states())
      if (state.multiplier.size() > 0)
        {
          for (unsigned int j = indices.size(); j < first_motion; ++j)
            if (j - indices.size() < dim) // shears keep the volume
              fluxes(j) = all[j].rhs.multiplier * state.multiplier;
          if (fluxes.linfty_norm() > least * volume)
            {
              enclosure.emplace(state);
              break;
            }
          fluxes = 0.;
        }
    if (enclosure && has_free_volume(run.parameters) &&
        (discretisation.linear_system().bulk->is_nonlinear() ||
         discretisation.interfaces().follow()))
      run.parameters.fail(
        "Periodic cell/Mean strain",
        "free components of a cell that is filled with incompressible bodies, whose law is not linear, or with contact that follows bodies",
        "Poisson ratios below 0.5, or a Mean strain that keeps the volume");
  }

  void
  GlobalUnknowns::check_volume() const
  {
    constexpr double rounding = 0.01;
    double           net = 0., total = 0.;
    for (unsigned int j = 0; j < all.size(); ++j)
      {
        if (forces[j] && fluxes(j) != 0.)
          return; // that component keeps it
        net += values[j] * fluxes(j);
        total += std::fabs(values[j] * fluxes(j));
      }
    if (std::fabs(net) > rounding * total)
      run.parameters.fail(
        "Periodic cell/Mean strain",
        "a change of volume of a cell that is filled with incompressible bodies",
        "components xx, yy, zz whose sum is zero, one of them free, or smaller Poisson ratios");
  }

  std::optional<PeriodicCellSummary>
  GlobalUnknowns::cell(const SystemVector &x) const
  {
    if (first_motion == indices.size())
      return {};
    PeriodicCellSummary result;
    result.volume = volume;
    for (unsigned int j = indices.size(); j < first_motion; ++j)
      {
        result.mean_strain.push_back(values[j]);
        result.mean_stress.push_back(force(j, x) /
                                     work_of_stress(j - indices.size()));
      }
    return result;
  }

  double
  GlobalUnknowns::net_flux(const SystemVector &rhs) const
  {
    for (unsigned int j = 0; j < all.size(); ++j)
      if (forces[j] && fluxes(j) != 0.)
        return rhs.pressure * enclosure->pressure +
               rhs.multiplier * enclosure->multiplier;
    return 0.;
  }

  double
  GlobalUnknowns::take_pressure(dealii::Vector<double> &lacks) const
  {
    dealii::Vector<double> free(all.size());
    for (unsigned int j = 0; j < all.size(); ++j)
      free(j) = forces[j] ? fluxes(j) : 0.;
    const double square = free * free;
    if (square == 0.)
      return 0.;
    const double pressure = -(lacks * free) / square;
    lacks.add(pressure, free);
    return pressure;
  }

  double
  GlobalUnknowns::work_of_stress(const unsigned int k) const
  {
    return volume * unit_strain(k).norm_square();
  }

  void
  GlobalUnknowns::check_resistance(const FullMatrix<double> &stiffness) const
  {
    // a lattice of pores resists with more of what its solid does
    constexpr double          least = 1e-9;
    std::vector<unsigned int> free;
    for (unsigned int j = indices.size(); j < first_motion; ++j)
      if (forces[j])
        free.push_back(j);
    if (free.empty())
      return;
    double modulus = 0.;
    for (const auto &body : discretisation.bodies())
      modulus = std::max(modulus, body->material.modulus());
    LAPACKFullMatrix<double> matrix(free.size(), free.size());
    for (unsigned int a = 0; a < free.size(); ++a)
      for (unsigned int b = 0; b < free.size(); ++b)
        matrix(a, b) = stiffness(free[a], free[b]);
    matrix.compute_svd();
    if (matrix.singular_value(free.size() - 1) > least * modulus * volume)
      return;
    run.parameters.fail(
      "Periodic cell/Mean strain",
      "free components that nothing resists",
      "free components of which none is a rigid motion of all cells, as shears along a single translation are, and bodies that "
      "hold together from cell to cell");
  }
} // namespace mortise
