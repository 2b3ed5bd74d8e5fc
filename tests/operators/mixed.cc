// Proves that the matrix-free products in mixed form are FEValues' sums over
// the points of cells in another basis, for p = 2..8 on affine, straight and
// curved hexahedra, affine tetrahedra, and beside bodies in displacement form:
// displacement and pressure tested with other fields, the force of a pressure,
// the norm of pressures and its diagonal; that with hanging nodes and on curved
// tetrahedra, where rules differ, they are symmetric and a pressure of one has
// the volume. The same on every number of ranks.
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <mortise/body/elements/simplex_elements.h>
#include <mortise/operators/bulk_system.h>
#include <mortise/operators/cells/cell_order.h>
#include <mortise/operators/scene_system.h>
#include <verdict.h>

#include <cmath>
#include <map>

#include "../scenes/scene.h"
#include "reference_cell.h"

namespace mortise::testing
{
  using namespace dealii;

  MeshParameters
  mesh(const std::string &kind)
  {
    MeshParameters result;
    if (kind.find("tetrahedra") != std::string::npos)
      result.cells = "tetrahedra";
    if (kind.find("curved") == 0 || kind == "hanging")
      {
        result.source       = "shell octant";
        result.extent       = {1., 2.};
        result.subdivisions = {2, 1};
        if (kind == "hanging")
          result.refine_near = "0, 0, 1, 0.1, 1";
        return result;
      }
    result.source       = "box";
    result.extent       = {0., 0., 0., 1., 2., 3.};
    result.subdivisions = {3, 2, 3};
    result.rotate       = {{20., 30., 40.}};
    result.distort      = kind == "straight" ? 0.2 : 0.;
    return result;
  }

  struct Scene
  {
    /// Bodies of degree one are in displacement form.
    Scene(const std::vector<std::string>  &kinds,
          const std::vector<unsigned int> &degrees)
    {
      std::vector<const DoFHandler<dim> *>   handlers;
      std::vector<AffineConstraints<double>> conformity(kinds.size());
      for (unsigned int b = 0; b < kinds.size(); ++b)
        {
          bodies.push_back(std::make_unique<Body>(
            "body", b, LinearElastic{1. + b, 0.4, degrees[b] > 1}));
          bodies[b]->create_mesh(mesh(kinds[b]), MPI_COMM_WORLD, "");
          bodies[b]->create_space(degrees[b], {}, "");
          handlers.push_back(&bodies[b]->dof_handler);
          pointers.push_back(bodies[b].get());
          conformity[b].copy_from(bodies[b]->conformity);
        }
      field.numbering   = FieldNumbering(handlers, MPI_COMM_WORLD);
      field.constraints = scene_constraints(field.numbering, conformity);
      auto spaces       = make_nodal_spaces(pointers, MPI_COMM_WORLD);
      pressure_space    = make_nodal_pressures(pointers, MPI_COMM_WORLD);
      u_nodes           = displacement_indices(spaces.front()->owned_nodes());
      p_nodes           = pressure_space->owned_nodes();
      system =
        std::make_unique<BulkSystem>(spaces,
                                     pressure_space,
                                     BulkSystem::Scene{field.numbering,
                                                       field.constraints},
                                     MPI_COMM_WORLD);
    }

    Bodies                            bodies;
    std::vector<const Body *>         pointers;
    SceneField                        field;
    IndexSet                          u_nodes, p_nodes;
    std::unique_ptr<BulkSystem>       system;
    std::shared_ptr<const NodalSpace> pressure_space;
  };

  double
  random_number(const unsigned int seed, const types::global_dof_index i)
  {
    const double x = std::sin(12.9898 * (i + 1.) + 78.233 * seed) * 43758.5453;
    return x - std::floor(x) - 0.5;
  }

  /// Random where nothing hangs, zero elsewhere.
  void
  set_random(mortise::Vector   &v,
             const NodalSpace  &space,
             const unsigned int n_components,
             const unsigned int seed)
  {
    for (const auto i : v.locally_owned_elements())
      if (!space.hanging_nodes().is_constrained(i / n_components))
        v(i) = random_number(seed, i);
  }

  /// Values that a rank needs, of index i.
  mortise::Vector
  ghosted(const mortise::Vector &v,
          const IndexSet        &owned,
          const IndexSet        &relevant)
  {
    mortise::Vector result(owned, relevant, MPI_COMM_WORLD);
    result = v;
    result.update_ghost_values();
    return result;
  }

  struct Expected
  {
    double mixed = 0., force = 0., norm = 0., trace = 0.;
  };

  struct Fields
  {
    mortise::Vector u, p;
  };

  /// Cells with one element. On hexahedra in the nodal bases of
  /// deal.II; on tetrahedra in modes, values at nodes are transformed.
  class Cells
  {
  public:
    Cells(const Body &body, const FiniteElement<dim> &element)
      : mixed(body.pressure != nullptr)
    {
      const unsigned int p = element.degree;
      if (element.reference_cell() == ReferenceCells::Hexahedron)
        {
          system   = std::make_unique<FESystem<dim>>(FE_Q<dim>(p), dim);
          pressure = std::make_unique<FE_Q<dim>>(std::max(p, 2u) - 1);
        }
      else
        {
          const VertexOrder order = SimplexElements::base(element).order;
          system = make_simplex_system(FE_SimplexLegendre(p, order), dim);
          pressure =
            std::make_unique<FE_SimplexLegendre>(std::max(p, 2u) - 1, order);
        }
      reference =
        std::make_unique<ReferenceCell>(body,
                                        *system,
                                        mixed ? pressure.get() : nullptr);
    }

    /// In these functions, from values at the nodes of a cell.
    template <typename ValueAt>
    ReferenceCell::Coefficients
    displacement(const ValueAt &at) const
    {
      ReferenceCell::Coefficients result;
      for (unsigned int c = 0; c < dim; ++c)
        result[c] =
          in_functions(*system, [&](const unsigned int k) { return at(k, c); });
      return result;
    }

    template <typename ValueAt>
    std::vector<double>
    pressures(const ValueAt &at) const
    {
      return in_functions(*pressure, at);
    }

    const bool                     mixed;
    std::unique_ptr<ReferenceCell> reference;

    /// p.Mp of the nodal functions of the pressure on the cell of the reference
    std::vector<double>
    norms()
    {
      if (squares.empty()) // the same on all cells
        for (unsigned int i = 0; i < pressure->n_dofs_per_cell(); ++i)
          squares.push_back(reference->squares(
            pressures([&](const unsigned int k) { return k == i ? 1. : 0.; })));
      return reference->masses(squares);
    }

  private:
    template <typename ValueAt>
    static std::vector<double>
    in_functions(const FiniteElement<dim> &element, const ValueAt &at)
    {
      std::vector<double> result(element.base_element(0).n_dofs_per_cell());
      if (element.reference_cell() == ReferenceCells::Hexahedron)
        {
          for (unsigned int k = 0; k < result.size(); ++k)
            result[k] = at(k);
          return result;
        }
      CellOrder order(element);
      for (unsigned int k = 0; k < result.size(); ++k)
        order.values[k] = at(order.scalar[k]);
      order.transform_to_modes();
      for (unsigned int k = 0; k < result.size(); ++k)
        result[order.scalar[k]] = order.values[k];
      return result;
    }

    std::unique_ptr<FiniteElement<dim>> system, pressure;
    std::vector<std::vector<double>>    squares; ///< at the points
  };

  /// (w, q) [K G^T; G -C] (u, p), w G^T p, q P p and the trace of P by cells.
  Expected
  by_cells(const Scene &scene, const Fields &left, const Fields &right)
  {
    const NodalSpace &space     = *scene.system->levels().front().space,
                     &pressures = *scene.pressure_space;
    const auto on_cells         = [&](const Fields &fields) {
      return Fields{ghosted(fields.u,
                            scene.u_nodes,
                            displacement_indices(space.relevant_nodes())),
                    ghosted(fields.p,
                            scene.p_nodes,
                            pressures.relevant_nodes())};
    };
    const Fields                   a = on_cells(left), b = on_cells(right);
    Expected                       sum;
    std::vector<NodalSpace::Index> nodes, p_nodes;
    for (const Body *body : space.bodies())
      {
        std::map<unsigned int, Cells> all;
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              Cells &cells =
                all.try_emplace(cell->active_fe_index(), *body, cell->get_fe())
                  .first->second;
              cells.reference->reinit(cell);
              space.get_nodes(body->index, cell, nodes);
              const auto of = [&](const mortise::Vector &v) {
                return cells.displacement(
                  [&](const unsigned int k, const unsigned int c) {
                    return v(dim * nodes[k] + c);
                  });
              };
              const auto w = of(a.u), u = of(b.u);
              sum.mixed += cells.reference->stiffness(w, u);
              if (!cells.mixed)
                continue;
              const ReferenceCell &reference = *cells.reference;
              pressures.get_nodes(body->index, cell, p_nodes);
              const auto of_p = [&](const mortise::Vector &v) {
                return cells.pressures(
                  [&](const unsigned int k) { return v(p_nodes[k]); });
              };
              const auto q = of_p(a.p), r = of_p(b.p);
              const auto norms = cells.norms();
              for (unsigned int i = 0; i < r.size(); ++i)
                if (!pressures.hanging_nodes().is_constrained(p_nodes[i]))
                  sum.trace += body->material.pressure_norm() * norms[i];
              const double force = reference.divergence(r, w);
              sum.force += force;
              sum.mixed +=
                force + reference.divergence(q, u) -
                body->material.compressibility() * reference.mass(q, r);
              sum.norm += body->material.pressure_norm() * reference.mass(q, r);
            }
      }
    for (double *value : {&sum.mixed, &sum.force, &sum.norm, &sum.trace})
      *value = Utilities::MPI::sum(*value, MPI_COMM_WORLD);
    return sum;
  }

  Fields
  random_fields(const Scene &scene, const unsigned int seed)
  {
    Fields fields;
    scene.system->initialize(fields.u);
    scene.system->initialize_pressure(fields.p);
    set_random(fields.u, *scene.system->levels().front().space, dim, seed);
    set_random(fields.p, *scene.pressure_space, 1, seed + 1);
    return fields;
  }

  double
  relative(const double got, const double expected)
  {
    return std::fabs(got / expected - 1.);
  }

  void
  check(const std::string               &name,
        const std::vector<std::string>  &kinds,
        const std::vector<unsigned int> &degrees)
  {
    const Scene  scene(kinds, degrees);
    const Fields left       = random_fields(scene, 1),
                 right      = random_fields(scene, 3);
    const Expected expected = by_cells(scene, left, right);
    Fields         product  = right;
    scene.system->apply_mixed(product.u, product.p, right.u, right.p);
    verdict(name + ": product",
            relative(left.u * product.u + left.p * product.p, expected.mixed),
            1e-11);
    product.u = 0.;
    scene.system->add_pressure_force(product.u, right.p);
    verdict(name + ": force of a pressure",
            relative(left.u * product.u, expected.force),
            1e-11);
    scene.system->apply_pressure_norm(product.p, right.p);
    verdict(name + ": norm of pressures",
            relative(left.p * product.p, expected.norm),
            1e-11);
    verdict(name + ": its diagonal",
            relative(scene.system->pressure_norm_diagonal().l1_norm(),
                     expected.trace),
            1e-11);
  }

  void
  check_symmetry(const std::string &kind, const unsigned int p)
  {
    const std::string name = kind + ", p = " + std::to_string(p);
    const Scene       scene({kind}, {p});
    const Fields      left = random_fields(scene, 1),
                 right     = random_fields(scene, 3);
    Fields a = left, b = right;
    scene.system->apply_mixed(a.u, a.p, left.u, left.p);
    scene.system->apply_mixed(b.u, b.p, right.u, right.p);
    const double ab = a.u * right.u + a.p * right.p,
                 ba = b.u * left.u + b.p * left.p;
    verdict(name + ": symmetric", relative(ab, ba), 1e-10);
    a.u = 0.;
    scene.system->add_pressure_force(a.u, right.p);
    Fields constant = right;
    constant.p      = 0.;
    scene.system->apply_mixed(b.u, b.p, left.u, constant.p);
    verdict(name + ": force of a pressure",
            relative(a.u * left.u, b.p * right.p),
            1e-10);
    scene.system->set_constant_pressure(*scene.bodies.front(), constant.p);
    scene.system->apply_pressure_mass(b.p, constant.p);
    // an eighth of a shell
    verdict(name + ": volume",
            relative(constant.p * b.p /
                       scene.bodies.front()->material.pressure_norm(),
                     numbers::PI / 6. * 7.),
            p < 5 ? 1e-3 : 1e-6);
  }
} // namespace mortise::testing

int
main(int argc, char **argv)
{
  using namespace mortise::testing;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string kind : {"affine", "straight", "curved"})
    for (unsigned int p = 2; p <= mortise::max_degree; ++p)
      check(kind + ", p = " + std::to_string(p), {kind}, {p});
  check("three bodies, p = 5, 1, 2",
        {"curved", "affine", "straight"},
        {5, 1, 2});
  for (unsigned int p = 2; p <= mortise::max_degree; ++p)
    check("tetrahedra, p = " + std::to_string(p), {"tetrahedra"}, {p});
  check("hexahedra and tetrahedra, p = 3, 4, 1",
        {"curved", "tetrahedra", "tetrahedra"},
        {3, 4, 1});
  for (const unsigned int p : {2, 3, 5})
    check_symmetry("hanging", p);
  for (const unsigned int p : {2, 4, 5, 6, 8})
    check_symmetry("curved tetrahedra", p);
}
