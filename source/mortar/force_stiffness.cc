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
    /// The displacements of both faces of a pair: slave first, by component.
    ExpansionList
    displacements(const FaceTrace &slave, const FaceTrace &master)
    {
      ExpansionList result;
      for (const FaceTrace *side : {&slave, &master})
        {
          const NodalColumns columns(*side);
          const Expansion    nodes = columns.component();
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int k = 0; k < side->n_functions(); ++k)
              {
                for (unsigned int e = nodes.begin[k]; e < nodes.begin[k + 1];
                     ++e)
                  result.add(dim * nodes.index[e] + c, nodes.weight[e]);
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

    /// Adds up the matrix of one pair of faces.
    class OfPair
    {
    public:
      OfPair(const SurfaceFace         &slave_face,
             const FaceTrace           &slave,
             const SurfaceFace         &master_face,
             const FaceTrace           &master,
             const LocalCoupling       &local,
             const std::vector<double> &coefficients)
        : slave_face(slave_face)
        , slave(slave)
        , master(master)
        , local(local)
        , coefficients(coefficients)
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
        std::vector<double> pressures(n_q);
        for (unsigned int q = 0; q < n_q; ++q)
          pressures[q] = pressure(&of_slave(q, 0));

        of_slave  = NodalColumns(slave).in_columns(of_slave);
        of_master = NodalColumns(master).in_columns(of_master);
        for (auto &of_direction : slopes)
          of_direction = NodalColumns(master).in_columns(of_direction);
        const unsigned int n = dim * (n_s + n_m);
        // V_1, V_2, T_1, T_2 at each point, and what each is multiplied with
        FullMatrix<double> rows(4 * n_q, n), others(4 * n_q, n), result(n, n);
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
                    rows(4 * q + 2 + a, c * n_s + k) =
                      at.dual[a][c] * of_slave(q, k);
                  for (unsigned int k = 0; k < n_m; ++k)
                    {
                      const unsigned int j   = dim * n_s + c * n_m + k;
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

      /// Of the slave's functions @p values.
      double
      pressure(const double *values) const
      {
        const unsigned int n      = slave.n_functions();
        double             result = 0.;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            result += coefficients[i] * local.multiplier(i, j) * values[j];
        return result;
      }

      const SurfaceFace         &slave_face;
      const FaceTrace           &slave, &master;
      const LocalCoupling       &local;
      const std::vector<double> &coefficients;
      FacePolynomial             polynomial;
    };
  } // namespace

  namespace
  {
    /// By slave face and node.
    std::vector<std::vector<double>>
    pressures(const Coupling &coupling,
              const Vector   &multiplier,
              const MPI_Comm  comm)
    {
      auto result = values_by_row(coupling, multiplier, comm);
      if (!coupling.law.has_friction())
        return result;
      for (unsigned int s = 0; s < result.size(); ++s)
        {
          const unsigned int  n = coupling.frames[s].size();
          std::vector<double> of_nodes(n, 0.);
          for (unsigned int r = 0; r < result[s].size(); ++r)
            of_nodes[r % n] += result[s][r] * coupling.frames[s][r % n][0][r / n];
          result[s] = of_nodes;
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
    RowAssembler assembler(owned_displacement, owned_displacement);
    std::vector<std::vector<std::vector<double>>> coefficients;
    const auto is_loaded = [](const std::vector<double> &of_face) {
      return std::any_of(of_face.begin(), of_face.end(), [](const double p) {
        return p != 0.;
      });
    };
    for (const Coupling &coupling : couplings)
      {
        coefficients.emplace_back();
        if (!coupling.is_directed())
          continue;
        coefficients.back() = pressures(coupling, multiplier, comm);
        const InterfaceHandler &interface = *coupling.interface;
        for (unsigned int s = 0; s < coupling.local.size(); ++s)
          if (is_loaded(coefficients.back()[s]))
            for (const auto &partner : coupling.local[s].partners)
              {
                const ExpansionList all =
                  displacements(interface.slave().traces[s],
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
            if (!is_loaded(coefficients[i][s]))
              return;
            const FaceTrace &slave  = interface.slave().traces[s],
                            &master = interface.master_traces()[m];
            OfPair              of_pair(interface.slave().faces[s],
                           slave,
                           interface.master_faces()[m],
                           master,
                           couplings[i].local[s],
                           coefficients[i][s]);
            const ExpansionList all = displacements(slave, master);
            assembler.add(all(), all(), of_pair(points), 1., false);
          });
        }
    return assembler.create(comm);
  }
} // namespace mortise
