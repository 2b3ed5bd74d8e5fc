// Proves that hanging nodes without a matrix give the hierarchical space of the
// same mesh, for p = 1..8 and degrees that differ from cell to cell (beside
// each other, across hanging faces, the lower one on either side, three and
// more around a line), cells refined once and twice, affine and curved, and
// several bodies at once: a function of that space has the same energy by the
// sums over cells and by its values at nodes that do not hang, and comes back
// from these; that transfers between degrees keep functions and are transposes
// of each other; that the matrix of vertices is the product on its level. The
// same on every number of ranks.
#include <mortise/operators/cells/cell_order.h>
#include <mortise/operators/cells/cell_values.h>
#include <mortise/operators/levels/block_csr_operator.h>
#include <mortise/operators/levels/degree_transfer.h>
#include <mortise/operators/levels/vertex_matrix.h>

#include <cmath>
#include <deque>

#include "nodal_scene.h"
#include "reference_cell.h"

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
        result.subdivisions = {2, 2};
        // where patches meet in faces of transposed directions, from both sides
        result.refine_near =
          "0.1995, 0.6643, 0.9914, 0.05, 1; 0.2793, 1.3879, 0.93, 0.05, 1";
        return result;
      }
    result.source       = "box";
    result.extent       = {0., 0., 0., 1., 2., 3.};
    result.subdivisions = {2, 2, 2};
    if (kind == "tetrahedra")
      {
        result.cells = kind;
        return result;
      }
    result.refine_near =
      kind == "once" ? "0.5, 1, 0, 0.1, 1" : "0, 0, 0, 0.1, 2; 1, 2, 3, 0.1, 1";
    return result;
  }

  /// @p degrees: of each body; those of its cells are drawn from them, the same
  /// on every number of ranks.
  NodalScene
  make_scene(const std::vector<std::string>               &kinds,
             const std::vector<std::vector<unsigned int>> &degrees)
  {
    std::vector<MeshParameters> meshes;
    for (const std::string &kind : kinds)
      meshes.push_back(mesh(kind));
    return NodalScene(
      meshes,
      [&](Body &body) {
        const auto                                &drawn = degrees[body.index];
        std::map<types::material_id, unsigned int> by_region;
        for (unsigned int i = 0; i < drawn.size(); ++i)
          {
            by_region[i]                 = drawn[i];
            body.mesh.names.materials[i] = std::to_string(i);
          }
        for (const auto &cell :
             body.mesh.triangulation->active_cell_iterators())
          if (cell->is_locally_owned())
            {
              double x = 0.;
              for (unsigned int d = 0; d < dim; ++d)
                x = 17. * x + cell->center()[d];
              cell->set_material_id(static_cast<unsigned int>(97. * x) %
                                    drawn.size());
            }
        body.create_space(drawn[0], by_region, "");
      },
      [](const Body &, AffineConstraints<double> &) {});
  }

  double
  random_number(const unsigned int seed, const types::global_dof_index i)
  {
    const double x = std::sin(12.9898 * (i + 1.) + 78.233 * seed) * 43758.5453;
    return x - std::floor(x) - 0.5;
  }

  /// A function of the hierarchical space, by body.
  std::vector<BodyVector>
  make_function(const NodalScene &scene, const unsigned int seed)
  {
    mortise::Vector u(scene.fields.displacement.numbering.owned(),
                      MPI_COMM_WORLD);
    for (const auto i : scene.fields.displacement.numbering.owned())
      u(i) = random_number(seed, i);
    const SceneField &field = scene.fields.displacement;
    field.constraints.distribute(u);
    mortise::Vector all(field.numbering.owned(),
                        field.constraints.get_local_lines(),
                        MPI_COMM_WORLD);
    all = u;
    all.update_ghost_values();
    std::vector<BodyVector> result;
    for (const auto &body : scene.bodies)
      {
        result.emplace_back(body->dof_handler.locally_owned_dofs(),
                            body->relevant_dofs,
                            MPI_COMM_WORLD);
        for (const auto dof : result.back().locally_owned_elements())
          result.back()(dof) = all(field.numbering(body->index, dof));
      }
    for (BodyVector &body : result) // copies have no ghost values
      body.update_ghost_values();
    return result;
  }

  /// Values of one component at the nodes of a cell, in the order of both
  /// elements.
  std::vector<double>
  values_at_nodes(const Body::CellIterator &cell,
                  const BodyVector         &u,
                  const unsigned int        c)
  {
    CellOrder                            order(cell->get_fe());
    std::vector<types::global_dof_index> dofs(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < order.values.size(); ++i)
      order.values[i] = u(dofs[order.modes[c][i]]);
    order.transform_to_nodes();
    std::vector<double> result(order.values.size());
    for (unsigned int i = 0; i < order.values.size(); ++i)
      result[order.scalar[i]] = order.values[i];
    return result;
  }

  /// Values at the nodes of the finest level that do not hang.
  LevelVector<double>
  to_nodes(const NodalScene &scene, const std::vector<BodyVector> &u)
  {
    const MultigridLevel &level = scene.levels().front();
    LevelVector<double>   result(level.layout);
    level.space->for_each_cell(
      [&](const Body &body, const auto &cell, const auto &nodes) {
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto values = values_at_nodes(cell, u[body.index], c);
            for (unsigned int i = 0; i < nodes.size(); ++i)
              if (level.layout->in_local_range(dim * nodes[i] + c))
                result.local_element(level.layout->global_to_local(
                  dim * nodes[i] + c)) = values[i];
          }
      });
    for (const unsigned int place : level.constrained)
      result.local_element(place) = 0.;
    return result;
  }

  /// w.Ku by cells in the hierarchical basis.
  double
  by_cells(const NodalScene              &scene,
           const std::vector<BodyVector> &w,
           const std::vector<BodyVector> &u)
  {
    double product = 0.;
    for (const auto &body : scene.bodies)
      {
        std::deque<ReferenceCell> references;
        for (unsigned int i = 0; i < body->fe.size(); ++i)
          references.emplace_back(*body, body->fe[i]);
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              ReferenceCell &reference = references[cell->active_fe_index()];
              reference.reinit(cell);
              product +=
                reference.stiffness(cell_coefficients(cell, w[body->index]),
                                    cell_coefficients(cell, u[body->index]));
            }
      }
    return Utilities::MPI::sum(product, MPI_COMM_WORLD);
  }

  template <typename Number>
  double
  product(const MultigridLevel      &level,
          const LevelVector<double> &w,
          const LevelVector<double> &u)
  {
    const LevelOperator<Number> K(level, false);
    LevelVector<Number>         from(level.layout), to(level.layout);
    from.copy_locally_owned_data_from(u);
    K.vmult(to, from);
    LevelVector<double> result(level.layout);
    result.copy_locally_owned_data_from(to);
    return w * result;
  }

  void
  check_space(const std::string &name, const NodalScene &scene)
  {
    const auto   u = make_function(scene, 1), w = make_function(scene, 2);
    const auto   u_nodes = to_nodes(scene, u), w_nodes = to_nodes(scene, w);
    const double size =
                   std::sqrt(by_cells(scene, u, u) * by_cells(scene, w, w)),
                 exact          = by_cells(scene, w, u);
    const MultigridLevel &level = scene.levels().front();
    verdict(name + ", product",
            std::fabs(product<double>(level, w_nodes, u_nodes) - exact) / size,
            1e-12);
    verdict(name + ", product, single",
            std::fabs(product<float>(level, w_nodes, u_nodes) - exact) / size,
            1e-5);

    double worst = 0.;
    scene.system->for_each_coefficient(
      u_nodes,
      [&](const unsigned int            body,
          const types::global_dof_index dof,
          const double                  value) {
        worst = std::max(worst, std::fabs(value - u[body](dof)));
      });
    verdict(name + ", back to hierarchical coefficients",
            Utilities::MPI::max(worst, MPI_COMM_WORLD),
            1e-10);
  }

  LevelVector<double>
  random_values(const MultigridLevel &level, const unsigned int seed)
  {
    LevelVector<double> result(level.layout);
    for (unsigned int i = 0; i < result.locally_owned_size(); ++i)
      result.local_element(i) =
        random_number(seed, level.layout->local_to_global(i));
    for (const unsigned int place : level.constrained)
      result.local_element(place) = 0.;
    return result;
  }

  void
  check_transfer(const std::string &name,
                 const NodalScene  &scene,
                 const bool         affine)
  {
    for (unsigned int l = 0; l + 1 < scene.levels().size(); ++l)
      {
        const MultigridLevel &above = scene.levels()[l],
                             &below = scene.levels()[l + 1];
        const LevelOperator<double>  fine(above, false), coarse(below, false);
        const DegreeTransfer<double> transfer(fine, coarse);
        const auto f = random_values(above, 1), c = random_values(below, 2);
        LevelVector<double> up(above.layout), down(below.layout);
        transfer.prolongate_add(up, c);
        transfer.restrict_to(down, f);
        const std::string level = name + ", level " + std::to_string(l + 1);
        verdict(level + ", restriction is the transpose",
                std::fabs(up * f - down * c) /
                  (up.l2_norm() * f.l2_norm() + down.l2_norm() * c.l2_norm()),
                1e-13);
        if (affine)
          verdict(level + ", the same function",
                  std::fabs(product<double>(above, up, up) /
                              product<double>(below, c, c) -
                            1.),
                  1e-12);
      }
  }

  void
  check_vertices(const std::string &name, const NodalScene &scene)
  {
    const MultigridLevel          &level = scene.levels().back();
    const LevelOperator<double>    K(level, false);
    const BlockCsrOperator<double> vertices(
      assemble_vertex_matrix(level).blocks);
    const auto          u = random_values(level, 1);
    LevelVector<double> expected(level.layout), from, to;
    K.vmult(expected, u);
    vertices.initialize(from);
    vertices.initialize(to);
    std::copy_n(u.begin(), u.locally_owned_size(), from.begin());
    vertices.vmult(to, from);
    double worst = 0.;
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      worst =
        std::max(worst,
                 std::fabs(expected.local_element(i) - to.local_element(i)));
    verdict(name + ", vertices",
            Utilities::MPI::max(worst, MPI_COMM_WORLD) / expected.linfty_norm(),
            1e-12);
  }

  void
  check(const std::string                            &name,
        const std::vector<std::string>               &kinds,
        const std::vector<std::vector<unsigned int>> &degrees)
  {
    const NodalScene scene = make_scene(kinds, degrees);
    const bool       affine =
      std::find(kinds.begin(), kinds.end(), "curved") == kinds.end();
    check_space(name, scene);
    check_transfer(name, scene, affine);
    if (affine) // else the products have fewer points
      check_vertices(name, scene);
  }
} // namespace mortise::testing

int
main(int argc, char **argv)
{
  using namespace mortise::testing;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (unsigned int p = 1; p <= mortise::max_degree; ++p)
    check("once, p = " + std::to_string(p), {"once"}, {{p}});
  for (const std::string kind : {"twice", "curved"})
    for (unsigned int p = 1; p <= 5; ++p)
      check(kind + ", p = " + std::to_string(p), {kind}, {{p}});
  check("three bodies, p = 4, 1, 2",
        {"once", "twice", "curved"},
        {{4}, {1}, {2}});

  check("p in 1, 2", {"once"}, {{1, 2}});
  check("p in 2, 3", {"once"}, {{2, 3}});
  check("p in 2, 4, 5", {"twice"}, {{2, 4, 5}});
  check("p in 1, 2, 3, 4, 6", {"twice"}, {{1, 2, 3, 4, 6}});
  check("p in 3, 8, 5", {"once"}, {{3, 8, 5}});
  check("p in 2, 3, 4, 5, curved", {"curved"}, {{2, 3, 4, 5}});
  check("tetrahedra, p in 1, 2", {"tetrahedra"}, {{1, 2}});
  check("tetrahedra, p in 2, 3", {"tetrahedra"}, {{2, 3}});
  check("tetrahedra, p in 1, 4, 3, 6", {"tetrahedra"}, {{1, 4, 3, 6}});
  check("tetrahedra, p in 8, 2", {"tetrahedra"}, {{8, 2}});
  check("hexahedra and tetrahedra, p in 2, 4; 3, 1, 5",
        {"once", "tetrahedra"},
        {{2, 4}, {3, 1, 5}});
  check("three bodies, p in 2, 4; 3; 1, 5",
        {"once", "twice", "curved"},
        {{2, 4}, {3}, {1, 5}});
}
