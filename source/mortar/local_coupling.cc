#include <mortise/mortar/local_coupling.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// So many points are evaluated at a time: their values stay in the cache.
    constexpr unsigned int max_points = 128;

    /// N_i(x_q), one row for each of @p n_points points.
    void
    evaluate(const TraceBasis                         &basis,
             const std::array<std::vector<double>, 2> &coordinates,
             const unsigned int                        first,
             const unsigned int                        n_points,
             FullMatrix<double>                       &values)
    {
      values.reinit(n_points, basis.size(), true);
      for (unsigned int q = 0; q < n_points; ++q)
        basis.evaluate(coordinates[0][first + q],
                       coordinates[1][first + q],
                       &values(q, 0));
    }

    /// w_q N_i(x_q). Weights of signed sectors may be negative, so there is no
    /// root to take.
    void
    scale_rows(const FullMatrix<double> &values,
               const double             *weights,
               FullMatrix<double>       &scaled)
    {
      scaled.reinit(values.m(), values.n(), true);
      for (unsigned int q = 0; q < values.m(); ++q)
        {
          const double  weight = weights[q];
          const double *from   = &values(q, 0);
          double       *to     = &scaled(q, 0);
          for (unsigned int i = 0; i < values.n(); ++i)
            to[i] = weight * from[i];
        }
    }

    /// Fewest iterations: doc/tuning.md.
    constexpr double penalty_factor = 1.8;

    /// Of the layer of cells behind a face; layers one behind the other add up.
    double
    compliance(const FaceTrace &trace)
    {
      return trace.depth / (2. * penalty_factor * trace.modulus);
    }

    /// Nodes on an area, but for a factor that all shapes share.
    double
    density(const SurfaceFace &face, const FaceTrace &trace)
    {
      return trace.degree * trace.degree /
             cross_product_3d(face.frame.tangent[0], face.frame.tangent[1])
               .norm();
    }

    /// How many times as many nodes on an area a slave needs at least to
    /// follow. Where multipliers do not move the master's nodes, those that
    /// meet on a large face do not couple with each other, but two projections
    /// are needed in place of one: doc/tuning.md.
    double
    least_density_ratio(const unsigned int degree)
    {
      return degree == 1 ? 16. : 3.;
    }

    /// A slave that is stiffer than this follows badly where it is covered in
    /// part: doc/tuning.md.
    constexpr double largest_modulus_ratio = 100.;

    bool
    leads(const InterfaceHandler &interface,
          const unsigned int      s,
          const unsigned int      m)
    {
      const FaceTrace &slave  = interface.slave().traces[s];
      const FaceTrace &master = interface.master_traces()[m];
      return !slave.nodes.empty() &&
             slave.modulus <= largest_modulus_ratio * master.modulus &&
             density(interface.slave().faces[s], slave) >
               least_density_ratio(slave.degree) *
                 density(interface.master_faces()[m], master);
    }
  } // namespace

  std::vector<LocalCoupling>
  integrate_coupling(InterfaceHandler &interface, const bool with_master_mass)
  {
    std::vector<LocalCoupling> couplings(interface.slave().faces.size());
    FullMatrix<double> slave_values, master_values, weighted, places, moment;

    interface.visit_pairs([&](const unsigned int       s,
                              const unsigned int       m,
                              const IntegrationPoints &points) {
      LocalCoupling         &local   = couplings[s];
      const FaceTrace       &slave   = interface.slave().traces[s];
      const FaceTrace       &master  = interface.master_traces()[m];
      const unsigned int     n_slave = slave.n_functions();
      LocalCoupling::Partner partner;
      partner.master = m;
      partner.leads  = leads(interface, s, m);
      const double pair_penalty =
        1. / (compliance(slave) + (partner.leads ? 0. : compliance(master)));
      if (local.partners.empty())
        {
          local.mass.reinit(n_slave, n_slave);
          local.gap_moment.resize(n_slave);
          local.position_moment.resize(n_slave);
          local.penalty = pair_penalty;
        }
      local.penalty = std::min(local.penalty, pair_penalty);

      partner.mixed.reinit(n_slave, master.n_functions());
      if (with_master_mass)
        partner.mass.reinit(master.n_functions(), master.n_functions());
      moment.reinit(n_slave, 2 * dim);
      for (unsigned int first = 0; first < points.size(); first += max_points)
        {
          const unsigned int n =
            std::min<unsigned int>(max_points, points.size() - first);
          evaluate(slave.basis(), points.slave_xi, first, n, slave_values);
          evaluate(master.basis(), points.master_eta, first, n, master_values);
          scale_rows(slave_values, &points.weight[first], weighted);
          weighted.Tmmult(local.mass, slave_values, true);
          weighted.Tmmult(partner.mixed, master_values, true);
          places.reinit(n, 2 * dim, true);
          for (unsigned int q = 0; q < n; ++q)
            for (unsigned int c = 0; c < dim; ++c)
              {
                places(q, c) =
                  points.master_x[c][first + q] - points.slave_x[c][first + q];
                places(q, dim + c) = points.slave_x[c][first + q];
              }
          weighted.Tmmult(moment, places, true);
          if (with_master_mass)
            {
              scale_rows(master_values, &points.weight[first], weighted);
              weighted.Tmmult(partner.mass, master_values, true);
            }
        }
      for (unsigned int i = 0; i < n_slave; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          {
            local.gap_moment[i][c] += moment(i, c);
            local.position_moment[i][c] += moment(i, dim + c);
          }
      local.partners.push_back(std::move(partner));
    });
    return couplings;
  }
} // namespace mortise
