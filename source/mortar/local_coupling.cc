#include <mortise/mortar/local_coupling.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// N_i(x_q), one row per point.
    void
    evaluate(const TraceBasis                         &basis,
             const std::array<std::vector<double>, 2> &coordinates,
             const unsigned int                        n_points,
             FullMatrix<double>                       &values)
    {
      values.reinit(n_points, basis.size(), true);
      for (unsigned int q = 0; q < n_points; ++q)
        basis.evaluate(coordinates[0][q], coordinates[1][q], &values(q, 0));
    }

    /// w_q N_i(x_q). Weights of signed sectors may be negative, so there is no
    /// root to take.
    void
    scale_rows(const FullMatrix<double>  &values,
               const std::vector<double> &weights,
               FullMatrix<double>        &scaled)
    {
      scaled = values;
      for (unsigned int q = 0; q < scaled.m(); ++q)
        for (unsigned int i = 0; i < scaled.n(); ++i)
          scaled(q, i) *= weights[q];
    }

    /// Iterations to 1e-8 with factors 1, 1.8, 3, 5: prm/flange.prm 29, 25, 22,
    /// 21, the thick sphere of tetrahedra of degree 1 13, 12, 13, 15, of degree
    /// 2 16, 14, 14, 15, of degree 3 14, 13, 12, 13.
    constexpr double penalty_factor = 1.8;

    /// Of the layer of cells behind a face; layers one behind the other add up.
    double
    compliance(const FaceTrace &trace)
    {
      return trace.depth / (2. * penalty_factor * trace.modulus);
    }
  } // namespace

  std::vector<LocalCoupling>
  integrate_coupling(InterfaceHandler &interface, const bool with_master_mass)
  {
    std::vector<LocalCoupling> couplings(interface.slave().faces.size());
    FullMatrix<double>         slave_values, master_values, weighted;

    interface.visit_pairs([&](const unsigned int       s,
                              const unsigned int       m,
                              const IntegrationPoints &points) {
      LocalCoupling     &local   = couplings[s];
      const FaceTrace   &slave   = interface.slave().traces[s];
      const FaceTrace   &master  = interface.master_traces()[m];
      const unsigned int n_slave = slave.n_functions();
      const double pair_penalty = 1. / (compliance(slave) + compliance(master));
      if (local.partners.empty())
        {
          local.mass.reinit(n_slave, n_slave);
          local.gap_moment.resize(n_slave);
          local.penalty = pair_penalty;
        }
      local.penalty = std::min(local.penalty, pair_penalty);

      evaluate(slave.basis(), points.slave_xi, points.size(), slave_values);
      evaluate(master.basis(), points.master_eta, points.size(), master_values);
      scale_rows(slave_values, points.weight, weighted);
      weighted.Tmmult(local.mass, slave_values, true);

      LocalCoupling::Partner partner;
      partner.master = m;
      partner.mixed.reinit(n_slave, master.n_functions());
      weighted.Tmmult(partner.mixed, master_values);
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          Tensor<1, dim> gap;
          for (unsigned int c = 0; c < dim; ++c)
            gap[c] = points.master_x[c][q] - points.slave_x[c][q];
          for (unsigned int i = 0; i < n_slave; ++i)
            local.gap_moment[i] += weighted(q, i) * gap;
        }
      if (with_master_mass)
        {
          scale_rows(master_values, points.weight, weighted);
          partner.mass.reinit(master.n_functions(), master.n_functions());
          weighted.Tmmult(partner.mass, master_values);
        }
      local.partners.push_back(std::move(partner));
    });
    return couplings;
  }
} // namespace mortise
