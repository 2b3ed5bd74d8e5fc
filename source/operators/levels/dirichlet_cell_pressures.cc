#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/operators/cells/element_schur.h>
#include <mortise/operators/levels/dirichlet_cell_pressures.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A cell of degree 4 takes 2 ms.
    constexpr unsigned int highest_degree = 4;

    /// The nodes of each face in the order of a batch, see CellBatches.
    std::vector<std::vector<unsigned int>>
    nodes_of_faces(const bool tetrahedra, const unsigned int degree)
    {
      std::vector<std::vector<unsigned int>> faces(tetrahedra ? 4 : 6);
      if (tetrahedra)
        {
          const auto nodes = simplex_nodes(degree);
          for (unsigned int i = 0; i < nodes.size(); ++i)
            {
              const auto lambda = barycentric_coordinates(nodes[i]);
              for (unsigned int v = 0; v < faces.size(); ++v)
                if (std::abs(lambda[v]) < 1e-10)
                  faces[v].push_back(i);
            }
          return faces;
        }
      const unsigned int n = degree + 1;
      for (unsigned int i = 0; i < n * n * n; ++i)
        {
          const unsigned int place[dim] = {i % n, i / n % n, i / (n * n)};
          for (unsigned int d = 0; d < dim; ++d)
            if (place[d] == 0 || place[d] == degree)
              faces[2 * d + (place[d] == 0 ? 0 : 1)].push_back(i);
        }
      return faces;
    }

    /// Schur complement less mass matrix of a cell. @p free: local
    /// displacements.
    FullMatrix<double>
    change_of_norm(const MatrixFreeElasticity<double>::CellMatrix &matrix,
                   const std::vector<unsigned int>                &free)
    {
      const unsigned int n_p = matrix.pressure_norm.m(),
                         n_u = matrix.mixed.m() - n_p;
      FullMatrix<double> K(n_u), G(n_p, n_u), C(n_p);
      K.fill(matrix.mixed, 0, 0, 0, 0);
      G.fill(matrix.mixed, 0, 0, n_u, 0);
      C.fill(matrix.mixed, 0, 0, n_u, n_u);
      FullMatrix<double> change = element_schur(K, G, free);
      change.add(-1., C, regular_part - 1., matrix.pressure_norm);
      return change;
    }
  } // namespace

  DirichletCellPressures::DirichletCellPressures(
    const MultigridLevel               &level,
    const MatrixFreeElasticity<double> &elasticity)
  {
    using BatchCell = MatrixFreeElasticity<double>::Cell;
    const LevelVector<double> constrained =
      constrained_components(level, level.layout);
    const auto &hanging = level.space->hanging_nodes();
    std::map<std::pair<bool, unsigned int>, // tetrahedra, degree
             std::vector<std::vector<unsigned int>>>
                      all_faces;
    std::vector<char> is_constrained; // in the last cell that was asked for
    const auto        is_clamped = [&](const BatchCell &cell) {
      if (cell.pressures.empty() || cell.batches.degree > highest_degree)
        return false;
      is_constrained.clear();
      for (const unsigned int index : cell.displacements)
        is_constrained.push_back(
          constrained.local_element(index) != 0. &&
          !hanging.is_constrained(level.layout->local_to_global(index) / dim));
      auto &faces = all_faces[{cell.batches.tetrahedra, cell.batches.degree}];
      if (faces.empty())
        faces = nodes_of_faces(cell.batches.tetrahedra, cell.batches.degree);
      return std::any_of(faces.begin(), faces.end(), [&](const auto &face) {
        return std::all_of(face.begin(), face.end(), [&](const auto i) {
          return is_constrained[dim * i] && is_constrained[dim * i + 1] &&
                 is_constrained[dim * i + 2];
        });
      });
    };
    elasticity.for_each_cell_matrix(
      is_clamped, [&](const BatchCell &cell, const auto &matrix) {
        std::vector<unsigned int> free;
        for (unsigned int k = 0; k < is_constrained.size(); ++k)
          if (!is_constrained[k])
            free.push_back(k);
        cells.push_back({cell.pressures, change_of_norm(matrix, free)});
      });
  }

  void
  DirichletCellPressures::add_product(const double *p, double *dst) const
  {
    for (const Cell &cell : cells)
      {
        const unsigned int n = cell.indices.size();
        for (unsigned int i = 0; i < n; ++i)
          {
            double sum = 0.;
            for (unsigned int j = 0; j < n; ++j)
              sum += cell.change(i, j) * p[cell.indices[j]];
            dst[cell.indices[i]] += sum;
          }
      }
  }
} // namespace mortise
