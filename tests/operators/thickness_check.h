// Checks of ThicknessCoarsening and its matrix on one scene.
#pragma once

#include <mortise/operators/levels/block_csr_operator.h>
#include <mortise/operators/levels/thickness_matrix.h>
#include <mortise/operators/levels/vertex_transfer.h>
#include <mortise/solvers/pseudo_random.h>

#include <cmath>

#include "nodal_scene.h"

namespace mortise::testing
{
  using namespace dealii;

  inline MeshParameters
  box(const std::string               &cells,
      const double                     height,
      const std::vector<unsigned int> &subdivisions)
  {
    MeshParameters result;
    result.source       = "box";
    result.cells        = cells;
    result.extent       = {0., 0., 0., 1., 2., height};
    result.subdivisions = subdivisions;
    return result;
  }

  /// The face with number 0 of each body is held, of that with number 2 the
  /// second component.
  inline NodalScene
  make_scene(const std::vector<MeshParameters> &meshes,
             const unsigned int                 degree)
  {
    return NodalScene(
      meshes,
      [&](Body &body) { body.create_space(degree, {}, ""); },
      [](const Body &body, AffineConstraints<double> &constraints) {
        if (!body.mesh.tetrahedra)
          hold_two_faces(body, constraints);
      });
  }

  /// Height of the lowest cells of the body beside the flat one.
  constexpr double layer = 0.5;

  /// Of flat bodies: x^p (1 + 100 z) y^(p - 1) or, on tetrahedra, whose
  /// polynomials have degree p as a whole, x^p + 100 z x^(p - 1). Of the other
  /// one: a polynomial of the lowest cells, whose nodes stay, which is gone
  /// above them.
  inline double
  function(const Body &body, const Point<dim> &x, const unsigned int p)
  {
    if (body.index == 1)
      return std::pow(x[0] * x[1], p) *
             std::max(0., 1. - std::pow(x[2] / layer, p));
    if (body.mesh.tetrahedra)
      return std::pow(x[0], p) + 100. * x[2] * std::pow(x[0], p - 1.);
    return std::pow(x[0], p) * (1. + 100. * x[2]) * std::pow(x[1], p - 1.);
  }

  inline void
  check(const std::string                 &name,
        const std::vector<MeshParameters> &meshes,
        const unsigned int                 degree,
        const types::global_dof_index      n_kept)
  {
    const NodalScene      scene = make_scene(meshes, degree);
    const MultigridLevel &level = scene.levels().front();
    const NodalSpace     &space = *level.space;
    const auto           &owned = space.owned_nodes();
    verdict(name + ": one level", scene.levels().size(), 1);

    std::vector<types::global_dof_index> beside;
    space.for_each_cell(
      [&](const Body &body, const auto &cell, const auto &nodes) {
        const auto positions = straight_positions(cell, degree);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          if (body.index == 1 && positions[i][2] == 0.)
            beside.push_back(nodes[i]);
      });
    const ThicknessCoarsening thickness =
      make_thickness_coarsening(space, beside, MPI_COMM_WORLD);
    const VertexCoarsening &rows = thickness.functions;
    verdict(name + ": nodes that stay",
            std::abs(double(rows.owned.size()) - double(n_kept)),
            0.);
    const VertexMatrix matrix = assemble_thickness_matrix(
      level, scene.system->elasticity(), thickness, {});
    const VertexTransfer<double> transfer(rows, matrix.blocks);

    LevelVector<double> exact(level.layout), fine(level.layout),
      coarse(matrix.blocks.layout);
    space.for_each_cell(
      [&](const Body &body, const auto &cell, const auto &nodes) {
        const auto positions = straight_positions(cell, degree);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          if (owned.is_element(nodes[i]))
            exact(dim * nodes[i]) = function(body, positions[i], degree);
      });
    for (unsigned int k = 0; k < rows.kept.size(); ++k)
      coarse.local_element(dim * k) = exact.local_element(dim * rows.kept[k]);
    transfer.prolongate_add(fine, coarse);
    fine -= exact;
    verdict(name + ": all degrees along, linear across",
            fine.linfty_norm(),
            1e-12);

    // of a function of all frequencies: P^T K P v . v = K P v . P v
    const LevelOperator<double> K(level, false);
    for (unsigned int i = 0; i < coarse.locally_owned_size(); ++i)
      coarse.local_element(i) =
        pseudo_random(coarse.get_partitioner()->local_range().first + i);
    for (const unsigned int i : constrained_components(matrix.blocks))
      coarse.local_element(i) = 0.;
    fine = 0.;
    transfer.prolongate_add(fine, coarse);
    K.clear_constrained(fine);
    LevelVector<double> force(level.layout), coarse_force(coarse);
    K.vmult(force, fine);
    transfer.restrict_to(coarse_force, force);
    for (const unsigned int i : constrained_components(matrix.blocks))
      coarse_force.local_element(i) = 0.;
    LevelVector<double>            product(coarse);
    const BlockCsrOperator<double> A(matrix.blocks);
    A.vmult(product, coarse);
    const double size = product.l2_norm();
    product -= coarse_force;
    verdict(name + ": P^T K P", product.l2_norm() / size, 1e-12);
  }
} // namespace mortise::testing
