#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/operators/cells/cell_kernel.h>
#include <mortise/operators/cells/element_schur.h>
#include <mortise/operators/cells/pressure_kernel.h>
#include <mortise/operators/levels/clamped_cell_pressures.h>

#include <algorithm>
#include <map>
#include <memory>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A cell of degree 4 takes 4 ms, one of degree 6 40 ms.
    constexpr unsigned int highest_degree = 4;

    /// 1 at constrained components, ghosts included.
    LevelVector<double>
    constrained_components(const NodalLevel &level)
    {
      LevelVector<double> constrained(level.layout);
      for (const unsigned int index : level.constrained)
        constrained.local_element(index) = 1.;
      constrained.update_ghost_values();
      return constrained;
    }

    /// What the cells of one body share.
    struct ClampedCellKernel
    {
      ClampedCellKernel(const Body &body, const unsigned int degree)
        : system(FE_Q<dim>(degree), dim)
        , stiffness(body, system)
        , pressure(body, system, FE_Q<dim>(degree - 1))
        , K(system.n_dofs_per_cell())
      {
        for (const unsigned int f : GeometryInfo<dim>::face_indices())
          faces.push_back(face_dof_indices(degree, f));
      }

      FESystem<dim>                          system;
      CellKernel                             stiffness;
      PressureKernel                         pressure;
      FullMatrix<double>                     K;
      std::vector<std::vector<unsigned int>> faces; ///< nodes of each
    };

    /// What takes the place of the mass matrix, less this.
    FullMatrix<double>
    change_of_norm(ClampedCellKernel               &kernel,
                   const Body                      &body,
                   const Body::CellIterator        &cell,
                   const std::vector<unsigned int> &free)
    {
      kernel.stiffness.compute(cell, kernel.K);
      kernel.pressure.compute(cell);
      FullMatrix<double> schur =
        element_schur(kernel.K, kernel.pressure.divergence(), free);
      schur.add(body.material.compressibility() -
                  (1. - regular_part) * body.material.pressure_norm(),
                kernel.pressure.mass());
      return schur;
    }
  } // namespace

  ClampedCellPressures::ClampedCellPressures(const NodalLevel    &level,
                                             const NodalPressure &pressures)
  {
    const LevelVector<double>      constrained = constrained_components(level);
    const PressureNodes            nodes       = pressures.nodes();
    std::vector<NodalSpace::Index> of_pressure;
    std::map<std::pair<unsigned int, unsigned int>,
             std::unique_ptr<ClampedCellKernel>>
                              kernels; // by body and degree
    std::vector<char>         is_constrained;
    std::vector<unsigned int> free;
    level.space->for_each_cell(
      [&](const Body &body, const auto &cell, const auto &of_cell) {
        const unsigned int degree = level.space->degree(body, cell);
        if (!body.pressure || degree > highest_degree)
          return;
        auto &kernel = kernels[{body.index, degree}];
        if (!kernel)
          kernel = std::make_unique<ClampedCellKernel>(body, degree);
        is_constrained.resize(dim * of_cell.size());
        for (unsigned int i = 0; i < of_cell.size(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            is_constrained[dim * i + c] =
              constrained.local_element(
                level.layout->global_to_local(dim * of_cell[i] + c)) != 0. &&
              !level.space->hanging_nodes().is_constrained(of_cell[i]);
        const auto whole = [&](const auto &face) {
          return std::all_of(face.begin(), face.end(), [&](const auto i) {
            return is_constrained[dim * i] && is_constrained[dim * i + 1] &&
                   is_constrained[dim * i + 2];
          });
        };
        if (std::none_of(kernel->faces.begin(), kernel->faces.end(), whole))
          return;
        free.clear();
        for (unsigned int k = 0; k < kernel->K.m(); ++k)
          {
            const auto [c, i] = kernel->system.system_to_component_index(k);
            if (!is_constrained[dim * i + c])
              free.push_back(k);
          }
        cells.push_back({{}, change_of_norm(*kernel, body, cell, free)});
        nodes.space.get_nodes(body.index, cell, of_pressure);
        for (const auto node : of_pressure)
          cells.back().indices.push_back(nodes.layout.global_to_local(node));
      });
  }

  void
  ClampedCellPressures::add_product(const double *p, double *dst) const
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

  void
  ClampedCellPressures::add_diagonal(double *dst) const
  {
    for (const Cell &cell : cells)
      for (unsigned int i = 0; i < cell.indices.size(); ++i)
        dst[cell.indices[i]] += cell.change(i, i);
  }
} // namespace mortise
