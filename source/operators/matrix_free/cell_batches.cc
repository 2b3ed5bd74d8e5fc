#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_tools.h>

#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/operators/cells/cell_geometry.h>
#include <mortise/operators/matrix_free/cell_batches.h>
#include <mortise/operators/matrix_free/simplex_tables.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  template <typename Number>
  Quadrature<dim>
  cell_rule(const Body        &body,
            const unsigned int element,
            const unsigned int degree)
  {
    if (!body.mesh.tetrahedra)
      return QGauss<dim>(degree + 1);
    const auto           &order = SimplexElements::base(body.fe[element]).order;
    const Quadrature<dim> rule  = simplex_rule<Number>(degree);
    std::vector<Point<dim>> points;
    for (const Point<dim> &ascending : rule.get_points())
      {
        const auto                  lambda = barycentric_coordinates(ascending);
        std::array<double, dim + 1> local{};
        for (unsigned int v = 0; v <= dim; ++v)
          local[order[v]] = lambda[v];
        points.emplace_back(local[1], local[2], local[3]);
      }
    return {points, rule.get_weights()};
  }

  template Quadrature<dim>
  cell_rule<float>(const Body &, unsigned int, unsigned int);
  template Quadrature<dim>
  cell_rule<double>(const Body &, unsigned int, unsigned int);

  namespace
  {
    /// Owned cells with one element of the body, those with constant Jacobians
    /// first.
    struct SortedCells
    {
      SortedCells(const Body         &body,
                  const unsigned int  element,
                  const CellGeometry &geometry,
                  const bool          all_curved)
      {
        std::vector<Body::CellIterator> curved;
        for (const auto &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned() && cell->active_fe_index() == element)
            (!all_curved && geometry.constant_jacobian(cell) ? all : curved)
              .push_back(cell);
        n_affine = all.size();
        all.insert(all.end(), curved.begin(), curved.end());
      }

      std::vector<Body::CellIterator> all;
      unsigned int                    n_affine;
    };

    /// Fills the batches of one body's cells with one element.
    template <typename Number>
    class BatchBuilder
    {
    public:
      static constexpr unsigned int width = Batch<Number>::size;

      BatchBuilder(const NodalSpace                  &space,
                   const Body                        &body,
                   const unsigned int                 element,
                   const Utilities::MPI::Partitioner &layout,
                   const PressureNodes               *pressures)
        : space(space)
        , body(body)
        , element(element)
        , layout(layout)
        , pressures(body.pressure ? pressures : nullptr)
        , degree(space.degree(body, body.fe[element].degree))
        , axes(make_axes())
        , quadrature(cell_rule<Number>(body, element, degree))
        , geometry(body, body.fe[element].reference_cell(), quadrature)
      {
        batches.tetrahedra = body.mesh.tetrahedra;
        batches.degree     = degree;
        batches.n_points   = quadrature.size();
        batches.nonlinear  = body.material.nonlinear();
        batches.law        = body.material.template displacement_law<Number>();
        node_order =
          batches.tetrahedra ?
            ascending_dof_indices(degree, order()) :
            FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
        batches.n_nodes = node_order.size();
        if (this->pressures == nullptr)
          return;
        batches.compressibility = body.material.compressibility();
        batches.pressure_norm   = body.material.pressure_norm();
        pressure_order =
          batches.tetrahedra ?
            ascending_dof_indices(degree - 1, order()) :
            FETools::lexicographic_to_hierarchic_numbering<dim>(degree - 1);
        batches.n_pressure_nodes = pressure_order.size();
      }

      /// The message of a defect, if any.
      std::string
      build()
      {
        const SortedCells  cells(body,
                                element,
                                geometry,
                                batches.nonlinear != nullptr);
        const unsigned int n_curved = cells.all.size() - cells.n_affine;
        batches.n_cells             = cells.all.size();
        batches.n_affine_cells      = cells.n_affine;
        batches.n_affine            = (cells.n_affine + width - 1) / width;
        batches.n_batches = batches.n_affine + (n_curved + width - 1) / width;
        const std::size_t point = dim * dim * width;
        batches.nodes.resize(std::size_t(batches.n_batches) * batches.n_nodes *
                             width);
        batches.metric.resize(batches.n_affine * point +
                              (batches.n_batches - batches.n_affine) *
                                quadrature.size() * point);
        batches.pressure_nodes.resize(batches.n_batches *
                                      pressure_order.size() * width);
        if (batches.nonlinear)
          {
            const TangentForm form = batches.nonlinear->form();
            const std::size_t n_points =
              batches.n_batches * quadrature.size() * width;
            if (is_finite(form))
              {
                batches.finite_tangent.resize(
                  n_points *
                  n_stored<typename CellBatches<Number>::Stored>(form));
                batches.deformed_metric.resize(batches.metric.size());
              }
            else
              batches.tangent.resize(n_points * n_tangent(form));
            if (pressures != nullptr)
              batches.pressure_tangent.resize(2 * n_points);
          }
        for (unsigned int i = 0; i < cells.all.size(); ++i)
          {
            const bool         affine = i < cells.n_affine;
            const unsigned int index  = affine ? i : i - cells.n_affine;
            const unsigned int batch =
              (affine ? 0 : batches.n_affine) + index / width;
            set_nodes(cells.all[i], batch, index % width);
            if (pressures != nullptr)
              set_pressure_nodes(cells.all[i], batch, index % width);
            if (!set_metric(cells.all[i], affine, batch, index % width))
              return tangled_message(body, cells.all[i]);
          }
        return "";
      }

      CellBatches<Number> batches;

    private:
      /// Of the vertices of these tetrahedra.
      const VertexOrder &
      order() const
      {
        return SimplexElements::base(body.fe[element]).order;
      }

      /// Of the coordinates that the kernel differentiates along, by point;
      /// empty where they are those of the reference cell.
      std::vector<Tensor<2, dim>>
      make_axes() const
      {
        std::vector<Tensor<2, dim>> result;
        if (!body.mesh.tetrahedra)
          return result;
        const Quadrature<dim> rule = simplex_rule<Number>(degree);
        for (const Point<dim> &ascending : rule.get_points())
          result.push_back(simplex_rule_jacobian(degree, ascending));
        return result;
      }

      /// With derivatives along the edges from the first ascending vertex to
      /// the others, from those along the axes of the reference cell.
      CellGeometry::Jacobian
      ascending(const CellGeometry::Jacobian &jacobian) const
      {
        if (!body.mesh.tetrahedra)
          return jacobian;
        const auto to_vertex = [&](const unsigned int v) {
          return v == 0 ? Tensor<1, dim>() : jacobian[v - 1];
        };
        CellGeometry::Jacobian result;
        for (unsigned int a = 0; a < dim; ++a)
          result[a] = to_vertex(order()[a + 1]) - to_vertex(order()[0]);
        return result;
      }

      void
      set_nodes(const Body::CellIterator &cell,
                const unsigned int        batch,
                const unsigned int        lane)
      {
        space.get_nodes(body.index, cell, nodes);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            unsigned int *to =
              &batches.nodes[(std::size_t(batch) * nodes.size() + i) * width];
            to[lane] = layout.global_to_local(dim * nodes[node_order[i]]);
            if (lane == 0)
              std::fill(to + 1, to + width, to[0]);
          }
      }

      void
      set_pressure_nodes(const Body::CellIterator &cell,
                         const unsigned int        batch,
                         const unsigned int        lane)
      {
        pressures->space.get_nodes(body.index, cell, nodes);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            unsigned int *to =
              &batches.pressure_nodes[(std::size_t(batch) * nodes.size() + i) *
                                      width];
            to[lane] =
              pressures->layout.global_to_local(nodes[pressure_order[i]]);
            if (lane == 0)
              std::fill(to + 1, to + width, to[0]);
          }
      }

      bool
      set_metric(const Body::CellIterator &cell,
                 const bool                affine,
                 const unsigned int        batch,
                 const unsigned int        lane)
      {
        Number    *to  = const_cast<Number *>(batches.metric_of(batch)) + lane;
        const auto set = [&](const CellGeometry::Jacobian &jacobian,
                             const double                  weight,
                             const CellGeometry::Jacobian &along_axes) {
          const double det = determinant(jacobian);
          if (!(det > 0.))
            return false;
          const CellGeometry::Jacobian inverse =
            std::sqrt(weight * det) * invert(along_axes);
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int e = 0; e < dim; ++e, to += width)
              *to = inverse[e][a];
          return true;
        };
        if (affine)
          {
            const auto jacobian = *geometry.constant_jacobian(cell);
            return set(jacobian, 1., ascending(jacobian));
          }
        const auto &jacobians = geometry.jacobians(cell);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          if (!set(jacobians[q],
                   quadrature.weight(q),
                   axes.empty() ? jacobians[q] :
                                  axes[q] * ascending(jacobians[q])))
            return false;
        return true;
      }

      const NodalSpace                  &space;
      const Body                        &body;
      const unsigned int                 element;
      const Utilities::MPI::Partitioner &layout;
      const PressureNodes               *pressures; ///< of this body
      const unsigned int                 degree;
      const std::vector<Tensor<2, dim>>  axes; ///< of the rule on tetrahedra
      const Quadrature<dim>              quadrature;
      CellGeometry                       geometry;
      std::vector<unsigned int>          node_order, pressure_order;
      std::vector<NodalSpace::Index>     nodes;
    };
  } // namespace

  template <typename Number>
  unsigned int
  CellBatches<Number>::lanes(const unsigned int batch) const
  {
    constexpr unsigned int width = Batch<Number>::size;
    return batch < n_affine ?
             std::min(width, n_affine_cells - batch * width) :
             std::min(width,
                      n_cells - n_affine_cells - (batch - n_affine) * width);
  }

  template <typename Number>
  const Number *
  CellBatches<Number>::metric_of(const unsigned int batch) const
  {
    const std::size_t point = dim * dim * Batch<Number>::size;
    return metric.data() +
           (batch < n_affine ?
              batch * point :
              (n_affine + std::size_t(batch - n_affine) * n_points) * point);
  }

  template <typename Number>
  CellBatches<Number>::CellBatches(const NodalSpace                  &space,
                                   const Body                        &body,
                                   const unsigned int                 element,
                                   const Utilities::MPI::Partitioner &layout,
                                   const PressureNodes               *pressures,
                                   std::string                       &tangled)
  {
    BatchBuilder<Number> builder(space, body, element, layout, pressures);
    tangled = builder.build();
    *this   = std::move(builder.batches);
  }

  template struct CellBatches<float>;
  template struct CellBatches<double>;
} // namespace mortise
