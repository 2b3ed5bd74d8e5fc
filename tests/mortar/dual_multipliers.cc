// Proves what makes multipliers dual: each moves one node of the slave, with a
// positive weight; there are as many as standard ones; constants and
// polynomials are among them as they should be; nothing is lost between the two
// surfaces; as polynomials they do the same work. Held sides, hanging nodes,
// mixed degrees, faces covered in part and distorted faces included.
#include <mortise/mortar/nodal_block.h>
#include <verdict.h>

#include "multiplier_functions.h"

namespace mortise::testing
{
  using namespace dealii;

  TiedBody
  slave_box(const unsigned int p, const std::vector<Held> &dirichlet = {})
  {
    return {
      box_mesh({0., 0., 0., 1., 1., 1.}, {3, 2, 1}), "zmax", p, dirichlet, {}};
  }

  TiedBody
  master_box(const unsigned int p, const std::vector<double> &extent)
  {
    return {box_mesh(extent, {2, 4, 1}), "zmin", p, {}, {}};
  }

  const std::vector<double> above = {0., 0., 1., 1., 1., 2.},
                            half  = {0., 0., 1., 0.6, 1., 2.};

  TiedBody
  shell(const std::vector<double>       &radii,
        const std::vector<unsigned int> &cells,
        const std::string               &surface,
        const unsigned int               p)
  {
    MeshParameters mesh;
    mesh.source       = "shell octant";
    mesh.extent       = radii;
    mesh.subdivisions = cells;
    return {mesh, surface, p, {}, {}};
  }

  unsigned int
  n_dual(const TiedScene &scene)
  {
    unsigned int n = 0;
    for (const LocalCoupling &local : scene.coupling().local)
      n += local.is_dual() ? 1 : 0;
    return Utilities::MPI::sum(n, scene.comm);
  }

  unsigned int
  n_faces(const TiedScene &scene)
  {
    return Utilities::MPI::sum(scene.coupling().interface->slave().faces.size(),
                               scene.comm);
  }

  /// int psi_i phi_j of each dual face but for its diagonal, which is to be
  /// positive; and the sum of all but the area. Relative.
  double
  biorthogonality_error(const TiedScene &scene)
  {
    double error = 0.;
    for (unsigned int s = 0; s < scene.coupling().local.size(); ++s)
      {
        const LocalCoupling &local = scene.coupling().local[s];
        if (!local.is_dual())
          continue;
        const FaceTrace &trace = scene.coupling().interface->slave().traces[s];
        const BlockSide  side{trace.shape, trace.degree, trace.degree};
        const unsigned int n = local.mass.m();
        // (F^T A)^T: psi in nodal functions, from moments of N
        FullMatrix<double> moments(n, n), products(n, n);
        local.multiplier.mmult(moments, local.mass);
        moments.mmult(products,
                      face_nodal_basis(trace.shape, trace.degree).functions);
        double                   area = 0., sum = 0.;
        const FullMatrix<double> mass = nodal_block(local.mass, side, side);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            {
              area += mass(i, j);
              sum += products(i, j);
            }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            if (i != j)
              error = std::max(error, std::fabs(products(i, j)) / area);
            else if (!(products(i, i) > 0.))
              error = 1.;
        error = std::max(error, std::fabs(sum / area - 1.));
      }
    return Utilities::MPI::max(error, scene.comm);
  }

  /// Error of multiplier_on_faces() for the multipliers of @p function, a
  /// polynomial that they contain.
  double
  polynomial_error(const TiedScene &scene, const Field &function)
  {
    const BodySurface &slave  = scene.coupling().interface->slave();
    mortise::Vector    lambda = scene.multiplier();
    set_multiplier(scene.coupling(), values_at_nodes(slave, function), lambda);
    const auto polynomials =
      multiplier_on_faces(scene.coupling(), lambda, scene.comm);
    double error = 0.;
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      {
        const TraceBasis   &basis = slave.traces[s].basis();
        std::vector<double> values(basis.size());
        for (const auto &xi : face_lattice(basis))
          {
            basis.evaluate(xi[0], xi[1], values.data());
            Tensor<1, dim> difference =
              -function(face_point(slave.faces[s], xi));
            for (unsigned int r = 0; r < polynomials[s].size(); ++r)
              difference[r / basis.size()] +=
                polynomials[s][r] * values[r % basis.size()];
            error = std::max(error, difference.norm());
          }
      }
    return Utilities::MPI::max(error, scene.comm);
  }

  Field
  power(const unsigned int k)
  {
    return [k](const Point<dim> &x) {
      Tensor<1, dim> value;
      value[0] = std::pow(x[0] - 0.4, k);
      value[1] = std::pow(0.3 * x[0] + x[1], k);
      value[2] = std::pow(x[1], k) - 0.5;
      return value;
    };
  }

  /// Properties of all scenes.
  void
  check(const std::string &name,
        const TiedBody    &slave,
        const TiedBody    &master,
        const unsigned int reproduced)
  {
    const TiedScene standard(slave, master, MPI_COMM_WORLD, true),
      dual(slave, master, MPI_COMM_WORLD, true, MultiplierBasis::dual);
    verdict(name + ": as many as standard ones",
            std::fabs(double(dual.owned_multiplier.size()) -
                      double(standard.owned_multiplier.size())),
            0);
    verdict(name + ": biorthogonal", biorthogonality_error(dual), 1e-13);
    const TransferErrors errors =
      transfer_errors(dual.coupling(), dual.owned_multiplier, dual.comm);
    verdict(name + ": constants pass", errors.partition_of_unity, 1e-12);
    const Functions functions(dual);
    verdict(name + ": independent",
            functions.smallest_eigenvalue() > 1e-4 ? 0. : 1.,
            0);
    for (unsigned int k = 0; k <= reproduced; ++k)
      verdict(name + ": polynomials of degree " + std::to_string(k),
              functions.distance(power(k)),
              1e-11);
  }

  void
  check_boxes()
  {
    for (const unsigned int p : {1, 2, 4, 7})
      {
        const std::string name = "boxes, p = " + std::to_string(p);
        check(name, slave_box(p), master_box(p, above), p - 1);
        const TiedScene scene(slave_box(p),
                              master_box(p, above),
                              MPI_COMM_WORLD,
                              true,
                              MultiplierBasis::dual);
        verdict(name + ": all faces",
                std::fabs(double(n_faces(scene)) - n_dual(scene)),
                0);
        verdict(name + ": the same polynomial in both bases",
                polynomial_error(scene, power(p - 1)),
                1e-11);
      }
    check("sides held, p = 3",
          slave_box(3, {{"xmin", {}}, {"ymax", {{true, false, true}}}}),
          master_box(3, above),
          1);
    check("covered in part, p = 3", slave_box(3), master_box(2, half), 0);
    TiedBody hanging         = slave_box(3);
    hanging.mesh.refine_near = "1, 1, 1, 0.2, 1";
    check("hanging nodes, p = 3", hanging, master_box(3, above), 2);
    TiedBody mixed         = slave_box(2);
    mixed.mesh.refine_near = "1, 1, 1, 0.2, 1";
    mixed.degree_by_region = {{0, 2}, {3, 4}};
    check("hanging nodes, degrees 2 and 4", mixed, master_box(3, above), 1);
  }

  void
  check_shells()
  {
    for (const unsigned int p : {1, 3})
      check("shells, p = " + std::to_string(p),
            shell({1., 1.5}, {2, 1}, "outside", p),
            shell({1.5, 2.}, {3, 1}, "inside", p),
            0);
  }

  void
  check_triangles()
  {
    for (const unsigned int p : {1, 2})
      {
        TiedBody slave   = slave_box(p);
        slave.mesh.cells = "tetrahedra";
        const TiedScene scene(slave,
                              master_box(p, above),
                              MPI_COMM_WORLD,
                              true,
                              MultiplierBasis::dual);
        verdict("triangles, p = " + std::to_string(p) +
                  (p == 1 ? ": all are dual" : ": none is dual"),
                std::fabs(n_dual(scene) - (p == 1 ? n_faces(scene) : 0.)),
                0);
        check("triangles, p = " + std::to_string(p),
              slave,
              master_box(p, above),
              p - 1);
      }
  }
} // namespace mortise::testing

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  mortise::testing::check_boxes();
  mortise::testing::check_shells();
  mortise::testing::check_triangles();
}
