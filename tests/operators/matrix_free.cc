// Proves that the stiffness without a matrix is the assembled one in another
// basis, for p = 1..8 on affine, straight and curved hexahedra, affine and
// curved tetrahedra, several bodies at once, and orthotropic ones: w.Ku agrees
// with deal.II's sum over the points of cells to rounding, double and single
// precision, and so does the diagonal; that the transfer between degrees
// reproduces polynomials and its transpose is the restriction. The same on
// every number of ranks.
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/operators/bulk_system.h>
#include <mortise/operators/levels/degree_transfer.h>
#include <mortise/operators/matrix_free/simplex_tables.h>
#include <mortise/operators/scene_system.h>
#include <verdict.h>

#include <cmath>

namespace mortise::testing
{
  using namespace dealii;

  MeshParameters
  mesh(const std::string &kind)
  {
    MeshParameters result;
    const bool     tetrahedra = kind.find("tetrahedra") != std::string::npos;
    if (tetrahedra)
      result.cells = "tetrahedra";
    if (kind.find("curved") == 0)
      {
        result.source       = "shell octant";
        result.extent       = {1., 2.};
        result.subdivisions = {tetrahedra ? 1u : 2u, 1};
        return result;
      }
    result.source       = "box";
    result.extent       = {0., 0., 0., 1., 2., 3.};
    result.subdivisions = {tetrahedra ? 2u : 3u, 2, tetrahedra ? 1u : 3u};
    result.rotate       = {{20., 30., 40.}};
    result.distort      = kind == "straight" ? 0.2 : 0.;
    return result;
  }

  struct Scene
  {
    Scene(const std::vector<std::string>  &kinds,
          const std::vector<unsigned int> &degrees,
          const bool                       orthotropic)
    {
      for (unsigned int b = 0; b < kinds.size(); ++b)
        {
          Material material = LinearElastic{1. + b, 0.3 - 0.1 * b};
          if (orthotropic)
            material = Orthotropic{{{10., 1. + b, 0.5}},
                                   {{0.35, 0.6, 0.02}},
                                   {{0.7, 0.05, 0.8}},
                                   {{20., -35., 70.}}};
          bodies.push_back(std::make_unique<Body>("body", b, material));
          bodies[b]->create_mesh(mesh(kinds[b]), MPI_COMM_WORLD, "");
          bodies[b]->create_space(degrees[b], {}, "");
          handlers.push_back(&bodies[b]->dof_handler);
          pointers.push_back(bodies[b].get());
        }
      numbering = FieldNumbering(handlers, MPI_COMM_WORLD);
      constraints =
        AffineConstraints<double>(complete_index_set(numbering.size()));
      constraints.close();
      auto spaces = make_nodal_spaces(pointers, MPI_COMM_WORLD);
      for (const auto &space : spaces)
        levels.push_back(
          make_multigrid_level(space, numbering, constraints, MPI_COMM_WORLD));
    }

    Bodies                               bodies;
    std::vector<const DoFHandler<dim> *> handlers;
    std::vector<const Body *>            pointers;
    FieldNumbering                       numbering;
    AffineConstraints<double>            constraints;
    std::vector<MultigridLevel>          levels;
  };

  /// The field at a point, any smooth one; of degree q in each direction of
  /// space when asked for.
  double
  field(const Point<dim> &x, const unsigned int c, const double shift)
  {
    return std::sin(1. + c + shift + 3. * x[0]) * std::cos(2. * x[1] - x[2]) +
           0.3 * x[c];
  }

  /// The nodal basis of a level on a cell, in the order of get_nodes(): made of
  /// the hierarchical modes on tetrahedra, deal.II's on hexahedra.
  struct NodalBasis
  {
    NodalBasis(const Body::CellIterator &cell, const unsigned int degree)
    {
      if (cell->reference_cell() == ReferenceCells::Hexahedron)
        {
          scalar = std::make_unique<FE_Q<dim>>(degree);
          points = scalar->get_unit_support_points();
          rule = single_rule = QGauss<dim>(degree + 1);
          return;
        }
      const VertexOrder order = vertex_order(cell);
      scalar              = std::make_unique<FE_SimplexLegendre>(degree, order);
      const auto to_local = [&](const std::vector<Point<dim>> &ascending) {
        std::vector<Point<dim>> result;
        for (const Point<dim> &x : ascending)
          {
            const auto                  lambda = barycentric_coordinates(x);
            std::array<double, dim + 1> local;
            for (unsigned int v = 0; v <= dim; ++v)
              local[order[v]] = lambda[v];
            result.emplace_back(local[1], local[2], local[3]);
          }
        return result;
      };
      const auto         nodes = to_local(simplex_nodes(degree));
      const auto         place = ascending_dof_indices(degree, order);
      const unsigned int n     = nodes.size();
      points.resize(n);
      for (unsigned int i = 0; i < n; ++i)
        points[place[i]] = nodes[i];
      to_modes.reinit(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n; ++k)
          to_modes(i, k) = scalar->shape_value(k, points[i]);
      to_modes.gauss_jordan();
      const auto local_rule = [&](const Quadrature<dim> &ascending) {
        return Quadrature<dim>(to_local(ascending.get_points()),
                               ascending.get_weights());
      };
      rule        = local_rule(simplex_rule<double>(degree));
      single_rule = local_rule(simplex_rule<float>(degree));
    }

    std::unique_ptr<FiniteElement<dim>> scalar;
    std::vector<Point<dim>>             points;
    FullMatrix<double> to_modes; ///< (mode, node) on tetrahedra
    Quadrature<dim>    rule, single_rule;
  };

  /// Calls visit(body, cell, basis, nodes) for the owned cells.
  template <typename Visit>
  void
  for_each_cell(const MultigridLevel &level, const Visit &visit)
  {
    level.space->for_each_cell(
      [&](const Body &body, const auto &cell, const auto &nodes) {
        static std::map<std::pair<unsigned int, VertexOrder>, NodalBasis> made;
        const unsigned int degree = level.space->degree(body, cell);
        const VertexOrder  order =
          body.mesh.tetrahedra ? vertex_order(cell) : VertexOrder{{0, 0, 0, 0}};
        const auto found = made.find({degree, order});
        visit(body,
              cell,
              found != made.end() ? found->second :
                                    made
                                      .emplace(std::make_pair(degree, order),
                                               NodalBasis(cell, degree))
                                      .first->second,
              nodes);
      });
  }

  /// Values at the nodes of level @p level.
  template <typename Number>
  void
  interpolate(const MultigridLevel &level,
              const double          shift,
              LevelVector<Number>  &u)
  {
    u.reinit(level.layout);
    for_each_cell(level,
                  [&](const Body       &body,
                      const auto       &cell,
                      const NodalBasis &basis,
                      const auto       &nodes) {
                    for (unsigned int i = 0; i < nodes.size(); ++i)
                      for (unsigned int c = 0; c < dim; ++c)
                        if (level.layout->in_local_range(dim * nodes[i] + c))
                          u.local_element(
                            level.layout->global_to_local(dim * nodes[i] + c)) =
                            field(body.mapping->transform_unit_to_real_cell(
                                    cell, basis.points[i]),
                                  c,
                                  shift);
                  });
  }

  struct Sums
  {
    double product = 0., trace = 0.;
  };

  using ValuesOfCell = std::array<std::vector<double>, dim>;

  /// By deal.II's gradients at the points of the rule.
  void
  add_by_points(const Body               &body,
                const Body::CellIterator &cell,
                const NodalBasis         &basis,
                const Quadrature<dim>    &rule,
                const ValuesOfCell       &w,
                const ValuesOfCell       &u,
                Sums                     &sums)
  {
    FEValues<dim> values(*body.mapping,
                         *basis.scalar,
                         rule,
                         update_gradients | update_JxW_values);
    values.reinit(Triangulation<dim>::cell_iterator(cell));
    for (const unsigned int q : values.quadrature_point_indices())
      {
        Tensor<2, dim> grad_u, grad_w; // [c][e]
        for (const unsigned int i : values.dof_indices())
          {
            Tensor<1, dim> gradient;
            if (basis.to_modes.empty())
              gradient = values.shape_grad(i, q);
            for (unsigned int k = 0; k < basis.to_modes.m(); ++k)
              gradient += basis.to_modes(k, i) * values.shape_grad(k, q);
            double energy = 0.; // of all components, each alone
            for (unsigned int c = 0; c < dim; ++c)
              {
                grad_u[c] += u[c][i] * gradient;
                grad_w[c] += w[c][i] * gradient;
                Tensor<2, dim> alone;
                alone[c] = gradient;
                energy += body.material.twice_energy(alone, 0.);
              }
            sums.trace += values.JxW(q) * energy;
          }
        sums.product +=
          values.JxW(q) * (body.material.stress(grad_u) * symmetrize(grad_w));
      }
  }

  /// w.Ku and the trace of K over all cells.
  Sums
  by_cells(const Scene               &scene,
           const bool                 single,
           const LevelVector<double> &w,
           const LevelVector<double> &u)
  {
    const MultigridLevel &level = scene.levels.front();
    Sums                  sums;
    u.update_ghost_values();
    w.update_ghost_values();
    for_each_cell(level,
                  [&](const Body       &body,
                      const auto       &cell,
                      const NodalBasis &basis,
                      const auto       &nodes) {
                    const auto read = [&](const LevelVector<double> &v) {
                      ValuesOfCell result;
                      for (unsigned int c = 0; c < dim; ++c)
                        for (const auto node : nodes)
                          result[c].push_back(v.local_element(
                            level.layout->global_to_local(dim * node + c)));
                      return result;
                    };
                    add_by_points(body,
                                  cell,
                                  basis,
                                  single ? basis.single_rule : basis.rule,
                                  read(w),
                                  read(u),
                                  sums);
                  });
    u.zero_out_ghost_values();
    w.zero_out_ghost_values();
    return {Utilities::MPI::sum(sums.product, MPI_COMM_WORLD),
            Utilities::MPI::sum(sums.trace, MPI_COMM_WORLD)};
  }

  template <typename Number>
  void
  check_product(const std::string &name,
                const Scene       &scene,
                const Sums        &expected,
                const double       tolerance)
  {
    const LevelOperator<Number> K(scene.levels.front(), false);
    LevelVector<Number>         u, w, product, diagonal;
    interpolate(scene.levels.front(), 0., u);
    interpolate(scene.levels.front(), 1., w);
    K.initialize(product);
    K.vmult(product, u);
    verdict(name + ", product",
            std::fabs(product * w / expected.product - 1.),
            tolerance);
    K.diagonal(diagonal);
    verdict(name + ", diagonal",
            std::fabs(diagonal.l1_norm() / expected.trace - 1.),
            tolerance);
  }

  void
  check_transfer(const std::string &name, const Scene &scene)
  {
    if (scene.levels.size() < 2)
      return;
    const LevelOperator<double> fine(scene.levels[0], false),
      coarse(scene.levels[1], false);
    const DegreeTransfer<double> transfer(fine, coarse);
    LevelVector<double>          f, c, up, down;
    interpolate(scene.levels[0], 0., f);
    interpolate(scene.levels[1], 1., c);
    fine.initialize(up);
    coarse.initialize(down);
    transfer.prolongate_add(up, c);
    transfer.restrict_to(down, f);
    verdict(name + ", restriction is the transpose",
            std::fabs((up * f) / (down * c) - 1.),
            1e-12);
    // a constant stays one
    c  = 1.;
    up = 0.;
    transfer.prolongate_add(up, c);
    up.add(-1.);
    verdict(name + ", constants", up.linfty_norm(), 1e-13);
  }

  void
  check(const std::string               &name,
        const std::vector<std::string>  &kinds,
        const std::vector<unsigned int> &degrees,
        const bool                       orthotropic = false)
  {
    const Scene         scene(kinds, degrees, orthotropic);
    LevelVector<double> u, w;
    interpolate(scene.levels.front(), 0., u);
    interpolate(scene.levels.front(), 1., w);
    check_product<double>(name, scene, by_cells(scene, false, w, u), 1e-12);
    check_product<float>(name + ", single",
                         scene,
                         by_cells(scene, true, w, u),
                         1e-4);
    check_transfer(name, scene);
  }
} // namespace mortise::testing

int
main(int argc, char **argv)
{
  using namespace mortise::testing;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string kind : {"affine", "straight", "curved"})
    for (unsigned int p = 1; p <= mortise::max_degree; ++p)
      check(kind + ", p = " + std::to_string(p), {kind}, {p});
  for (const std::string kind : {"affine tetrahedra", "curved tetrahedra"})
    for (unsigned int p = 1; p <= mortise::max_degree; ++p)
      check(kind + ", p = " + std::to_string(p), {kind}, {p});
  check("both shapes, p = 5, 3, 6",
        {"curved", "curved tetrahedra", "affine tetrahedra"},
        {5, 3, 6});
  check("three bodies, p = 5, 1, 2",
        {"curved", "affine", "straight"},
        {5, 1, 2});
  check("orthotropic hexahedra, p = 3, 2, 4",
        {"curved", "affine", "straight"},
        {3, 2, 4},
        true);
  check("orthotropic tetrahedra, p = 3, 2, 6",
        {"curved tetrahedra", "affine tetrahedra", "curved tetrahedra"},
        {3, 2, 6},
        true);
}
