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
        // V_1, V_2, T_1, T_2 at each point, and what each is multiplied with
        FullMatrix<double> rows(4 * n_q, n), others(4 * n_q, n), result(n, n);
        std::vector<Geometry> geometry;
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
            geometry.push_back(at);
            for (unsigned int a = 0; a < 2; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                {
                  for (unsigned int k = 0; k < n_s; ++k)
                    rows(4 * q + 2 + a, c * n_f + k) =
                      at.dual[a][c] * of_slave(q, k);
                  for (unsigned int k = 0; k < n_m; ++k)
                    {
                      const unsigned int j   = c * n_f + n_s + k;
                      rows(4 * q + a, j)     = at.nu[c] * slopes[a](q, k);
                      rows(4 * q + 2 + a, j) = -at.dual[a][c] * of_master(q, k);
                    }
                }
            for (unsigned int a = 0; a < 2; ++a)
              for (unsigned int j = 0; j < n; ++j)
                {
                  others(4 * q + a, j) = factor * rows(4 * q + 2 + a, j);
                  double sum           = rows(4 * q + a, j);
                  for (unsigned int b = 0; b < 2; ++b)
                    sum += at.curvature[a][b] * rows(4 * q + 2 + b, j);
                  others(4 * q + 2 + a, j) = factor * sum;
                }
          }
        rows.Tmmult(result, others);
        if (!tractions.across.empty())
          {
            for (unsigned int q = 0; q < n_q; ++q)
              {
                std::vector<double> normal_motion(n);
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    for (unsigned int k = 0; k < n_s; ++k)
                      normal_motion[c * n_f + k] =
                        geometry[q].nu[c] * of_slave(q, k);
                    for (unsigned int k = 0; k < n_m; ++k)
                      normal_motion[c * n_f + n_s + k] =
                        -geometry[q].nu[c] * of_master(q, k);
                  }
                turn_to_friction(points.weight[q],
                                 across[q],
                                 geometry[q],
                                 normal_motion,
                                 &rows(4 * q, 0),
                                 &others(4 * q, 0));
                for (unsigned int a = 0; a < 2; ++a)
                  for (unsigned int c = 0; c < dim; ++c)
                    for (unsigned int k = 0; k < n_m; ++k)
                      rows(4 * q + a, c * n_f + n_s + k) =
                        across[q][c] * slopes[a](q, k);
              }
            rows.Tmmult(result, others, true);
          }
        return result;
      }

    private:
      /// From the four rows of a point for pressures to those for the traction
      /// @p across: the master's points move below it, and it turns with the
      /// master. @p rows and @p others: n entries each.
      static void
      turn_to_friction(const double               weight,
                       const Tensor<1, dim>      &across,
                       const Geometry            &at,
                       const std::vector<double> &normal_motion,
                       double                    *rows,
                       double                    *others)
      {
        const unsigned int n = normal_motion.size();
        for (unsigned int j = 0; j < n; ++j)
          {
            double turn = 0.;
            for (unsigned int a = 0; a < 2; ++a)
              {
                double sum = rows[a * n + j];
                for (unsigned int b = 0; b < 2; ++b)
                  sum += at.curvature[a][b] * rows[(2 + b) * n + j];
                turn += (across * at.dual[a]) * sum;
              }
            for (unsigned int a = 0; a < 2; ++a)
              {
                others[a * n + j] = -weight * rows[(2 + a) * n + j];
                rows[a * n + j]   = 0.; // the caller knows the slopes
              }
            rows[2 * n + j]   = normal_motion[j];
            others[2 * n + j] = weight * turn;
            rows[3 * n + j] = others[3 * n + j] = 0.;
          }
      }

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
          interface.visit_pairs([&](const unsigned int       s,
                                    const unsigned int       m,
                                    const IntegrationPoints &points) {
            if (!tractions[i][s].any())
              return;
            const FaceTrace &slave  = interface.slave().traces[s],
                            &master = interface.master_traces()[m];
            OfPair              of_pair(interface.slave().faces[s],
                           slave,
                           interface.master_faces()[m],
                           master,
                           couplings[i].local[s],
                           tractions[i][s]);
            const ExpansionList all = functions(slave, master);
            assembler.add(all(), all(), of_pair(points), 1., false);
          });
        }
    return assembler.create(comm);
  }
} // namespace mortise
