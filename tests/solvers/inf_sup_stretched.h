// The inf-sup constant of pressures in a deformed state: with G, A and M of the
// program's own tangent there.
#pragma once

#include <mortise/material/invariant_laws.h>
#include <mortise/operators/boundary_nodes.h>
#include <mortise/operators/bulk_system.h>

#include <functional>

#include "inf_sup.h"

namespace mortise::testing
{
  using Deformation =
    std::function<dealii::Point<dim>(const dealii::Point<dim> &)>;

  /// Those without change of volume: "stretch", by @p size along x and as much
  /// less across, "press", by it along x and y, "shear", by it, and "twist"
  /// around z, by as many right angles over the height 1.
  inline Deformation
  deformation(const std::string &kind, const double size)
  {
    return [kind, size](const dealii::Point<dim> &x) {
      using Place         = dealii::Point<dim>;
      const double narrow = 1. / std::sqrt(size),
                   angle  = 0.5 * dealii::numbers::PI * size * x[2],
                   c = std::cos(angle), s = std::sin(angle);
      if (kind == "stretch")
        return Place(size * x[0], narrow * x[1], narrow * x[2]);
      if (kind == "press")
        return Place(size * x[0], size * x[1], x[2] / (size * size));
      if (kind == "shear")
        return Place(x[0] + size * x[1], x[1], x[2]);
      if (kind == "twist")
        return Place(c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]);
      throw std::runtime_error(kind + ": no deformation");
    };
  }

  /// As pressure_inf_sup(), of a neo-Hookean body without pressure that is held
  /// on its whole boundary while it is deformed by @p x_of: A is its tangent,
  ///
  ///     u.A v = mu int (grad u : grad v^T + Grad u : Grad v) + 1/4 div u div v
  ///
  /// and G, div and grad are those of the deformed configuration. No hanging
  /// nodes, one rank.
  inline PressureInfSup
  stretched_inf_sup(const InfSupBody &given, const Deformation &x_of)
  {
    const LinearElastic hooke{1.5, 0.5, true};
    Body                body("body",
              0,
              Material(hooke,
                       std::make_shared<NeoHookean>(hooke.displacement_lambda(),
                                                    hooke.lame_mu())));
    body.create_mesh(given.mesh, MPI_COMM_WORLD, "inf-sup");
    body.create_space(given.degree, {}, "inf-sup");
    const SceneField      field = displacement_field(body, given);
    BulkSystem            bulk(make_nodal_spaces({&body}, MPI_COMM_WORLD),
                    make_nodal_pressures({&body}, MPI_COMM_WORLD),
                    BulkSystem::Scene{field.numbering, field.constraints},
                    MPI_COMM_WORLD);
    const MultigridLevel &level = bulk.levels().front();

    SystemVector state;
    bulk.initialize(state.displacement);
    bulk.initialize_pressure(state.pressure);
    LevelVector<double> all(state.displacement);
    all              = 1.;
    const auto nodes = node_positions(level, body, all);
    for (unsigned int i = 0; i < nodes.locally_owned_size(); i += dim)
      {
        dealii::Point<dim> X;
        for (unsigned int c = 0; c < dim; ++c)
          X[c] = nodes.local_element(i + c);
        const dealii::Point<dim> x = x_of(X);
        for (unsigned int c = 0; c < dim; ++c)
          state.displacement.local_element(i + c) = x[c] - X[c];
      }
    bulk.linearise(state, nullptr, bulk.no_history(), {}, nullptr, true);

    const unsigned int n_u = state.displacement.size(),
                       n_p = state.pressure.size();
    Indices free;
    for (unsigned int i = 0; i < n_u; ++i)
      if (!std::binary_search(level.constrained.begin(),
                              level.constrained.end(),
                              i))
        free.push_back(i);
    std::vector<SparseMatrix::Entry> stiffness, divergence;
    DenseMatrix                      M(n_p, n_p);
    Vector                           u, of_u, p, of_p;
    bulk.initialize(u);
    bulk.initialize(of_u);
    bulk.initialize_pressure(p);
    bulk.initialize_pressure(of_p);
    for (unsigned int j = 0; j < free.size(); ++j)
      {
        u          = 0.;
        u(free[j]) = 1.;
        bulk.apply_mixed(of_u, of_p, u, p);
        for (unsigned int i = 0; i < free.size(); ++i)
          if (of_u(free[i]) != 0.)
            stiffness.push_back({i, j, of_u(free[i])});
        for (unsigned int k = 0; k < n_p; ++k)
          if (of_p(k) != 0.)
            divergence.push_back({k, j, of_p(k)});
      }
    for (unsigned int j = 0; j < n_p; ++j)
      {
        p    = 0.;
        p(j) = 1.;
        bulk.apply_pressure_mass(of_p, p);
        for (unsigned int i = 0; i < n_p; ++i)
          M(i, j) = of_p(i) / hooke.pressure_norm();
      }
    const auto matrix = [&](const unsigned int                      n_rows,
                            const std::vector<SparseMatrix::Entry> &entries) {
      return SparseMatrix(dealii::complete_index_set(n_rows),
                          dealii::complete_index_set(free.size()),
                          MPI_COMM_WORLD,
                          entries);
    };
    Indices rows(n_p), columns(free.size());
    std::iota(rows.begin(), rows.end(), 0);
    std::iota(columns.begin(), columns.end(), 0);
    const DenseMatrix S = schur_complement(matrix(free.size(), stiffness),
                                           matrix(n_p, divergence),
                                           rows,
                                           places(free.size(), columns));
    return pressure_result(free.size(), S, M, true);
  }
} // namespace mortise::testing
