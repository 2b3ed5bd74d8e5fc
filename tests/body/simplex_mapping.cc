// Proves that SimplexMapping curves tetrahedra at the rate of its degree, with
// no gap between cells however vertices are numbered, and that cells that would
// be tangled become straight, with no gap to others.

#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe_values.h>

#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/elements/simplex_mapping.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <verdict.h>

#include <cmath>
#include <iostream>

#include "simplex_meshes.h"

using namespace dealii;
using namespace simplex_test;

double
volume(const Mapping<3>       &mapping,
       const Triangulation<3> &triangulation,
       const unsigned int      degree)
{
  const mortise::FE_SimplexLegendre fe(1);
  FEValues<3>                       values(mapping,
                     fe,
                     mortise::simplex_quadrature<3>(3 * degree),
                     update_JxW_values);
  double                            sum = 0.;
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      values.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices())
        sum += values.JxW(q);
    }
  return sum;
}

/// Largest deviation of the integral of x n over the faces of a cell from
/// three times its volume, relative.
double
largest_leak(const Mapping<3>       &mapping,
             const Triangulation<3> &triangulation,
             const unsigned int      degree)
{
  const mortise::FE_SimplexLegendre fe(1);
  FEValues<3>                       values(mapping,
                     fe,
                     mortise::simplex_quadrature<3>(3 * degree),
                     update_JxW_values);
  FEFaceValues<3>                   face_values(mapping,
                              fe,
                              mortise::simplex_quadrature<2>(3 * degree),
                              update_quadrature_points | update_JxW_values |
                                update_normal_vectors);
  double                            leak = 0.;
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      double inside = 0., flux = 0.;
      values.reinit(cell);
      for (const unsigned int q : values.quadrature_point_indices())
        inside += values.JxW(q);
      for (const unsigned int f : cell->face_indices())
        {
          face_values.reinit(cell, f);
          for (const unsigned int q : face_values.quadrature_point_indices())
            flux += (face_values.quadrature_point(q) - cell->vertex(0)) *
                    face_values.normal_vector(q) * face_values.JxW(q);
        }
      leak = std::max(leak, std::abs(flux / (3. * inside) - 1.));
    }
  return leak;
}

/// Largest distance of the same point of a face seen from both cells.
double
largest_gap(const Mapping<3> &mapping, const Triangulation<3> &triangulation)
{
  double gap = 0.;
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      {
        if (cell->at_boundary(f))
          continue;
        const auto   neighbor   = cell->neighbor(f);
        const double weights[3] = {0.2, 0.31, 0.49};
        Point<3>     here, there;
        for (unsigned int v = 0; v < 3; ++v)
          {
            const unsigned int local = mortise::tetrahedron_faces[f][v];
            if (local > 0)
              here[local - 1] = weights[v];
            for (unsigned int w = 1; w < 4; ++w)
              if (neighbor->vertex_index(w) == cell->vertex_index(local))
                there[w - 1] = weights[v];
          }
        gap = std::max(gap,
                       mapping.transform_unit_to_real_cell(cell, here)
                         .distance(mapping.transform_unit_to_real_cell(neighbor,
                                                                       there)));
      }
  return gap;
}

/// Vertices stay where they are; where y is large points of lines pass each
/// other if @p size is above 0.16.
void
check_tangled(const unsigned int degree, const double size, const bool expected)
{
  const std::string at =
    "waves of " + std::to_string(size) + ", degree " + std::to_string(degree);
  const auto triangulation =
    create_distributed("cube", 3, true, MPI_COMM_WORLD);
  mortise::SimplexMapping mapping(
    degree,
    *triangulation,
    [&](const auto &cell, const std::vector<Point<3>> &unit) {
      std::vector<Point<3>> points;
      for (const Point<3> &xi : unit)
        {
          Point<3> x = cell->vertex(0);
          for (unsigned int d = 0; d < 3; ++d)
            x += xi[d] * (cell->vertex(d + 1) - cell->vertex(0));
          x[0] += size * x[1] * x[1] * std::sin(4. * numbers::PI * x[0]) / 2.;
          points.push_back(x);
        }
      return points;
    });
  const double gap = largest_gap(mapping, *triangulation);
  verdict(gap <= 1e-13, at + ": no gap, 1e-13", gap);
  const auto points = mortise::simplex_quadrature<3>(2 * degree).get_points();
  const unsigned int n =
    mapping.straighten_tangled_cells(*triangulation, points);
  verdict(expected == (n > 0), at + ": tangled cells are found", n);
  verdict(n < triangulation->n_active_cells(), at + ": others stay", n);
  const unsigned int after =
    mapping.straighten_tangled_cells(*triangulation, points);
  verdict(after == 0, at + ": none is left", after);
  const double closed = largest_gap(mapping, *triangulation);
  verdict(closed <= 1e-13, at + ": no gap then, 1e-13", closed);
  const double leak = largest_leak(mapping, *triangulation, degree);
  verdict(leak <= 1e-12, at + ": flux through faces, 1e-12", leak);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const double                     exact = 0.75 * numbers::PI;
  Triangulation<3>                 coarse, fine;
  create_quarter(2, false, coarse);
  create_quarter(4, false, fine);
  for (unsigned int degree = 1; degree <= 8; ++degree)
    {
      const std::string             at = "degree " + std::to_string(degree);
      const mortise::SimplexMapping on_coarse(degree, coarse),
        on_fine(degree, fine);
      const double errors[2] = {
        std::abs(volume(on_coarse, coarse, degree) / exact - 1.),
        std::abs(volume(on_fine, fine, degree) / exact - 1.)};
      const double rate = std::log2(errors[0] / errors[1]),
                   gap  = largest_gap(on_coarse, coarse);
      verdict(gap <= 1e-13, at + ": no gap, 1e-13", gap);
      if (degree <= 5)
        {
          const double leak = largest_leak(on_coarse, coarse, degree);
          verdict(leak <= 1e-12,
                  at + ": flux through the faces of each cell, 1e-12",
                  leak);
        }
      if (argc > 1)
        std::cout << at << ": volume " << errors[0] << " " << errors[1]
                  << " rate " << rate << std::endl;
      verdict(rate >= degree + 0.75 || errors[1] < 1e-12,
              at + ": volume, rate >= degree + 0.75",
              rate);
    }
  for (const unsigned int degree : {3, 4})
    {
      check_tangled(degree, 0.05, false);
      check_tangled(degree, 0.4, true);
    }
}
