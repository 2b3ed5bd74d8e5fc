// Proves that multipliers are as many as the free displacements of the slave
// surface, or fewer on triangles beside rims, and independent; that they hold
// constants wherever a face is covered, polynomials of the full degree where
// nothing is prescribed and of one degree less beside a clamped rim, component
// by component for symmetry planes; that they are continuous across hanging
// nodes and mixed degrees; and which are left on faces that are covered in
// part. The same on every number of ranks.
#include <verdict.h>

#include "multiplier_functions.h"

namespace mortise::testing
{
  using namespace dealii;

  constexpr std::array<bool, dim> all{{true, true, true}},
    only_x{{true, false, false}}, only_y{{false, true, false}};

  TiedBody
  slave_box(const unsigned int       p,
            const unsigned int       n,
            const unsigned int       m,
            const bool               tetrahedra,
            const std::vector<Held> &dirichlet = {})
  {
    return {box_mesh({0., 0., 0., 1., 1., 1.}, {n, m, 1}, tetrahedra),
            "zmax",
            p,
            dirichlet,
            {}};
  }

  TiedBody
  master_box(const double end = 1.)
  {
    return {box_mesh({0., 0., 1., end, 1., 2.}, {2, 3, 1}), "zmin", 1, {}, {}};
  }

  /// On the slave surface, by component, over all ranks.
  using Counts = std::array<unsigned int, dim>;

  Counts
  count_multipliers(const TiedScene &scene)
  {
    Counts      counts{};
    const auto &dofs = scene.coupling().multipliers->slave_dofs();
    const std::set<types::global_dof_index> own(dofs.begin(), dofs.end());
    for (unsigned int c = 0; c < dim; ++c)
      {
        std::set<types::global_dof_index> of_component;
        for (const auto &[cell, f] :
             boundary_faces(*scene.bodies[0], scene.surface(0)))
          {
            const auto of_face = face_dofs(cell, f);
            for (const auto dof : of_face[c])
              if (own.count(dof) > 0)
                of_component.insert(dof);
          }
        counts[c] = Utilities::MPI::sum(of_component.size(), scene.comm);
      }
    return counts;
  }

  /// Displacements of the slave surface that nothing prescribes and that do
  /// not follow from others.
  Counts
  count_free(const TiedScene &scene)
  {
    Counts counts{};
    for (unsigned int c = 0; c < dim; ++c)
      {
        std::set<types::global_dof_index> free;
        for (const auto &[cell, f] :
             boundary_faces(*scene.bodies[0], scene.surface(0)))
          {
            const auto of_face = face_dofs(cell, f);
            for (const auto dof : of_face[c])
              if (scene.bodies[0]->dof_handler.locally_owned_dofs().is_element(
                    dof) &&
                  !scene.constraints[0].is_constrained(dof))
                free.insert(dof);
          }
        counts[c] = Utilities::MPI::sum(free.size(), scene.comm);
      }
    return counts;
  }

  double
  difference(const Counts &a, const Counts &b)
  {
    double sum = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      sum += std::fabs(double(a[c]) - double(b[c]));
    return sum;
  }

  /// A polynomial with all terms of degree @p p.
  Field
  polynomial(const unsigned int p)
  {
    return [p](const Point<dim> &x) {
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = std::pow(1. + c + (0.7 - 0.4 * c) * x[0] +
                              (0.3 + 0.5 * c) * x[1] - 0.2 * x[2],
                            p);
      return value;
    };
  }

  /// Faces and components that are covered without holding constants.
  double
  n_without_constants(const TiedScene &scene)
  {
    unsigned int n = 0;
    for (unsigned int s = 0; s < scene.states.size(); ++s)
      if (is_covered(scene, s))
        for (const bool dirichlet :
             scene.coupling().multipliers->rows()[s].reproduce_constants)
          n += dirichlet ? 0 : 1;
    return Utilities::MPI::sum(n, scene.comm);
  }

  /// Properties of every space: independence, constants, polynomials of degree
  /// @p p.
  void
  check_space(const std::string &what,
              const TiedScene   &scene,
              const unsigned int p)
  {
    const Functions functions(scene);
    verdict(what + ": independent, eigenvalues above 1e-5",
            1e-5 - functions.smallest_eigenvalue(),
            0);
    verdict(what + ": constants 1e-12",
            functions.distance(polynomial(0)),
            1e-12);
    verdict(what + ": polynomials of degree " + std::to_string(p) + " 1e-11",
            functions.distance(polynomial(p)),
            1e-11);
    verdict(what + ": faces without constants", n_without_constants(scene), 0);
  }

  const Held xmin{"xmin", all}, xmax{"xmax", all}, ymin{"ymin", all},
    ymax{"ymax", all};

  /// @p ends: by component and direction, how many of the two ends are held;
  /// all numbers of a product of intervals.
  void
  check_quadrilaterals(const std::string       &what,
                       const std::vector<Held> &dirichlet,
                       const unsigned int (&ends)[dim][2],
                       const unsigned int n,
                       const unsigned int m)
  {
    for (const unsigned int p : {1, 2, 4})
      {
        const TiedScene   scene(slave_box(p, n, m, false, dirichlet),
                              master_box());
        const std::string name = what + ", p = " + std::to_string(p);
        Counts            expected{};
        unsigned int      less = 0;
        for (unsigned int c = 0; c < dim; ++c)
          {
            expected[c] = (n * p + 1 - ends[c][0]) * (m * p + 1 - ends[c][1]);
            // two rims of one face take a degree each
            for (const unsigned int d : {0, 1})
              less = std::max(less,
                              ends[c][d] == 2 && (d == 0 ? n : m) == 1 ?
                                2u :
                                std::min(1u, ends[c][d]));
          }
        verdict(name + ": count",
                difference(count_multipliers(scene), expected),
                0);
        check_space(name, scene, p > less ? p - less : 0);
      }
  }

  void
  check_triangles(const std::string       &what,
                  const std::vector<Held> &dirichlet,
                  const unsigned int       less)
  {
    constexpr unsigned int n = 3, m = 2;
    for (const unsigned int p : {1, 2, 4})
      {
        const TiedScene   scene(slave_box(p, n, m, true, dirichlet),
                              master_box());
        const std::string name          = what + ", p = " + std::to_string(p);
        const Counts      counts        = count_multipliers(scene),
                     free               = count_free(scene);
        constexpr unsigned int vertices = (n + 1) * (m + 1), faces = 2 * n * m,
                               edges = vertices + faces - 1;
        const unsigned int on_all =
          vertices + (p - 1) * edges + (p - 1) * (p - 2) / 2 * faces;
        if (dirichlet.empty())
          verdict(name + ": count",
                  difference(counts, {{on_all, on_all, on_all}}),
                  0);
        double more = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          more = std::max(more, double(counts[c]) - double(free[c]));
        verdict(name + ": no more than free displacements", more, 0);
        check_space(name, scene, p > less ? p - less : 0);
      }
  }

  /// The largest jump of a multiplier between two faces of this rank.
  double
  largest_jump(const TiedScene &scene)
  {
    mortise::Vector lambda = scene.multiplier();
    for (const auto i : scene.owned_multiplier)
      lambda(i) = std::sin(1. + 7. * i);
    const auto coefficients =
      multiplier_on_faces(scene.coupling(), lambda, scene.comm);
    const BodySurface &slave = scene.coupling().interface->slave();
    const auto         value = [&](const unsigned int s, const Point<2> &xi) {
      const TraceBasis   &basis = slave.traces[s].basis();
      std::vector<double> values(basis.size());
      basis.evaluate(xi[0], xi[1], values.data());
      Tensor<1, dim> result;
      for (unsigned int r = 0; r < coefficients[s].size(); ++r)
        result[r / basis.size()] +=
          coefficients[s][r] * values[r % basis.size()];
      return result;
    };
    double jump = 0.;
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      for (unsigned int e = 0; e < slave.traces[s].basis().n_edges(); ++e)
        for (const double t : {0., 0.3, 1.})
          {
            const auto     on_edge = slave.traces[s].basis().edge_point(e, t);
            const Point<2> xi(on_edge[0], on_edge[1]);
            const auto     x = face_point(slave.faces[s], xi);
            for (unsigned int other = 0; other < slave.faces.size(); ++other)
              {
                const FaceFrame &frame  = slave.faces[other].frame;
                const double     eta[2] = {frame.center_xi +
                                             frame.dual[0] * (x - frame.center),
                                           frame.center_xi +
                                             frame.dual[1] * (x - frame.center)};
                bool             inside = true;
                for (const unsigned int side :
                     sides_of(slave.faces[other].shape))
                  inside = inside && inside_by(eta, side) > -1e-10;
                if (inside)
                  jump = std::max(
                    jump,
                    (value(s, xi) - value(other, {eta[0], eta[1]})).norm());
              }
          }
    return Utilities::MPI::max(jump, scene.comm);
  }

  /// Hanging nodes and mixed degrees: the conforming trace space.
  void
  check_conforming(const std::string &what,
                   const TiedBody    &slave,
                   const unsigned int p)
  {
    const TiedScene scene(slave, master_box());
    verdict(what + ": as many as free displacements",
            difference(count_multipliers(scene), count_free(scene)),
            0);
    verdict(what + ": jumps 1e-11", largest_jump(scene), 1e-11);
    check_space(what, scene, p);
  }

  void
  check_hanging(const unsigned int p)
  {
    const std::string name  = ", p = " + std::to_string(p);
    TiedBody          slave = slave_box(p, 2, 2, false);
    slave.mesh.refine_near  = "0, 0, 1, 0.1, 2; 1, 1, 1, 0.1, 1";
    check_conforming("hanging nodes" + name, slave, p);
    slave.dirichlet = {ymax};
    check_conforming("hanging nodes off a rim" + name, slave, p - 1);
  }

  void
  check_mixed_degrees()
  {
    TiedBody slave          = slave_box(2, 4, 2, false);
    slave.mesh.subdivisions = {4, 2, 2};
    slave.degree_by_region  = {{4, 3}, {5, 2}, {6, 4}, {7, 3}};
    check_conforming("degrees 2, 3, 4", slave, 2);
    slave.dirichlet = {xmin};
    check_conforming("degrees 2, 3, 4 beside a rim", slave, 1);
    slave                   = slave_box(1, 4, 2, true);
    slave.mesh.subdivisions = {4, 2, 2};
    slave.degree_by_region  = {{4, 3}, {5, 1}, {6, 2}, {7, 2}};
    check_conforming("tetrahedra of degrees 1, 2, 3", slave, 1);
  }

  /// A master over the first @p end of four columns of slave faces: @p full
  /// of them are covered, and the next by more or less than a tenth.
  void
  check_partial(const std::string &what, const double end, const bool sliver)
  {
    constexpr unsigned int m = 2;
    for (const unsigned int p : {1, 2, 4})
      {
        const TiedScene    scene(slave_box(p, 4, m, false), master_box(end));
        const std::string  name = what + ", p = " + std::to_string(p);
        const unsigned int one =
          (2 * p + 1) * (m * p + 1) + (sliver ? 0 : m + 1);
        verdict(name + ": count",
                difference(count_multipliers(scene), {{one, one, one}}),
                0);
        check_space(name, scene, sliver ? 0 : 1);
      }
  }
} // namespace mortise::testing

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  using namespace mortise::testing;
  check_quadrilaterals("squares", {}, {{0, 0}, {0, 0}, {0, 0}}, 3, 2);
  check_quadrilaterals("a rim", {xmin}, {{1, 0}, {1, 0}, {1, 0}}, 3, 2);
  check_quadrilaterals(
    "two rims", {xmin, xmax}, {{2, 0}, {2, 0}, {2, 0}}, 3, 2);
  check_quadrilaterals("rims all around",
                       {xmin, xmax, ymin, ymax},
                       {{2, 2}, {2, 2}, {2, 2}},
                       3,
                       2);
  check_quadrilaterals("symmetry planes",
                       {{"xmin", only_x}, {"ymin", only_y}},
                       {{1, 0}, {0, 1}, {0, 0}},
                       3,
                       2);
  check_triangles("triangles", {}, 0);
  check_triangles("triangles beside a rim", {xmin}, 1);
  check_triangles("triangles with rims all around",
                  {xmin, xmax, ymin, ymax},
                  2);
  check_triangles("triangles at symmetry planes",
                  {{"xmin", only_x}, {"ymin", only_y}},
                  1);
  for (const unsigned int p : {1, 2, 3, 4})
    check_hanging(p);
  check_mixed_degrees();
  check_partial("partial cover", 0.55, false);
  check_partial("slivers", 0.51, true);
}
