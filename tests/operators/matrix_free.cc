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
          rule = single_rule = with_gram(QGauss<dim>(degree + 1));
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
        return with_gram(Quadrature<dim>(to_local(ascending.get_points()),
                                         ascending.get_weights()));
      };
      rule        = local_rule(simplex_rule<double>(degree));
      single_rule = local_rule(simplex_rule<float>(degree));
    }

    /// Values at nodes to coefficients of the functions of the element.
    std::vector<double>
    coefficients(const std::vector<double> &at_nodes) const
    {
      if (to_modes.empty())
        return at_nodes;
      dealii::Vector<double> nodes(at_nodes.begin(), at_nodes.end()),
        modes(at_nodes.size());
      to_modes.vmult(modes, nodes);
      return {modes.begin(), modes.end()};
    }

    struct Rule
    {
      Quadrature<dim> points;
      /// sum_i Grad N_i x Grad N_i on the reference cell, N_i the nodal basis
      std::vector<Tensor<2, dim>> gram;
    };

    std::unique_ptr<FiniteElement<dim>> scalar;
    std::vector<Point<dim>>             points;
    FullMatrix<double> to_modes; ///< (mode, node) on tetrahedra
    Rule               rule, single_rule;

  private:
    Rule
    with_gram(const Quadrature<dim> &at) const
    {
      Triangulation<dim> cell;
      GridGenerator::reference_cell(cell, scalar->reference_cell());
      FEValues<dim> values(
        scalar->reference_cell().template get_default_linear_mapping<dim>(),
        *scalar,
        at,
        update_gradients);
      values.reinit(cell.begin_active());
      const unsigned int n = scalar->n_dofs_per_cell();
      FullMatrix<double> of_functions(dim * at.size(), n),
        of_nodes(dim * at.size(), n);
      for (unsigned int q = 0; q < at.size(); ++q)
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int e = 0; e < dim; ++e)
            of_functions(dim * q + e, k) = values.shape_grad(k, q)[e];
      if (to_modes.empty())
        of_nodes = of_functions;
      else
        of_functions.mmult(of_nodes, to_modes);
      Rule result{at, std::vector<Tensor<2, dim>>(at.size())};
      for (unsigned int q = 0; q < at.size(); ++q)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int e = 0; e < dim; ++e)
            for (unsigned int f = 0; f < dim; ++f)
              result.gram[q][e][f] +=
                of_nodes(dim * q + e, i) * of_nodes(dim * q + f, i);
      return result;
    }
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

  /// By deal.II's gradients at the points of the rule. A diagonal entry is the
  /// energy of a function in one component, C_cecf dN_i/dx_e dN_i/dx_f, so that
  /// their sum needs only the sum over i of products of gradients.
  void
  add_by_points(const Material                    &material,
                const FEValues<dim>               &values,
                const std::vector<Tensor<2, dim>> &gram_of_reference,
                const ValuesOfCell                &w,
                const ValuesOfCell                &u,
                Sums                              &sums)
  {
    const Moduli C = std::visit([](const auto &law) { return moduli(law); },
                                material.displacement_law());
    for (const unsigned int q : values.quadrature_point_indices())
      {
        Tensor<2, dim> grad_u, grad_w; // [c][e]
        for (const unsigned int i : values.dof_indices())
          for (unsigned int c = 0; c < dim; ++c)
            {
              grad_u[c] += u[c][i] * values.shape_grad(i, q);
              grad_w[c] += w[c][i] * values.shape_grad(i, q);
            }
        sums.product +=
          values.JxW(q) * (material.stress(grad_u) * symmetrize(grad_w));
        const Tensor<2, dim> to_reference(values.inverse_jacobian(q)); // [f][e]
        const Tensor<2, dim> gram =
          transpose(to_reference) * gram_of_reference[q] * to_reference;
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int e = 0; e < dim; ++e)
            for (unsigned int f = 0; f < dim; ++f)
              sums.trace += values.JxW(q) * C[c][e][c][f] * gram[e][f];
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
    std::map<std::pair<const Body *, const NodalBasis *>,
             std::unique_ptr<FEValues<dim>>>
         made;
    Sums sums;
    u.update_ghost_values();
    w.update_ghost_values();
    for_each_cell(
      level,
      [&](const Body       &body,
          const auto       &cell,
          const NodalBasis &basis,
          const auto       &nodes) {
        const auto &rule   = single ? basis.single_rule : basis.rule;
        auto       &values = made[{&body, &basis}];
        if (!values)
          values = std::make_unique<FEValues<dim>>(*body.mapping,
                                                   *basis.scalar,
                                                   rule.points,
                                                   update_gradients |
                                                     update_JxW_values |
                                                     update_inverse_jacobians);
        values->reinit(Triangulation<dim>::cell_iterator(cell));
        const auto read = [&](const LevelVector<double> &v) {
          ValuesOfCell result;
          for (unsigned int c = 0; c < dim; ++c)
            {
              std::vector<double> at_nodes;
              for (const auto node : nodes)
                at_nodes.push_back(v.local_element(
                  level.layout->global_to_local(dim * node + c)));
              result[c] = basis.coefficients(at_nodes);
            }
          return result;
        };
        add_by_points(
          body.material, *values, rule.gram, read(w), read(u), sums);
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
