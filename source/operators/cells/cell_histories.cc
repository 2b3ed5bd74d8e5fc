#include <deal.II/base/mpi.h>
#include <deal.II/base/polynomial.h>

#include <deal.II/grid/grid_tools.h>

#include <Teuchos_BLAS.hpp>
#include <mortise/material/nonlinear_law.h>
#include <mortise/operators/cells/cell_histories.h>
#include <mortise/operators/matrix_free/cell_batches.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  bool
  has_history(const Body &body)
  {
    const auto &law = body.material.nonlinear();
    return law && law->n_history() > 0;
  }

  void
  update_ghosts(const Body &body, CellHistories &histories)
  {
    using Numbers             = std::vector<double>;
    const auto &triangulation = body.triangulation();
    histories.resize(triangulation.n_active_cells());
    if (Utilities::MPI::n_mpi_processes(triangulation.get_communicator()) > 1)
      GridTools::exchange_cell_data_to_ghosts<Numbers, Triangulation<dim>>(
        triangulation,
        [&](const auto &cell) { return histories[cell->active_cell_index()]; },
        [&](const auto &cell, const Numbers &received) {
          histories[cell->active_cell_index()] = received;
        });
  }

  Quadrature<dim>
  points_of_forces(const Body &body, const unsigned int element)
  {
    return cell_rule<double>(body, element, body.fe[element].degree);
  }

  namespace
  {
    /// Products of Legendre polynomials up to @p degree in each direction, or in
    /// all on tetrahedra, at @p points: entry (point, function).
    FullMatrix<double>
    polynomials(const std::vector<Point<dim>> &points,
                const unsigned int             degree,
                const bool                     tetrahedra)
    {
      const auto legendre =
        Polynomials::Legendre::generate_complete_basis(degree);
      std::vector<std::array<unsigned int, dim>> functions;
      for (unsigned int i = 0; i <= degree; ++i)
        for (unsigned int j = 0; j <= degree; ++j)
          for (unsigned int k = 0; k <= degree; ++k)
            if (!tetrahedra || i + j + k <= degree)
              functions.push_back({{i, j, k}});
      FullMatrix<double> result(points.size(), functions.size());
      for (unsigned int q = 0; q < points.size(); ++q)
        for (unsigned int f = 0; f < functions.size(); ++f)
          {
            result(q, f) = 1.;
            for (unsigned int d = 0; d < dim; ++d)
              result(q, f) *= legendre[functions[f][d]].value(points[q][d]);
          }
      return result;
    }
  } // namespace

  FullMatrix<double>
  HistoryValues::projection(const unsigned int element) const
  {
    const Quadrature<dim> from = points_of_forces(body, element);
    const unsigned int    degree =
      std::max(1u, static_cast<unsigned int>(body.fe[element].degree) - 1);
    const FullMatrix<double> there =
      polynomials(from.get_points(), degree, body.mesh.tetrahedra);
    const FullMatrix<double> here =
      polynomials(rule.get_points(), degree, body.mesh.tetrahedra);
    FullMatrix<double> weighted(there), mass(there.n()),
      coefficients(there.n(), there.m()), result(here.m(), there.m());
    for (unsigned int q = 0; q < there.m(); ++q)
      for (unsigned int f = 0; f < there.n(); ++f)
        weighted(q, f) *= from.weight(q);
    there.Tmmult(mass, weighted);
    mass.gauss_jordan();
    mass.mTmult(coefficients, weighted);
    here.mmult(result, coefficients);
    return result;
  }

  std::vector<double>
  HistoryValues::evaluate(const Body::CellIterator  &cell,
                          const std::vector<double> &history)
  {
    const unsigned int element = cell->active_fe_index();
    auto               found   = by_element.find(element);
    if (found == by_element.end())
      found = by_element.emplace(element, projection(element)).first;
    const FullMatrix<double> &matrix = found->second;
    const int                 n_here = matrix.m(), n_there = matrix.n();
    const int                 n = history.size() / n_there;
    std::vector<double>       result(n_here * n);
    if (std::all_of(history.begin(), history.end(), [](const double value) {
          return value == 0.;
        }))
      return result; // nothing has happened there
    Teuchos::BLAS<int, double>().GEMM(Teuchos::NO_TRANS,
                                      Teuchos::NO_TRANS,
                                      n,
                                      n_here,
                                      n_there,
                                      1.,
                                      history.data(),
                                      n,
                                      &matrix(0, 0),
                                      n_there,
                                      0.,
                                      result.data(),
                                      n);
    return result;
  }
} // namespace mortise
