// Proves that the VTU files say what was solved for: that their points have the
// values of the finite element field and the stress of the law, for p = 1..6 on
// hexahedra and tetrahedra, mixed degrees, hanging nodes and curved cells, and
// in mixed form; that their cells are Lagrange cells of the degree of the field
// with their nodes in the order of VTK, and fill the body; that the file of an
// interface has the traction that the slave bears, the gap and the
// displacement; that the integrals of the traction are force and moment where
// faces are covered in part, and that it is no number where nothing faces;
// which arrays there are; and that one file of several ranks has what that of
// one rank has. Files hold fields in single precision.
#include <mortar/tied_scene.h>
#include <mortise/output/fields.h>
#include <temporary_file.h>
#include <verdict.h>

#include <filesystem>

#include "polynomial_field.h"
#include "surface_integral.h"
#include "vtk_nodes.h"

namespace mortise::testing
{
  using namespace dealii;

  constexpr double single = 3e-6;

  double
  pressure_at(const unsigned int p, const Point<dim> &x)
  {
    return std::pow(1. + 0.3 * x[0] - 0.2 * x[1] + 0.1 * x[2], p - 1);
  }

  struct Expected
  {
    unsigned int cells, points, type;
    double       size; ///< of all cells; 0: not known, cells are curved
    std::string  names;
  };

  std::string
  joined(const std::vector<std::string> &names)
  {
    std::string all;
    for (const std::string &name : names)
      all += (all.empty() ? "" : " ") + name;
    return all;
  }

  /// How far nodes of straight cells are from where VTK has them.
  double
  order_error(const VtuContent &file)
  {
    double error = 0.;
    for (unsigned int c = 0; c < file.cells.size(); ++c)
      {
        const unsigned int type = file.types[c];
        if (type < 69)
          continue; // of degree 1: has only corners
        const auto        &cell    = file.cells[c];
        const bool         simplex = type == 69 || type == 71;
        const unsigned int along[] = {1, simplex ? 2u : 3u, simplex ? 3u : 4u};
        unsigned int       degree  = 2;
        while (vtk_nodes(type, degree).size() < cell.size())
          ++degree;
        const auto nodes = vtk_nodes(type, degree);
        for (unsigned int i = 0; i < cell.size(); ++i)
          {
            Tensor<1, dim> off = file.points[cell[i]] - file.points[cell[0]];
            for (unsigned int d = 0; d < (type < 71 ? 2 : 3); ++d)
              off -= double(nodes[i][d]) / degree *
                     (file.points[cell[along[d]]] - file.points[cell[0]]);
            error = std::max(error, off.norm());
          }
      }
    return error;
  }

  /// On the first rank, what does not depend on the values; @p alone: as one
  /// rank writes it.
  void
  check_shape(const std::string &what,
              const VtuContent  &file,
              const VtuContent  &alone,
              const Expected    &expected)
  {
    const auto off = [](const double a, const double b) {
      return std::fabs(a - b);
    };
    verdict(what + ": cells", off(file.cells.size(), expected.cells), 0);
    verdict(what + ": points", off(file.points.size(), expected.points), 0);
    double total = 0., others = 0.;
    for (unsigned int c = 0; c < file.cells.size(); ++c)
      {
        others += file.types[c] == expected.type ? 0. : 1.;
        if (expected.size > 0.)
          total += size_of(file, c);
      }
    verdict(what + ": cells of other types", others, 0);
    if (expected.size > 0.)
      verdict(what + ": cells fill the body",
              off(total / expected.size, 1.),
              single);
    if (expected.size > 0.)
      verdict(what + ": nodes in the order of VTK", order_error(file), 1e-12);
    const std::string names = joined(file.names);
    verdict(what + ": arrays " + expected.names,
            names == expected.names ? 0 : 1,
            0);

    // the same points, each as often
    const auto sorted = [](const VtuContent &content) {
      std::vector<std::array<long, 3>> keys;
      for (const auto &x : content.points)
        keys.push_back({{std::lround(x[0] * 1e4),
                         std::lround(x[1] * 1e4),
                         std::lround(x[2] * 1e4)}});
      std::sort(keys.begin(), keys.end());
      return keys;
    };
    const auto got = sorted(file), wanted = sorted(alone);
    double     moved = off(got.size(), wanted.size());
    for (unsigned int i = 0; i < std::min(got.size(), wanted.size()); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        moved = std::max(moved, double(std::labs(got[i][d] - wanted[i][d])));
    verdict(what + ": points of one rank's file", moved, 1);
  }

  /// The largest difference of an array from a field, over the field's size.
  void
  check_array(
    const std::string                                            &what,
    const VtuContent                                             &file,
    const std::string                                            &name,
    const std::function<std::vector<double>(const Point<dim> &)> &field)
  {
    double      error = 0., size = 0.;
    const auto &got = file.data.at(name);
    if (got.size() != file.points.size())
      error = size = 1.;
    for (unsigned int i = 0; i < got.size(); ++i)
      {
        const auto expected = field(file.points[i]);
        if (expected.size() != got[i].size())
          error = std::numeric_limits<double>::infinity();
        for (unsigned int k = 0; k < expected.size(); ++k)
          {
            error = std::max(error, std::fabs(got[i].at(k) - expected[k]));
            size  = std::max(size, std::fabs(expected[k]));
          }
      }
    verdict(what + ": " + name, error / size, single);
  }

  std::vector<double>
  entries(const Tensor<1, dim> &value)
  {
    return {value[0], value[1], value[2]};
  }

  /// A body with a polynomial displacement and, in mixed form, pressure.
  struct Written
  {
    Written(const MeshParameters                             &mesh,
            const unsigned int                                p,
            const std::map<types::material_id, unsigned int> &by_region,
            const bool                                        mixed,
            const unsigned int                                degree_of_field,
            const MPI_Comm                                    comm)
      : body("body", 0, LinearElastic{2., 0.3, mixed})
    {
      body.create_mesh(mesh, comm, "");
      body.create_space(p, by_region, "");
      BodySolution solution;
      solution.displacement = interpolate(body, Polynomial{degree_of_field});
      if (mixed)
        solution.pressure =
          interpolate(body,
                      body.pressure->dof_handler,
                      body.pressure->relevant_dofs,
                      [&](const unsigned int, const Point<dim> &x) {
                        return pressure_at(degree_of_field, x);
                      });
      FieldSelection all;
      all.displacement = all.stress = all.pressure = true;
      const std::string place =
        temporary_file(comm == MPI_COMM_SELF ? "alone" : "");
      write_body_fields(body, solution, all, {}, place + "/body.vtu");
    }

    Body body;
  };

  /// @p volume 0: not by the corners of cells.
  void
  check_body(const std::string                                &what,
             const MeshParameters                             &mesh,
             const unsigned int                                p,
             const double                                      volume,
             const bool                                        mixed = false,
             const std::map<types::material_id, unsigned int> &by_region = {},
             const unsigned int degree_of_field                          = 0)
  {
    const unsigned int degree = degree_of_field > 0 ? degree_of_field : p;
    const Written together(mesh, p, by_region, mixed, degree, MPI_COMM_WORLD);
    const Body   &body = together.body;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        const Written    one(mesh, p, by_region, mixed, degree, MPI_COMM_SELF);
        const VtuContent file(temporary_file("body.vtu")),
          alone(temporary_file("alone/body.vtu"));
        const bool   tets     = body.mesh.tetrahedra;
        unsigned int n_points = 0;
        for (const auto &cell : one.body.dof_handler.active_cell_iterators())
          n_points += cell->get_fe().n_dofs_per_cell() / dim;
        check_shape(what,
                    file,
                    alone,
                    {unsigned(body.triangulation().n_global_active_cells()),
                     n_points,
                     p > 1 ? (tets ? 71u : 72u) : (tets ? 10u : 12u),
                     volume,
                     "displacement stress von_mises pressure"});
        const Polynomial u{degree};
        const auto       stress = [&](const Point<dim> &x) {
          const auto strain = symmetrize(u.gradient(x));
          return mixed ? body.material.stress(strain, pressure_at(degree, x)) :
                               body.material.stress(strain);
        };
        check_array(what, file, "displacement", [&](const auto &x) {
          return entries(u(x));
        });
        check_array(what, file, "stress", [&](const auto &x) {
          std::vector<double> all;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              all.push_back(stress(x)[i][j]);
          return all;
        });
        check_array(what, file, "von_mises", [&](const auto &x) {
          const auto s = stress(x);
          return std::vector<double>{std::sqrt(
            (std::pow(s[0][0] - s[1][1], 2) + std::pow(s[1][1] - s[2][2], 2) +
             std::pow(s[2][2] - s[0][0], 2)) /
              2. +
            3. * (s[0][1] * s[0][1] + s[1][2] * s[1][2] + s[2][0] * s[2][0]))};
        });
        check_array(what, file, "pressure", [&](const auto &x) {
          const auto s = stress(x);
          return std::vector<double>{-(s[0][0] + s[1][1] + s[2][2]) / 3.};
        });
      }
    MPI_Barrier(MPI_COMM_WORLD);
  }

  MeshParameters
  box(const bool tetrahedra)
  {
    MeshParameters mesh =
      box_mesh({0., 0., 0., 1., 0.8, 0.6}, {2, 2, 2}, tetrahedra);
    mesh.rotate = {{20., -30., 40.}};
    return mesh;
  }

  void
  check_bodies()
  {
    constexpr double volume = 0.48;
    for (const bool tetrahedra : {false, true})
      {
        const std::string kind = tetrahedra ? "tetrahedra" : "hexahedra";
        for (const unsigned int p : {1, 2, 3, 4, 5, 6})
          check_body(kind + ", p = " + std::to_string(p),
                     box(tetrahedra),
                     p,
                     volume);
        check_body(kind + " in mixed form", box(tetrahedra), 3, volume, true);
        check_body(kind + " of degrees 2, 3, 4",
                   box(tetrahedra),
                   2,
                   volume,
                   false,
                   {{1, 3}, {2, 4}, {7, 3}},
                   2);
      }
    MeshParameters hanging = box(false);
    hanging.rotate         = {};
    hanging.refine_near    = "0, 0, 0, 0.1, 2";
    check_body("hanging nodes", hanging, 3, volume);
    MeshParameters curved;
    curved.source       = "shell octant";
    curved.extent       = {1., 2.};
    curved.subdivisions = {2, 1};
    check_body("curved hexahedra", curved, 3, 0., false, {}, 1);
    curved.cells = "tetrahedra";
    check_body("curved tetrahedra", curved, 3, 0., false, {}, 1);
  }

  /// A wedge of air between the two: the gap is linear.
  double
  gap(const Point<dim> &x)
  {
    return 0.02 + 0.03 * x[0];
  }

  void
  write_interface(const bool         tetrahedra,
                  const unsigned int p,
                  const MPI_Comm     comm)
  {
    TiedBody master{
      box_mesh({0., 0., 1.02, 1., 1., 2.}, {2, 3, 1}), "zmin", 1, {}, {}};
    master.mesh.bottom_slope = {{0.03, 0.}};
    const TiedScene scene(
      {box_mesh({0., 0., 0., 1., 1., 1.}, {3, 2, 1}, tetrahedra),
       "zmax",
       p,
       {},
       {}},
      master,
      comm);
    mortise::Vector lambda = scene.multiplier();
    set_multiplier(scene.coupling(),
                   values_at_nodes(scene.coupling().interface->slave(),
                                   Polynomial{p}),
                   lambda);
    write_interface_fields(*scene.bodies[0],
                           scene.coupling(),
                           multiplier_on_faces(scene.coupling(), lambda, comm),
                           {},
                           interpolate(*scene.bodies[0], Polynomial{1}),
                           temporary_file(comm == MPI_COMM_SELF ?
                                            "alone/glue.vtu" :
                                            "glue.vtu"));
  }

  void
  check_interface(const bool tetrahedra, const unsigned int p)
  {
    const std::string what =
      std::string(tetrahedra ? "triangles" : "quadrilaterals") +
      ", p = " + std::to_string(p);
    write_interface(tetrahedra, p, MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        write_interface(tetrahedra, p, MPI_COMM_SELF);
        const VtuContent file(temporary_file("glue.vtu")),
          alone(temporary_file("alone/glue.vtu"));
        check_shape(what,
                    file,
                    alone,
                    {tetrahedra ? 12u : 6u,
                     tetrahedra ? 6 * (p + 1) * (p + 2) : 6 * (p + 1) * (p + 1),
                     p > 1 ? (tetrahedra ? 69u : 70u) : (tetrahedra ? 5u : 9u),
                     1.,
                     "traction gap displacement"});
        check_array(what, file, "traction", [&](const auto &x) {
          return entries(-Polynomial{p}(x));
        });
        check_array(what, file, "gap", [&](const auto &x) {
          return std::vector<double>{0., 0., gap(x)};
        });
        check_array(what, file, "displacement", [&](const auto &x) {
          return entries(Polynomial{1}(x));
        });
      }
    MPI_Barrier(MPI_COMM_WORLD);
  }

  /// A master that faces the slave in 0.3 < x, 0.05 < y < 0.9 alone; no face is
  /// covered so little that its multipliers are those of others.
  void
  write_part(const bool tetrahedra, const unsigned int p, const MPI_Comm comm)
  {
    const TiedScene scene(
      {box_mesh({0., 0., 0., 1., 1., 1.}, {4, 4, 1}, tetrahedra),
       "zmax",
       p,
       {},
       {}},
      {box_mesh({0.3, 0.05, 1., 1.4, 0.9, 2.}, {3, 2, 1}), "zmin", 1, {}, {}},
      comm);
    mortise::Vector lambda = scene.multiplier();
    set_multiplier(scene.coupling(),
                   values_at_nodes(scene.coupling().interface->slave(),
                                   Polynomial{1}),
                   lambda);
    write_interface_fields(*scene.bodies[0],
                           scene.coupling(),
                           multiplier_on_faces(scene.coupling(), lambda, comm),
                           {},
                           interpolate(*scene.bodies[0], Polynomial{1}),
                           temporary_file("part.vtu"));
  }

  void
  check_part(const bool tetrahedra, const unsigned int p)
  {
    write_part(tetrahedra, p, MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        const std::string what =
          std::string(tetrahedra ? "triangles" : "quadrilaterals") +
          " covered in part, p = " + std::to_string(p);
        const VtuContent file(temporary_file("part.vtu"));
        const auto       got = surface_integrals(file, "traction");
        Tensor<1, dim>   force, moment;
        const QGauss<2>  gauss(3);
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const Point<dim>     x(0.3 + 0.7 * gauss.point(q)[0],
                               0.05 + 0.85 * gauss.point(q)[1],
                               1.);
            const Tensor<1, dim> t =
              -0.595 * gauss.weight(q) * Polynomial{1}(x);
            force += t;
            moment += cross_product_3d(x, t);
          }
        verdict(what + ": force",
                (got.force - force).norm() / force.norm(),
                1e-7);
        verdict(what + ": moment",
                (got.moment - moment).norm() / moment.norm(),
                1e-7);
        double       covered = 0.;
        unsigned int n_none  = 0;
        for (unsigned int c = 0; c < file.cells.size(); ++c)
          {
            covered += file.data.at("covered")[c][0] * size_of(file, c);
            n_none += file.data.at("covered")[c][0] == 0. ? 1 : 0;
          }
        verdict(what + ": covered area", std::fabs(covered / 0.595 - 1.), 1e-7);
        verdict(what + ": no number where nothing faces",
                n_none > 0 && got.n_without == n_none ? 0 : 1,
                0);
      }
    MPI_Barrier(MPI_COMM_WORLD);
  }

  /// One coordinate of the centre of each cell.
  std::vector<double>
  places(const Body &body)
  {
    std::vector<double> result;
    for (const auto &cell : body.triangulation().active_cell_iterators())
      result.push_back(cell->center()[0]);
    return result;
  }

  /// Only the arrays that were asked for.
  void
  check_selection(const FieldSelection &selection, const std::string &names)
  {
    for (const bool tetrahedra : {false, true})
      {
        Body body("body", 0, LinearElastic{2., 0.3});
        body.create_mesh(box(tetrahedra), MPI_COMM_WORLD, "");
        body.create_space(2, {}, "");
        write_body_fields(body,
                          {interpolate(body, Polynomial{2}), {}},
                          selection,
                          {{"place", places(body)}},
                          temporary_file("body.vtu"));
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          {
            const VtuContent  file(temporary_file("body.vtu"));
            const std::string what = tetrahedra ? "tetrahedra" : "hexahedra";
            verdict(what + ": only " + names,
                    joined(file.names) == names &&
                        joined(file.cell_names) == "place" ?
                      0 :
                      1,
                    0);
            double error = 0.;
            for (unsigned int c = 0; c < file.cells.size(); ++c)
              {
                const unsigned int n_corners = tetrahedra ? 4 : 8;
                double             centre    = 0.;
                for (unsigned int v = 0; v < n_corners; ++v)
                  centre += file.points[file.cells[c][v]][0] / n_corners;
                if (std::fabs(file.data.at("place").at(c)[0] - centre) > 1e-6)
                  error = 1.;
              }
            verdict(what + ": numbers of cells", error, 0.);
          }
        MPI_Barrier(MPI_COMM_WORLD);
      }
  }
} // namespace mortise::testing

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  using namespace mortise::testing;
  std::filesystem::create_directories(temporary_file("alone"));
  check_bodies();
  for (const bool tetrahedra : {false, true})
    for (const unsigned int p : {1, 2, 3, 5})
      check_interface(tetrahedra, p);
  for (const bool tetrahedra : {false, true})
    for (const unsigned int p : {1, 2, 4})
      check_part(tetrahedra, p);
  mortise::FieldSelection selection;
  selection.displacement = true;
  check_selection(selection, "displacement");
  selection.stress = true;
  check_selection(selection, "displacement stress von_mises");
  selection.stress       = false;
  selection.displacement = false;
  selection.pressure     = true;
  check_selection(selection, "pressure");
}
