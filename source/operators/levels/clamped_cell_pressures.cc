#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/elements/simplex_nodes.h>
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

    /// With rows and columns from the modes of @p element, of tetrahedra, to values at its nodes.
    FullMatrix<double>
    modes_at_nodes(const FE_SimplexLegendre &element)
    {
      const auto  order = ascending_dof_indices(element.degree, element.order);
      const auto &ascending = simplex_nodes_to_modes(element.degree);
      FullMatrix<double> result(order.size());
      for (unsigned int i = 0; i < order.size(); ++i)
        for (unsigned int k = 0; k < order.size(); ++k)
          result(order[i], order[k]) = ascending(i, k);
      return result;
    }

    /// What the cells of one body with one element share: functions are those of
    /// nodes, in the order of NodalSpace::get_nodes().
    class ClampedCellKernel
    {
    public:
      ClampedCellKernel(const Body               &body,
                        const FiniteElement<dim> &element,
                        const unsigned int        degree)
        : system(make_system(element, degree))
        , stiffness(body, *system)
        , pressure(body, *system, *make_pressure(element, degree))
      {
        K.reinit(system->n_dofs_per_cell(), system->n_dofs_per_cell());
        if (element.reference_cell() == ReferenceCells::Hexahedron)
          for (const unsigned int f : GeometryInfo<dim>::face_indices())
            faces.push_back(face_dof_indices(degree, f));
        else
          {
            const FE_SimplexLegendre own(degree, order_of(element)),
              of_pressure(degree - 1, order_of(element));
            for (unsigned int f = 0; f < 4; ++f)
              faces.push_back(trace_dof_indices(own, f));
            to_modes          = by_component(modes_at_nodes(own));
            pressure_to_modes = modes_at_nodes(of_pressure);
          }
      }

      void
      compute(const Body::CellIterator &cell)
      {
        stiffness.compute(cell, K);
        pressure.compute(cell);
        G = pressure.divergence();
        M = pressure.mass();
        if (to_modes.m() == 0)
          return;
        K = product(to_modes, K, to_modes);
        G = product(pressure_to_modes, G, to_modes);
        M = product(pressure_to_modes, M, pressure_to_modes);
      }

      std::pair<unsigned int, unsigned int>
      component_and_node(const unsigned int k) const
      {
        return system->system_to_component_index(k);
      }

      std::vector<std::vector<unsigned int>> faces;   ///< nodes of each
      FullMatrix<double>                     K, G, M; ///< see PressureKernel

    private:

      static const VertexOrder &
      order_of(const FiniteElement<dim> &element)
      {
        return SimplexElements::base(element).order;
      }

      static std::unique_ptr<FiniteElement<dim>>
      make_system(const FiniteElement<dim> &element, const unsigned int degree)
      {
        if (element.reference_cell() == ReferenceCells::Hexahedron)
          return std::make_unique<FESystem<dim>>(FE_Q<dim>(degree), dim);
        return make_simplex_system(FE_SimplexLegendre(degree,
                                                      order_of(element)),
                                   dim);
      }

      static std::unique_ptr<FiniteElement<dim>>
      make_pressure(const FiniteElement<dim> &element,
                    const unsigned int        degree)
      {
        if (element.reference_cell() == ReferenceCells::Hexahedron)
          return std::make_unique<FE_Q<dim>>(degree - 1);
        return std::make_unique<FE_SimplexLegendre>(degree - 1,
                                                    order_of(element));
      }

      /// @p scalar for the three components of the system.
      FullMatrix<double>
      by_component(const FullMatrix<double> &scalar) const
      {
        FullMatrix<double> result(dim * scalar.m());
        for (unsigned int i = 0; i < scalar.m(); ++i)
          for (unsigned int k = 0; k < scalar.n(); ++k)
            for (unsigned int c = 0; c < dim; ++c)
              result(system->component_to_system_index(c, i),
                     system->component_to_system_index(c, k)) = scalar(i, k);
        return result;
      }

      /// left^T A right.
      static FullMatrix<double>
      product(const FullMatrix<double> &left,
              const FullMatrix<double> &A,
              const FullMatrix<double> &right)
      {
        FullMatrix<double> half(A.m(), right.n()), result(left.n(), right.n());
        A.mmult(half, right);
        left.Tmmult(result, half);
        return result;
      }

      const std::unique_ptr<FiniteElement<dim>> system;
      CellKernel                                stiffness;
      PressureKernel                            pressure;
      /// Of tetrahedra, whose kernels are those of modes.
      FullMatrix<double> to_modes, pressure_to_modes;
    };

    /// What takes the place of the mass matrix, less this.
    FullMatrix<double>
    change_of_norm(ClampedCellKernel               &kernel,
                   const Body                      &body,
                   const Body::CellIterator        &cell,
                   const std::vector<unsigned int> &free)
    {
      kernel.compute(cell);
      FullMatrix<double> schur = element_schur(kernel.K, kernel.G, free);
      schur.add(body.material.compressibility() -
                  (1. - regular_part) * body.material.pressure_norm(),
                kernel.M);
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
                              kernels; // by body and element
    std::vector<char>         is_constrained;
    std::vector<unsigned int> free;
    level.space->for_each_cell(
      [&](const Body &body, const auto &cell, const auto &of_cell) {
        const unsigned int degree = level.space->degree(body, cell);
        if (!body.pressure || degree > highest_degree)
          return;
        auto &kernel = kernels[{body.index, cell->active_fe_index()}];
        if (!kernel)
          kernel =
            std::make_unique<ClampedCellKernel>(body, cell->get_fe(), degree);
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
            const auto [c, i] = kernel->component_and_node(k);
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
