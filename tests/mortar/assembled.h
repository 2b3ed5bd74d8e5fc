// A tied scene with its matrices, and two boxes for it.
#pragma once

#include <verdict.h>

#include <numeric>

#include "tied_scene.h"

namespace mortise::testing
{
  using namespace dealii;
  using Index = types::global_dof_index;

  /// A polynomial of degree @p p.
  inline Field
  polynomial(const unsigned int p, const double seed = 0.)
  {
    return [=](const Point<dim> &x) {
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = std::pow(1. + c + seed + (0.7 - 0.4 * c) * x[0] +
                              (0.3 + 0.5 * c - seed) * x[1] + 0.2 * x[2],
                            p);
      return value;
    };
  }

  /// A displacement of size 1 without any order.
  inline mortise::Vector
  random(const IndexSet &owned, const MPI_Comm comm)
  {
    mortise::Vector u(owned, comm);
    for (const auto i : owned)
      u(i) = std::sin(12.9898 * (i + 1.)) * std::cos(3.7 * i);
    return u;
  }

  /// A scene with its matrices.
  struct Assembled
  {
    Assembled(const TiedBody &slave,
              const TiedBody &master,
              const MPI_Comm  comm = MPI_COMM_WORLD)
      : scene(slave, master, comm)
      , B(scene.constraint())
    {}

    mortise::Vector
    constraint(const mortise::Vector &u) const
    {
      mortise::Vector result = scene.multiplier();
      B.vmult(result, u);
      return result;
    }

    /// sqrt(sum_ij B_ij^2)
    double
    norm() const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < B.n_rows(); ++i)
        {
          const auto row = B.row(i);
          sum += std::inner_product(row.values,
                                    row.values + row.length,
                                    row.values,
                                    0.);
        }
      return std::sqrt(Utilities::MPI::sum(sum, scene.comm));
    }

    mortise::Vector
    interpolate(const Field &on_slave, const Field &on_master) const
    {
      mortise::Vector u = scene.displacement();
      scene.interpolate(0, on_slave, u);
      scene.interpolate(1, on_master, u);
      return u;
    }

    /// |B u| where both sides have @p function, over that where one has.
    double
    residual(const Field &function) const
    {
      mortise::Vector one_side = scene.displacement();
      scene.interpolate(0, function, one_side);
      return constraint(interpolate(function, function)).linfty_norm() /
             constraint(one_side).linfty_norm();
    }

    TiedScene             scene;
    mortise::SparseMatrix B;
  };

  /// int q u over the faces of one side, @p u by its coefficients; the faces
  /// are affine.
  inline double
  surface_integral(const TiedScene       &scene,
                   const BodySurface     &surface,
                   const mortise::Vector &u,
                   const Field           &q)
  {
    IndexSet relevant = u.locally_owned_elements();
    for (const FaceTrace &trace : surface.traces)
      relevant.add_indices(trace.column.begin(), trace.column.end());
    mortise::Vector all(u.locally_owned_elements(), relevant, scene.comm);
    all = u;
    all.update_ghost_values();
    double sum = 0.;
    for (unsigned int s = 0; s < surface.faces.size(); ++s)
      {
        const FaceTrace    &trace = surface.traces[s];
        const unsigned int  n     = trace.n_functions();
        const auto         &along = surface.faces[s].frame.tangent;
        const double        area  = cross_product_3d(along[0], along[1]).norm();
        const auto          rule  = face_rule(trace.shape, 8);
        std::vector<double> values(n);
        for (unsigned int r = 0; r < rule.size(); ++r)
          {
            const Point<2> &xi = rule.point(r);
            trace.basis().evaluate(xi[0], xi[1], values.data());
            const auto factor = q(face_point(surface.faces[s], xi));
            for (unsigned int row = 0; row < dim * n; ++row)
              for (unsigned int e = trace.begin[row]; e < trace.begin[row + 1];
                   ++e)
                sum += rule.weight(r) * area * factor[row / n] *
                       values[row % n] * trace.weight[e] * all(trace.column[e]);
          }
      }
    return Utilities::MPI::sum(sum, scene.comm);
  }

  inline TiedBody
  lower(const unsigned int p, const bool tetrahedra = false)
  {
    return {box_mesh({0., 0., 0., 1., 1., 1.}, {3, 2, 1}, tetrahedra),
            "zmax",
            p,
            {},
            {}};
  }

  inline TiedBody
  upper(const unsigned int p, const bool tetrahedra = false)
  {
    return {box_mesh({0., 0., 1., 1., 1., 2.}, {2, 3, 1}, tetrahedra),
            "zmin",
            p,
            {},
            {}};
  }

  inline void
  turn(TiedBody &body)
  {
    body.mesh.rotate    = {{20., 30., 40.}};
    body.mesh.translate = {{0.1, -0.2, 0.3}};
  }
} // namespace mortise::testing
