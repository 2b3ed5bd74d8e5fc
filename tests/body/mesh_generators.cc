// Generated meshes: boundaries with their names and areas, volumes, materials,
// order of cells, conformity of the two halves, refinement, placement; the same
// on any number of ranks.

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <mortise/base/error.h>
#include <mortise/body/mesh/manifolds.h>
#include <mortise/body/mesh/mesh_source.h>
#include <verdict.h>

#include <cmath>
#include <iostream>

using namespace mortise;
using namespace dealii;

namespace
{
  constexpr double pi = numbers::PI;

  /// Volume, area of each boundary, and the smallest scaled Jacobian, by
  /// MappingQ of degree 8.
  struct Measures
  {
    double                               volume = 0., jacobian = 1.;
    std::map<types::boundary_id, double> areas;
  };

  Measures
  measure(const Triangulation<3> &tria)
  {
    const MappingQ<3>   mapping(8);
    const FE_Nothing<3> fe;
    const QGauss<3>     cell_rule(9);
    const QGauss<2>     face_rule(9);
    FEValues<3>         values(mapping,
                       fe,
                       cell_rule,
                       update_JxW_values | update_jacobians);
    FEFaceValues<3>     face_values(mapping, fe, face_rule, update_JxW_values);
    std::vector<double> areas(8, 0.);
    Measures            result;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (unsigned int q = 0; q < cell_rule.size(); ++q)
            {
              result.volume += values.JxW(q);
              const DerivativeForm<1, 3, 3> J = values.jacobian(q).transpose();
              result.jacobian =
                std::min(result.jacobian,
                         J.determinant() /
                           (J[0].norm() * J[1].norm() * J[2].norm()));
            }
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              {
                face_values.reinit(cell, face);
                for (unsigned int q = 0; q < face_rule.size(); ++q)
                  areas.at(face->boundary_id()) += face_values.JxW(q);
              }
        }
    result.volume   = Utilities::MPI::sum(result.volume, MPI_COMM_WORLD);
    result.jacobian = Utilities::MPI::min(result.jacobian, MPI_COMM_WORLD);
    for (unsigned int id = 0; id < areas.size(); ++id)
      if (const double area = Utilities::MPI::sum(areas[id], MPI_COMM_WORLD);
          area > 0.)
        result.areas[id] = area;
    return result;
  }

  /// A face between two cells is in standard orientation or transposed, never
  /// flipped or rotated.
  bool
  consistently_ordered(const Triangulation<3> &tria)
  {
    for (const auto &cell : tria.active_cell_iterators())
      {
        for (const unsigned int f : cell->face_indices())
          if (cell->face_flip(f) || cell->face_rotation(f))
            return false;
        for (const unsigned int l : cell->line_indices())
          if (!cell->line_orientation(l))
            return false;
      }
    return true;
  }

  const RigidMotion motion({{25., -40., 65.}}, {{1e3, -2e3, 500.}});

  /// @p areas: exact area by boundary name; materials: number of ids on the coarse mesh.
  void
  check(const std::string                   &name,
        MeshParameters                       parameters,
        const double                         volume,
        const std::map<std::string, double> &areas,
        const unsigned int                   materials)
  {
    const Mesh     mesh  = create_mesh(parameters, MPI_COMM_WORLD, name);
    const auto    &tria  = *mesh.triangulation;
    const auto    &names = mesh.names;
    const Measures m     = measure(tria);
    double         error = 0.;
    bool           named =
      names.boundaries.size() == areas.size() && m.areas.size() == areas.size();
    for (const auto &[boundary, area] : areas)
      {
        named = named && names.boundaries.count(boundary) == 1;
        if (named)
          error =
            std::max(error,
                     std::fabs(
                       m.areas.at(names.boundaries.at(boundary)) / area - 1.));
      }
    std::set<unsigned int> ids;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned())
        ids.insert(cell->material_id());
    ids = Utilities::MPI::compute_set_union(ids, MPI_COMM_WORLD);
    bool explained =
      ids.size() == materials && names.materials.size() >= ids.size();
    for (const unsigned int id : ids)
      explained = explained && names.materials.count(id) == 1;

    std::vector<std::string> listed = boundary_names(parameters);
    std::sort(listed.begin(), listed.end());
    for (const auto &boundary : names.boundaries)
      named = named &&
              std::binary_search(listed.begin(), listed.end(), boundary.first);

    verdict(named && listed.size() == areas.size(),
            name + ": names of the boundaries");
    verdict(explained, name + ": material ids");
    verdict(name + ": volume to 1e-9", std::fabs(m.volume / volume - 1.), 1e-9);
    verdict(name + ": areas to 1e-8", error, 1e-8);
    verdict(m.jacobian > 0.2, name + ": scaled Jacobians above 0.2");
    verdict(consistently_ordered(tria), name + ": consistently ordered");
  }

  MeshParameters
  make(const std::string               &source,
       const std::vector<double>       &extent,
       const std::vector<unsigned int> &subdivisions,
       const unsigned int               refinements = 0)
  {
    MeshParameters q;
    q.source       = source;
    q.extent       = extent;
    q.subdivisions = subdivisions;
    q.refinements  = refinements;
    q.rotate       = {{25., -40., 65.}};
    q.translate    = {{1e3, -2e3, 500.}};
    return q;
  }

  void
  check_straight()
  {
    MeshParameters box = make("box", {1., 2., 3., 2., 4., 6.}, {3, 4, 2});
    check("box",
          box,
          6.,
          {{"xmin", 6.},
           {"xmax", 6.},
           {"ymin", 3.},
           {"ymax", 3.},
           {"zmin", 2.},
           {"zmax", 2.}},
          8);
    box.distort = 0.15;
    check("distorted box",
          box,
          6.,
          {{"xmin", 6.},
           {"xmax", 6.},
           {"ymin", 3.},
           {"ymax", 3.},
           {"zmin", 2.},
           {"zmax", 2.}},
          8);
    box.top_slope    = {{0.5, 0.25}};
    box.bottom_slope = {{0., -0.5}};
    // Heights at the corners: (0,0) 3, (1,0) 3.5, (0,2) 4.5, (1,2) 5.
    check("inclined box",
          box,
          8.,
          {{"xmin", 7.5},
           {"xmax", 8.5},
           {"ymin", 3.25},
           {"ymax", 4.75},
           {"zmin", 2. * std::sqrt(1.25)},
           {"zmax", 2. * std::sqrt(1.3125)}},
          8);
  }

  void
  check_round()
  {
    const double side = pi * (2.25 - 1.) / 4.;
    check("shell octant",
          make("shell octant", {1., 1.5}, {3, 2}),
          pi / 6. * (1.5 * 1.5 * 1.5 - 1.),
          {{"inside", pi / 2.},
           {"outside", pi / 2. * 2.25},
           {"xmin", side},
           {"ymin", side},
           {"zmin", side}},
          3);
    check("shell octant refined from 1",
          make("shell octant", {1., 1.5}, {1, 1}, 2),
          pi / 6. * (1.5 * 1.5 * 1.5 - 1.),
          {{"inside", pi / 2.},
           {"outside", pi / 2. * 2.25},
           {"xmin", side},
           {"ymin", side},
           {"zmin", side}},
          3);
    check("cylinder sector",
          make("cylinder sector", {1., 1.5, 0.7}, {3, 2, 2}),
          side * 0.7,
          {{"inside", pi / 2. * 0.7},
           {"outside", pi / 2. * 1.5 * 0.7},
           {"xmin", 0.35},
           {"ymin", 0.35},
           {"zmin", side},
           {"zmax", side}},
          1);
  }

  /// Volume under z = z_middle + F and side areas by a fine product rule.
  void
  check_curved(const std::string &surface)
  {
    MeshParameters q =
      make("curved block", {0., 1., 2., 2., 4., 3.}, {4, 6, 1});
    q.surface   = surface;
    q.amplitude = 0.25;
    q.middle    = 0.6;
    const CurvedBlockManifold::Shape shape{
      0.,
      1.,
      2.,
      2.,
      4.,
      3.,
      2.6,
      0.25,
      surface == "bump"   ? CurvedBlockManifold::Surface::bump :
      surface == "saddle" ? CurvedBlockManifold::Surface::saddle :
                            CurvedBlockManifold::Surface::wave};
    const QGauss<2> rule(24);
    double          under = 0., area = 0.;
    for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const auto h =
          shape.height(2. * rule.point(i)[0], 1. + 3. * rule.point(i)[1]);
        under += 6. * rule.weight(i) * (0.6 + h.value);
        area += 6. * rule.weight(i) * std::sqrt(1. + h.dx * h.dx + h.dy * h.dy);
      }
    const QGauss<1> line(24);
    double          x[2] = {0., 0.}, y[2] = {0., 0.};
    for (unsigned int i = 0; i < line.size(); ++i)
      for (unsigned int side = 0; side < 2; ++side)
        {
          const double s = line.point(i)[0];
          x[side] += 3. * line.weight(i) *
                     (0.6 + shape.height(2. * side, 1. + 3. * s).value);
          y[side] += 2. * line.weight(i) *
                     (0.6 + shape.height(2. * s, 1. + 3. * side).value);
        }
    q.half = "lower";
    check(surface + ", lower",
          q,
          under,
          {{"xmin", x[0]},
           {"xmax", x[1]},
           {"ymin", y[0]},
           {"ymax", y[1]},
           {"zmin", 6.},
           {"interface", area}},
          1);
    q.half = "upper";
    check(surface + ", upper",
          q,
          6. - under,
          {{"xmin", 3. - x[0]},
           {"xmax", 3. - x[1]},
           {"ymin", 2. - y[0]},
           {"ymax", 2. - y[1]},
           {"zmax", 6.},
           {"interface", area}},
          1);
    q.half         = "both";
    q.subdivisions = {4, 6, 2, 1};
    check(surface + ", both",
          q,
          6.,
          {{"xmin", 3.},
           {"xmax", 3.},
           {"ymin", 2.},
           {"ymax", 2.},
           {"zmin", 6.},
           {"zmax", 6.}},
          2);
  }

  void
  check_refine_near()
  {
    MeshParameters     q = make("shell octant", {1., 2.}, {2, 2});
    const Point<3>     p = motion(Point<3>(2., 0., 0.));
    std::ostringstream text;
    text.precision(17);
    text << p[0] << ", " << p[1] << ", " << p[2] << ", 0.3, 2";
    q.refine_near = text.str() + "; " +
                    text.str().substr(0, text.str().find(", 0.3")) + ",1e-3,1";
    const Mesh  mesh = create_mesh(q, MPI_COMM_WORLD);
    const auto &tria = *mesh.triangulation;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "cells: " << tria.n_global_active_cells() << ", levels "
                << tria.n_global_levels() << std::endl;
    double finest = 0.;
    for (const auto &cell : tria.active_cell_iterators())
      if (cell->is_locally_owned() && cell->level() == 3)
        finest = std::max(finest, cell->center().distance(p));
    verdict(tria.n_global_levels() == 4 &&
              Utilities::MPI::max(finest, MPI_COMM_WORLD) < 0.3,
            "refined near the moved point");
    const Measures m = measure(tria);
    verdict(std::fabs(m.volume / (pi / 6. * 7.) - 1.) < 1e-7,
            "locally refined shell: volume to 1e-7");
    verdict(m.jacobian > 0.2,
            "locally refined shell: scaled Jacobians above 0.2");

    q.refine_near = "0, 0, 0, 0.1, 1";
    bool refused  = false;
    try
      {
        create_mesh(q, MPI_COMM_WORLD, "Body inner, Mesh");
      }
    catch (const InputError &)
      {
        refused = true;
      }
    verdict(refused, "a ball that meets no cell is refused");
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_straight();
  check_round();
  for (const std::string surface : {"bump", "saddle", "wave"})
    check_curved(surface);
  check_refine_near();
}
