#include <mortise/mortar/local_coupling.h>

#include <mortise/body/legendre_basis.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// sqrt(w_q) N_i(x_q), one row per point.
    void
    weighted_values(const unsigned int                        degree,
                    const std::array<std::vector<double>, 2> &coordinates,
                    const std::vector<double>                &weights,
                    FullMatrix<double>                       &values)
    {
      const unsigned int n = degree + 1;
      values.reinit(weights.size(), n * n);
      double x[max_degree + 1], y[max_degree + 1];
      for (unsigned int q = 0; q < weights.size(); ++q)
        {
          evaluate_lobatto(degree, coordinates[0][q], x);
          evaluate_lobatto(degree, coordinates[1][q], y);
          const double root = std::sqrt(weights[q]);
          double      *row  = &values(q, 0);
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i)
              row[i + n * j] = root * x[i] * y[j];
        }
    }

    double
    penalty(const FaceTrace &trace, const SurfaceFace &face)
    {
      return trace.modulus * trace.degree * trace.degree / face.size;
    }
  } // namespace

  std::vector<LocalCoupling>
  integrate_coupling(InterfaceHandler &interface, const bool with_master_mass)
  {
    std::vector<LocalCoupling> couplings(interface.slave().faces.size());
    FullMatrix<double>         slave_values, master_values;

    interface.visit_pairs([&](const unsigned int s, const unsigned int m, const IntegrationPoints &points) {
      LocalCoupling     &local        = couplings[s];
      const FaceTrace   &slave        = interface.slave().traces[s];
      const FaceTrace   &master       = interface.master_traces()[m];
      const unsigned int n_slave      = slave.n_functions();
      const double       pair_penalty = std::min(penalty(slave, interface.slave().faces[s]),
                                           penalty(master, interface.master_faces()[m]));
      if (local.partners.empty())
        {
          local.mass.reinit(n_slave, n_slave);
          local.gap_moment.resize(n_slave);
          local.penalty = pair_penalty;
        }
      local.penalty = std::min(local.penalty, pair_penalty);

      weighted_values(slave.degree, points.slave_xi, points.weight, slave_values);
      weighted_values(master.degree, points.master_eta, points.weight, master_values);
      slave_values.Tmmult(local.mass, slave_values, true);

      LocalCoupling::Partner partner;
      partner.master = m;
      partner.mixed.reinit(n_slave, master.n_functions());
      slave_values.Tmmult(partner.mixed, master_values);
      if (with_master_mass)
        {
          partner.mass.reinit(master.n_functions(), master.n_functions());
          master_values.Tmmult(partner.mass, master_values);
        }
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          Tensor<1, dim> gap;
          for (unsigned int c = 0; c < dim; ++c)
            gap[c] = points.master_x[c][q] - points.slave_x[c][q];
          gap *= std::sqrt(points.weight[q]);
          for (unsigned int i = 0; i < n_slave; ++i)
            local.gap_moment[i] += slave_values(q, i) * gap;
        }
      local.partners.push_back(std::move(partner));
    });
    return couplings;
  }
} // namespace mortise
