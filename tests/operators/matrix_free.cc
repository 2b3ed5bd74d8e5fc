// Proves that the stiffness without a matrix is the assembled one in another
// basis, for p = 1..8 on affine, straight and curved cells and several bodies
// at once: w.Ku agrees with the sum over the matrices of cells to rounding,
// double and single precision, and so does the diagonal; that the transfer
// between degrees reproduces polynomials and its transpose is the restriction.
// The same on every number of ranks.
#include <deal.II/fe/fe_q.h>

#include <mortise/body/fe_legendre.h>
#include <mortise/operators/cell_kernel.h>
#include <mortise/operators/degree_transfer.h>
#include <mortise/operators/nodal_system.h>

#include <cmath>

#include "../scenes/scene.h"

namespace mortise::testing
{
  using namespace dealii;

  MeshParameters
  mesh(const std::string &kind)
  {
    MeshParameters result;
    if (kind == "curved")
      {
        result.source       = "shell octant";
        result.extent       = {1., 2.};
        result.subdivisions = {2, 1};
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
    Scene(const std::vector<std::string>  &kinds,
          const std::vector<unsigned int> &degrees)
    {
      for (unsigned int b = 0; b < kinds.size(); ++b)
        {
          bodies.push_back(std::make_unique<Body>(
            "body", b, LinearElastic{1. + b, 0.3 - 0.1 * b}));
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
      for (unsigned int l = 0; l < spaces.size(); ++l)
        levels.push_back(make_nodal_level(
          std::move(spaces[l]), l, numbering, constraints, {}, MPI_COMM_WORLD));
    }

    Bodies                               bodies;
    std::vector<const DoFHandler<dim> *> handlers;
    std::vector<const Body *>            pointers;
    FieldNumbering                       numbering;
    AffineConstraints<double>            constraints;
    std::vector<NodalLevel>              levels;
  };

  /// The field at a point, any smooth one; of degree q in each direction of
  /// space when asked for.
  double
  field(const Point<dim> &x, const unsigned int c, const double shift)
  {
    return std::sin(1. + c + shift + 3. * x[0]) * std::cos(2. * x[1] - x[2]) +
           0.3 * x[c];
  }

  /// Values at the nodes of level @p level.
  template <typename Number>
  void
  interpolate(const NodalLevel    &level,
              const double         shift,
              LevelVector<Number> &u)
  {
    u.reinit(level.layout);
    std::vector<NodalSpace::Index> nodes;
    for (const Body *body : level.space->bodies())
      {
        const auto unit =
          FE_Q<dim>(level.space->degree(*body, body->max_degree()))
            .get_unit_support_points();
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              level.space->get_nodes(body->index, cell, nodes);
              for (unsigned int i = 0; i < nodes.size(); ++i)
                for (unsigned int c = 0; c < dim; ++c)
                  if (level.layout->in_local_range(dim * nodes[i] + c))
                    u.local_element(
                      level.layout->global_to_local(dim * nodes[i] + c)) =
                      field(body->mapping->transform_unit_to_real_cell(cell,
                                                                       unit[i]),
                            c,
                            shift);
            }
      }
  }

  /// w.Ku by the matrices of cells, nodal bases of deal.II, and the sums of
  /// |diagonal| of them.
  std::pair<double, double>
  by_matrices(const Scene               &scene,
              const LevelVector<double> &w,
              const LevelVector<double> &u)
  {
    const NodalLevel              &level   = scene.levels.front();
    double                         product = 0., trace = 0.;
    std::vector<NodalSpace::Index> nodes;
    u.update_ghost_values();
    w.update_ghost_values();
    for (const Body *body : level.space->bodies())
      {
        const FESystem<dim> system(
          FE_Q<dim>(level.space->degree(*body, body->max_degree())), dim);
        CellKernel         kernel(*body, system);
        FullMatrix<double> K(system.n_dofs_per_cell());
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              kernel.compute(cell, K);
              level.space->get_nodes(body->index, cell, nodes);
              dealii::Vector<double> a(K.m()), b(K.m());
              for (unsigned int i = 0; i < K.m(); ++i)
                {
                  const auto [c, k] = system.system_to_component_index(i);
                  const auto place =
                    level.layout->global_to_local(dim * nodes[k] + c);
                  a(i) = w.local_element(place);
                  b(i) = u.local_element(place);
                  trace += K(i, i);
                }
              product += K.matrix_scalar_product(a, b);
            }
      }
    u.zero_out_ghost_values();
    w.zero_out_ghost_values();
    return {Utilities::MPI::sum(product, MPI_COMM_WORLD),
            Utilities::MPI::sum(trace, MPI_COMM_WORLD)};
  }

  template <typename Number>
  void
  check_product(const std::string               &name,
                const Scene                     &scene,
                const std::pair<double, double> &expected,
                const double                     tolerance)
  {
    const LevelOperator<Number> K(scene.levels.front(), false);
    LevelVector<Number>         u, w, product, diagonal;
    interpolate(scene.levels.front(), 0., u);
    interpolate(scene.levels.front(), 1., w);
    K.initialize(product);
    K.vmult(product, u);
    verdict(name + ", product",
            std::fabs(product * w / expected.first - 1.),
            tolerance);
    K.diagonal(diagonal);
    verdict(name + ", diagonal",
            std::fabs(diagonal.l1_norm() / expected.second - 1.),
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
        const std::vector<unsigned int> &degrees)
  {
    const Scene         scene(kinds, degrees);
    LevelVector<double> u, w;
    interpolate(scene.levels.front(), 0., u);
    interpolate(scene.levels.front(), 1., w);
    const auto expected = by_matrices(scene, w, u);
    check_product<double>(name, scene, expected, 1e-12);
    check_product<float>(name + ", single", scene, expected, 1e-4);
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
  check("three bodies, p = 5, 1, 2",
        {"curved", "affine", "straight"},
        {5, 1, 2});
}
