// See force_stiffness.h.
#include <mortise/interface/surface_evaluation.h>
#include <mortise/mortar/coupled_faces.h>
#include <mortise/mortar/force_stiffness.h>

#include <algorithm>
#include <array>

#include "constraint_columns.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The functions of both faces of a pair, the slave's first, in nodes.
    ExpansionList
    functions(const FaceTrace &slave, const FaceTrace &master)
    {
      ExpansionList result;
      for (const FaceTrace *side : {&slave, &master})
        {
          const NodalColumns columns(*side);
          const Expansion    nodes = columns.component();
          for (unsigned int k = 0; k < side->n_functions(); ++k)
            {
              for (unsigned int e = nodes.begin[k]; e < nodes.begin[k + 1]; ++e)
                result.add(nodes.index[e], nodes.weight[e]);
              result.close();
            }
        }
      return result;
    }

    /// The master at a point.
    struct Geometry
    {
      Tensor<1, dim>                nu; ///< into the slave's side
      std::array<Tensor<1, dim>, 2> dual;
      double                        curvature[2][2];
    };

    /// Step of difference quotients in reference coordinates.
    constexpr double step = 1e-4;

    Geometry
    geometry_at(const FacePolynomial &face, const Point<2> &eta)
    {
      // the point, and two on both sides of it
      Lanes at[2];
      for (unsigned int l = 0; l < n_lanes; ++l)
        {
          at[0][l] = eta[0] + (l == 1 ? step : l == 2 ? -step : 0.);
          at[1][l] = eta[1] + (l == 3 ? step : l == 4 ? -step : 0.);
        }
      Vec3<Lanes> x, dx[2];
      face.evaluate(at[0], at[1], x, dx);
      std::array<Tensor<1, dim>, 2>                tangents;
      std::array<std::array<Tensor<1, dim>, 2>, 2> second;
      for (unsigned int a = 0; a < 2; ++a)
        for (unsigned int c = 0; c < dim; ++c)
          {
            tangents[a][c] = dx[a][c][0];
            for (unsigned int b = 0; b < 2; ++b)
              second[a][b][c] =
                (dx[a][c][1 + 2 * b] - dx[a][c][2 + 2 * b]) / (2. * step);
          }
      Geometry result;
      result.nu = cross_product_3d(tangents[0], tangents[1]);
      result.nu /= result.nu.norm();
      const double a = tangents[0] * tangents[0], b = tangents[0] * tangents[1],
                   c = tangents[1] * tangents[1], det = a * c - b * b;
      result.dual = {{(c * tangents[0] - b * tangents[1]) / det,
                      (a * tangents[1] - b * tangents[0]) / det}};
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          result.curvature[i][j] = result.nu * second[i][j];
      return result;
    }

    /// Of a slave face, by node.
    struct NodalTractions
    {
      std::vector<double> pressure;
      /// Tangential ones; empty without friction.
      std::vector<Tensor<1, dim>> across;

      bool
      any() const
      {
        return std::any_of(pressure.begin(),
                           pressure.end(),
                           [](const double p) { return p != 0.; });
      }
    };

    /// Adds up the matrix of one pair of faces.
    class OfPair
    {
    public:
      OfPair(const SurfaceFace    &slave_face,
             const FaceTrace      &slave,
             const SurfaceFace    &master_face,
             const FaceTrace      &master,
             const LocalCoupling  &local,
             const NodalTractions &tractions)
        : slave_face(slave_face)
        , slave(slave)
        , master(master)
        , local(local)
        , tractions(tractions)
      {
        polynomial.reinit(master_face, master_face.frame.center);
      }

      FullMatrix<double>
      operator()(const IntegrationPoints &points)
      {
        const unsigned int n_s = slave.n_functions(),
                           n_m = master.n_functions(), n_q = points.size();
        FullMatrix<double> of_slave(n_q, n_s), of_master(n_q, n_m);
        std::array<FullMatrix<double>, 2> slopes{{of_master, of_master}};
        for (unsigned int q = 0; q < n_q; ++q)
          {
            slave.basis().evaluate(points.slave_xi[0][q],
                                   points.slave_xi[1][q],
                                   &of_slave(q, 0));
            const Point<2> eta(points.master_eta[0][q],
                               points.master_eta[1][q]);
            master.basis().evaluate(eta[0], eta[1], &of_master(q, 0));
            set_slopes(eta, q, slopes);
          }
        std::vector<double>         pressures(n_q);
        std::vector<Tensor<1, dim>> across(n_q);
        for (unsigned int q = 0; q < n_q; ++q)
          add_tractions(&of_slave(q, 0), pressures[q], across[q]);

        of_slave  = NodalColumns(slave).in_columns(of_slave);
        of_master = NodalColumns(master).in_columns(of_master);
        for (auto &of_direction : slopes)
          of_direction = NodalColumns(master).in_columns(of_direction);
        const unsigned int n_f = n_s + n_m, n = dim * n_f;
        // T_a and f (V_a + k_ab T_b / 2) at each point; with the traction
        // across the normal what is multiplied with T_a and with the normal
        // motion, too
        FullMatrix<double> T(2 * n_q, n), others(2 * n_q, n), result(n, n);
        const bool         has_friction = !tractions.across.empty();
        FullMatrix<double> left(has_friction ? 3 * n_q : 0, n), right(left);
        std::array<std::vector<double>, 2> of_normal; // V_a + k_ab T_b
        for (auto &row : of_normal)
          row.resize(n);
        for (unsigned int q = 0; q < n_q; ++q)
          {
            const Point<2> xi(points.slave_xi[0][q], points.slave_xi[1][q]);
            const Tensor<1, dim> normal = averaged_normal(slave_face, xi);
            Geometry             at =
              geometry_at(polynomial,
                          {points.master_eta[0][q], points.master_eta[1][q]});
            if (at.nu * normal < 0.)
              {
                at.nu *= -1.;
                for (auto &row : at.curvature)
                  for (double &entry : row)
                    entry *= -1.;
              }
            const double factor = -pressures[q] * points.weight[q] *
                                  normal.norm() / (at.nu * normal);
            // points move along the slave's normal
            for (Tensor<1, dim> &dual : at.dual)
              dual -= (dual * normal) / (at.nu * normal) * at.nu;
            for (unsigned int a = 0; a < 2; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                {
                  for (unsigned int k = 0; k < n_s; ++k)
                    T(2 * q + a, c * n_f + k) = at.dual[a][c] * of_slave(q, k);
                  for (unsigned int k = 0; k < n_m; ++k)
                    T(2 * q + a, c * n_f + n_s + k) =
                      -at.dual[a][c] * of_master(q, k);
                }
            const double *T_0 = &T(2 * q, 0), *T_1 = &T(2 * q + 1, 0);
            for (unsigned int a = 0; a < 2; ++a)
              {
                const double k_0 = at.curvature[a][0], k_1 = at.curvature[a][1];
                for (unsigned int j = 0; j < n; ++j)
                  {
                    of_normal[a][j]      = k_0 * T_0[j] + k_1 * T_1[j];
                    others(2 * q + a, j) = 0.5 * factor * of_normal[a][j];
                  }
                for (unsigned int c = 0; c < dim; ++c)
                  for (unsigned int k = 0; k < n_m; ++k)
                    {
                      const unsigned int j     = c * n_f + n_s + k;
                      const double       slope = at.nu[c] * slopes[a](q, k);
                      of_normal[a][j] += slope;
                      others(2 * q + a, j) += factor * slope;
                    }
              }
            if (!has_friction)
              continue;
            // the master's points move below the traction, and it turns with
            // the master
            const double weight = points.weight[q];
            for (unsigned int a = 0; a < 2; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int k = 0; k < n_m; ++k)
                  left(3 * q + a, c * n_f + n_s + k) =
                    across[q][c] * slopes[a](q, k);
            for (unsigned int c = 0; c < dim; ++c)
              {
                for (unsigned int k = 0; k < n_s; ++k)
                  left(3 * q + 2, c * n_f + k) = at.nu[c] * of_slave(q, k);
                for (unsigned int k = 0; k < n_m; ++k)
                  left(3 * q + 2, c * n_f + n_s + k) =
                    -at.nu[c] * of_master(q, k);
              }
            const double along[] = {weight * (across[q] * at.dual[0]),
                                    weight * (across[q] * at.dual[1])};
            for (unsigned int j = 0; j < n; ++j)
              {
                right(3 * q, j)     = -weight * T_0[j];
                right(3 * q + 1, j) = -weight * T_1[j];
                right(3 * q + 2, j) =
                  along[0] * of_normal[0][j] + along[1] * of_normal[1][j];
              }
          }
        T.Tmmult(result, others);
        result.symmetrize();
        result *= 2.;
        if (has_friction)
          left.Tmmult(result, right, true);
        return result;
      }

    private:
      void
      set_slopes(const Point<2>                    &eta,
                 const unsigned int                 q,
                 std::array<FullMatrix<double>, 2> &slopes)
      {
        std::vector<double> ahead(master.n_functions()), behind(ahead);
        for (unsigned int a = 0; a < 2; ++a)
          {
            Point<2> there(eta), back(eta);
            there[a] += step;
            back[a] -= step;
            master.basis().evaluate(there[0], there[1], ahead.data());
            master.basis().evaluate(back[0], back[1], behind.data());
            for (unsigned int k = 0; k < ahead.size(); ++k)
              slopes[a](q, k) = (ahead[k] - behind[k]) / (2. * step);
          }
      }

      /// From the values of the slave's functions.
      void
      add_tractions(const double   *values,
                    double         &pressure,
                    Tensor<1, dim> &across) const
      {
        const unsigned int n = slave.n_functions();
        for (unsigned int i = 0; i < n; ++i)
          {
            double psi = 0.;
            for (unsigned int j = 0; j < n; ++j)
              psi += local.multiplier(i, j) * values[j];
            pressure += psi * tractions.pressure[i];
            if (!tractions.across.empty())
              across += psi * tractions.across[i];
          }
      }

      const SurfaceFace    &slave_face;
      const FaceTrace      &slave, &master;
      const LocalCoupling  &local;
      const NodalTractions &tractions;
      FacePolynomial        polynomial;
    };
  } // namespace

  namespace
  {
    /// By slave face; empty where the coupling does not follow the bodies.
    std::vector<NodalTractions>
    nodal_tractions(const Coupling &coupling,
                    const Vector   &multiplier,
                    const MPI_Comm  comm)
    {
      std::vector<NodalTractions> result;
      if (!coupling.is_directed())
        return result;
      const auto by_row       = values_by_row(coupling, multiplier, comm);
      const bool has_friction = coupling.law.has_friction();
      for (unsigned int s = 0; s < by_row.size(); ++s)
        {
          NodalTractions &of_face = result.emplace_back();
          if (!has_friction)
            {
              of_face.pressure = by_row[s];
              continue;
            }
          const auto        &frames = coupling.frames[s];
          const unsigned int n      = frames.size();
          of_face.across.resize(n);
          for (unsigned int r = 0; r < by_row[s].size(); ++r)
            of_face.across[r % n][r / n] = by_row[s][r];
          for (unsigned int k = 0; k < n; ++k)
            {
              const Tensor<1, dim> &normal = frames[k][0];
              of_face.pressure.push_back(of_face.across[k] * normal);
              of_face.across[k] -= of_face.pressure[k] * normal;
            }
        }
      return result;
    }
  } // namespace

  SparseMatrix
  force_stiffness(const std::vector<Coupling> &couplings,
                  const Vector                &multiplier,
                  const IndexSet              &owned_displacement,
                  const MPI_Comm               comm)
  {
    RowAssembler assembler(owned_displacement, owned_displacement, dim);
    std::vector<std::vector<NodalTractions>> tractions;
    for (const Coupling &coupling : couplings)
      {
        tractions.push_back(nodal_tractions(coupling, multiplier, comm));
        const InterfaceHandler &interface = *coupling.interface;
        for (unsigned int s = 0; s < tractions.back().size(); ++s)
          if (tractions.back()[s].any())
            for (const auto &partner : coupling.local[s].partners)
              {
                const ExpansionList all =
                  functions(interface.slave().traces[s],
                            interface.master_traces()[partner.master]);
                assembler.record(all(), all.size(), all(), all.size());
              }
      }
    assembler.allocate();
    for (unsigned int i = 0; i < couplings.size(); ++i)
      if (couplings[i].is_directed())
        {
          const InterfaceHandler &interface = *couplings[i].interface;
          const std::vector<NodalTractions> &of_slaves = tractions[i];
          interface.visit_pairs_for_tangents(
            [&](const unsigned int s) { return of_slaves[s].any(); },
            [&](const unsigned int       s,
                const unsigned int       m,
                const IntegrationPoints &points) {
              const auto &partners = couplings[i].local[s].partners;
              if (std::none_of(partners.begin(),
                               partners.end(),
                               [m](const auto &of) { return of.master == m; }))
                return;
              const FaceTrace &slave  = interface.slave().traces[s],
                              &master = interface.master_traces()[m];
              OfPair              of_pair(interface.slave().faces[s],
                             slave,
                             interface.master_faces()[m],
                             master,
                             couplings[i].local[s],
                             of_slaves[s]);
              const ExpansionList all = functions(slave, master);
              assembler.add(all(), all(), of_pair(points), 1., false);
            });
        }
    return assembler.create(comm);
  }
} // namespace mortise
