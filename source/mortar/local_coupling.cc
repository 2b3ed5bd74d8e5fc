#include <deal.II/base/quadrature_lib.h>

#include <mortise/mortar/local_coupling.h>
#include <mortise/mortar/nodal_block.h>

#include <algorithm>

#include "along_normals.h"
#include "independent_masters.h"
#include "projected_products.h"

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

    /// int phi_i over the area of an affine face, for those that have dual
    /// multipliers.
    double
    reference_weight(const TraceBasis &basis, const unsigned int i)
    {
      if (basis.shape == FaceShape::triangle)
        return 1. / basis.size();
      // ends first, as functions are ordered
      const QGaussLobatto<1> rule(basis.degree + 1);
      double                 weight = 1.;
      for (const unsigned int k :
           {i % (basis.degree + 1), i / (basis.degree + 1)})
        weight *= rule.weight(k == 0 ? 0 : k == 1 ? basis.degree : k - 1);
      return weight;
    }

    /// Less of a face is not covered than rounding and the curvature of rims
    /// leave open.
    constexpr double covered_as_a_whole = 0.999;

    /// Of the weights of dual multipliers: the least, over that on a face that
    /// is affine.
    constexpr double least_weight = 0.2;

    /// int psi_i of dual multipliers; empty where some would not be positive.
    std::vector<double>
    dual_weights(const FullMatrix<double> &mass, const FaceTrace &trace)
    {
      if (trace.shape == FaceShape::triangle && trace.degree > 1)
        return {};
      const FaceNodalBasis &nodal = face_nodal_basis(trace.shape, trace.degree);
      const TraceBasis     &basis = trace.basis();
      // int phi_i = sum_j int N_j 1 F_ji; 1 is the sum over the functions of
      // the vertices
      dealii::Vector<double> ones(basis.size()), moments(ones), weights(ones);
      for (unsigned int v = 0; v < basis.n_vertices(); ++v)
        ones(basis.vertex_function(v)) = 1.;
      mass.vmult(moments, ones);
      nodal.functions.Tvmult(weights, moments);
      const double area = ones * moments;
      for (unsigned int i = 0; i < weights.size(); ++i)
        if (!(weights(i) > least_weight * area * reference_weight(basis, i)))
          return {};
      return {weights.begin(), weights.end()};
    }

    /// Integrals with the multipliers psi = A N from those with N.
    void
    take_multipliers(const FullMatrix<double>            &A,
                     std::array<FullMatrix<double>, dim> &of_components)
    {
      for (FullMatrix<double> &integrals : of_components)
        {
          const FullMatrix<double> of_functions = integrals;
          A.mmult(integrals, of_functions);
        }
    }

    /// What follows from the integrals of shape functions.
    void
    set_multipliers(const FaceTrace &trace,
                    const bool       dual,
                    LocalCoupling   &local)
    {
      const FaceNodalBasis &nodal = face_nodal_basis(trace.shape, trace.degree);
      const unsigned int    n     = local.mass.m();
      if (dual)
        local.weights = dual_weights(local.mass, trace);
      if (local.is_dual())
        {
          // A F^T with A = W M^{-1}, M the mass matrix of the nodal functions,
          // which is conditioned well
          const BlockSide    side{trace.shape, trace.degree, trace.degree};
          FullMatrix<double> inverse(n, n);
          inverse.invert(nodal_block(local.mass, side, side));
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              inverse(i, j) *= local.weights[i];
          local.multiplier.reinit(n, n);
          inverse.mTmult(local.multiplier, nodal.functions);
          // W N, since int psi_i phi_j = w_i delta_ij
          local.constraint = nodal.values;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              local.constraint(i, j) *= local.weights[i];
        }
      else
        {
          local.multiplier.copy_transposed(nodal.functions);
          local.constraint.reinit(n, n);
          local.multiplier.mmult(local.constraint, local.mass);
        }
      for (auto &partner : local.partners)
        {
          partner.constraint.reinit(n, partner.mixed.n());
          local.multiplier.mmult(partner.constraint, partner.mixed);
        }
      if (local.is_directed())
        {
          take_multipliers(local.multiplier, local.directed);
          for (auto &partner : local.partners)
            take_multipliers(local.multiplier, partner.directed);
          const dealii::Vector<double> of_functions(
            local.distance_moment.begin(), local.distance_moment.end());
          dealii::Vector<double> of_multipliers(n);
          local.multiplier.vmult(of_multipliers, of_functions);
          local.distance_moment.assign(of_multipliers.begin(),
                                       of_multipliers.end());
        }
      for (auto *moments : {&local.gap_moment,
                            &local.position_moment,
                            &local.undeformed_moment})
        {
          const std::vector<Tensor<1, dim>> of_functions = *moments;
          for (unsigned int i = 0; i < moments->size(); ++i)
            {
              (*moments)[i] = Tensor<1, dim>();
              for (unsigned int j = 0; j < n; ++j)
                (*moments)[i] += local.multiplier(i, j) * of_functions[j];
            }
        }
    }

    /// d of LocalCoupling at points @p first, ..., by component.
    std::array<std::vector<double>, dim>
    directions(const SurfaceFace       &slave,
               const SurfaceFace       &master,
               const IntegrationPoints &points,
               const unsigned int       first,
               const unsigned int       n)
    {
      std::array<std::vector<double>, dim> result;
      for (unsigned int q = first; q < first + n; ++q)
        {
          const Tensor<1, dim> along =
            averaged_normal(slave,
                            {points.slave_xi[0][q], points.slave_xi[1][q]});
          const Tensor<1, dim> nu =
            -face_normal(master,
                         {points.master_eta[0][q], points.master_eta[1][q]});
          for (unsigned int c = 0; c < dim; ++c)
            result[c].push_back(along.norm() * nu[c] / (along * nu));
        }
      return result;
    }
  } // namespace

  std::vector<LocalCoupling>
  integrate_coupling(InterfaceHandler                      &interface,
                     const bool                             with_master_mass,
                     const MultiplierBasis                  basis,
                     const bool                             may_be_independent,
                     const std::vector<std::vector<Frame>> &frames)
  {
    const bool is_displaced = !interface.slave().undeformed.empty(),
               is_directed  = is_displaced && !frames.empty();
    std::vector<LocalCoupling> couplings(interface.slave().faces.size());
    // empty where the normal does not turn
    std::vector<std::vector<Tensor<1, dim>>> turning(couplings.size());
    std::vector<NormalMoments>               normal_moments(couplings.size());
    for (unsigned int s = 0; s < frames.size() && !is_directed; ++s)
      if (are_unlike(frames[s]))
        turning[s] = in_functions(frames[s], interface.slave().traces[s]);
    FullMatrix<double> slave_values, master_values, weighted, positions, moment,
      of_direction;
    const unsigned int n_vectors = is_displaced ? 3 : 2;

    interface.integrate_pairs([&](const unsigned int       s,
                                  const unsigned int       m,
                                  const IntegrationPoints &points) {
      LocalCoupling         &local   = couplings[s];
      const FaceTrace       &slave   = interface.slave().traces[s];
      const FaceTrace       &master  = interface.master_traces()[m];
      const unsigned int     n_slave = slave.n_functions();
      LocalCoupling::Partner partner;
      partner.master = m;
      if (local.partners.empty())
        {
          local.mass.reinit(n_slave, n_slave);
          local.gap_moment.resize(n_slave);
          local.position_moment.resize(n_slave);
          if (is_displaced)
            local.undeformed_moment.resize(n_slave);
          for (auto &moments : normal_moments[s])
            moments.reinit(n_slave, n_slave);
          if (is_directed)
            {
              local.distance_moment.resize(n_slave);
              for (auto &of_component : local.directed)
                of_component.reinit(n_slave, n_slave);
            }
        }
      if (is_directed)
        for (auto &of_component : partner.directed)
          of_component.reinit(n_slave, master.n_functions());

      partner.mixed.reinit(n_slave, master.n_functions());
      if (with_master_mass)
        partner.mass.reinit(master.n_functions(), master.n_functions());
      moment.reinit(n_slave, n_vectors * dim);
      for (unsigned int first = 0; first < points.size(); first += max_points)
        {
          const unsigned int n =
            std::min<unsigned int>(max_points, points.size() - first);
          evaluate(slave.basis(), points.slave_xi, first, n, slave_values);
          evaluate(master.basis(), points.master_eta, first, n, master_values);
          scale_rows(slave_values, &points.weight[first], weighted);
          weighted.Tmmult(local.mass, slave_values, true);
          if (!turning[s].empty())
            add_normal_moments(turning[s],
                               slave_values,
                               weighted,
                               normal_moments[s]);
          weighted.Tmmult(partner.mixed, master_values, true);
          if (is_directed)
            {
              const auto d = directions(interface.slave().faces[s],
                                        interface.master_faces()[m],
                                        points,
                                        first,
                                        n);
              for (unsigned int c = 0; c < dim; ++c)
                {
                  scale_rows(weighted, d[c].data(), of_direction);
                  of_direction.Tmmult(local.directed[c], slave_values, true);
                  of_direction.Tmmult(partner.directed[c], master_values, true);
                }
              for (unsigned int q = 0; q < n; ++q)
                for (unsigned int i = 0; i < n_slave; ++i)
                  local.distance_moment[i] +=
                    weighted(q, i) * points.gap[first + q];
            }
          positions.reinit(n, n_vectors * dim, true);
          for (unsigned int q = 0; q < n; ++q)
            for (unsigned int c = 0; c < dim; ++c)
              {
                positions(q, c) =
                  points.master_x[c][first + q] - points.slave_x[c][first + q];
                positions(q, dim + c) = points.slave_x[c][first + q];
                if (is_displaced)
                  positions(q, 2 * dim + c) = points.undeformed_x[c][first + q];
              }
          weighted.Tmmult(moment, positions, true);
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
            if (is_displaced)
              local.undeformed_moment[i][c] += moment(i, 2 * dim + c);
          }
      local.partners.push_back(std::move(partner));
    });
    for (unsigned int s = 0; s < couplings.size(); ++s)
      if (LocalCoupling &local = couplings[s]; !local.partners.empty())
        {
          const FaceTrace &trace = interface.slave().traces[s];
          set_multipliers(trace,
                          basis == MultiplierBasis::dual &&
                            interface.coverage()[s] > covered_as_a_whole,
                          local);
          if (!turning[s].empty() && !local.is_dual())
            set_along_normals(interface.slave().faces[s],
                              trace,
                              frames[s],
                              normal_moments[s],
                              local);
          set_independent_masters(interface, s, may_be_independent, local);
        }
    return couplings;
  }
} // namespace mortise
