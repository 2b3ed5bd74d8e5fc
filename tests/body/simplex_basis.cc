// Proves the functions of FE_SimplexLegendre: derivatives against finite
// differences, traces on lines, which modes vanish on which faces, that the
// modes of one degree are among those of the next, that deal.II's lines and
// faces are the ones that the functions belong to, and that FEValues and
// FEFaceValues give them on cells whose vertices come in any order.

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>

#include <mortise/body/elements/legendre_basis.h>
#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/body/elements/trace_basis.h>

#include <iostream>
#include <set>

#include "simplex_meshes.h"
#include "verdict.h"

using namespace dealii;
using namespace mortise;

std::string
at(const unsigned int p)
{
  return "p=" + std::to_string(p) + " ";
}

/// Values and derivatives of all functions at a point.
struct ModesAtPoint
{
  ModesAtPoint(const FE_SimplexLegendre &fe, const Point<3> &x)
    : values(fe.n_dofs_per_cell())
    , gradients(fe.n_dofs_per_cell())
    , hessians(fe.n_dofs_per_cell())
  {
    std::vector<Tensor<3, 3>> no_3;
    std::vector<Tensor<4, 3>> no_4;
    SimplexLegendrePolynomials(fe.degree, fe.order)
      .evaluate(x, values, gradients, hessians, no_3, no_4);
  }

  std::vector<double>       values;
  std::vector<Tensor<1, 3>> gradients;
  std::vector<Tensor<2, 3>> hessians;
};

void
check_derivatives(const unsigned int p, const VertexOrder &order)
{
  const FE_SimplexLegendre fe(p, order);
  const double             h     = 5e-4;
  double                   first = 0., second = 0., value = 0.;
  for (const Point<3> &x : {Point<3>(0.2, 0.3, 0.1),
                            Point<3>(0.05, 0.6, 0.3),
                            Point<3>(0., 0., 0.),
                            Point<3>(1., 0., 0.),
                            Point<3>(0.4, 0., 0.6)})
    {
      const ModesAtPoint here(fe, x);
      for (unsigned int d = 0; d < 3; ++d)
        {
          // differences of fourth order
          const Tensor<1, 3> step = h * Point<3>::unit_vector(d);
          const ModesAtPoint far_left(fe, x + (-2. * step)),
            left(fe, x + (-step)), right(fe, x + step),
            far_right(fe, x + 2. * step);
          const auto difference = [&](const auto &member, const unsigned i) {
            return (8. * ((right.*member)[i] - (left.*member)[i]) -
                    ((far_right.*member)[i] - (far_left.*member)[i])) /
                   (12. * h);
          };
          for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
            {
              // relative to the size of the derivatives
              first  = std::max(first,
                               std::abs(difference(&ModesAtPoint::values, i) -
                                        here.gradients[i][d]) /
                                 (1. + here.gradients[i].norm()));
              second = std::max(second,
                                (difference(&ModesAtPoint::gradients, i) -
                                 here.hessians[i][d])
                                    .norm() /
                                  (1. + here.hessians[i].norm()));
            }
        }
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        value =
          std::max({value,
                    std::abs(fe.shape_value(i, x) - here.values[i]),
                    (fe.shape_grad(i, x) - here.gradients[i]).norm(),
                    (fe.shape_grad_grad(i, x) - here.hessians[i]).norm()});
    }
  verdict(at(p) + "gradients against differences", first, 1e-6);
  verdict(at(p) + "second derivatives against differences", second, 1e-5);
  verdict(at(p) + "functions one by one", value, 1e-11);
}

Point<3>
unit_vertex(const unsigned int v)
{
  return v == 0 ? Point<3>() : Point<3>(Point<3>::unit_vector(v - 1));
}

void
check_traces(const unsigned int p, const VertexOrder &order)
{
  const FE_SimplexLegendre fe(p, order);
  const VertexOrder        ranks = vertex_ranks(order);
  double                   lines = 0., supports = 0.;
  for (unsigned int l = 0; l < 6; ++l)
    for (const double t : {0., 0.13, 0.5, 0.9, 1.})
      {
        unsigned int a = tetrahedron_lines[l][0], b = tetrahedron_lines[l][1];
        if (ranks[a] > ranks[b])
          std::swap(a, b);
        const ModesAtPoint functions(fe,
                                     unit_vertex(a) +
                                       t * (unit_vertex(b) - unit_vertex(a)));
        double             lobatto[max_lobatto_degree + 1];
        evaluate_lobatto(p, t, lobatto);
        for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
          {
            double expected = i == a ? lobatto[0] : (i == b ? lobatto[1] : 0.);
            for (unsigned int k = 2; k <= p; ++k)
              if (i == 4 + l * (p - 1) + k - 2)
                expected = lobatto[k];
            lines = std::max(lines, std::abs(functions.values[i] - expected));
          }
      }
  for (unsigned int f = 0; f < 4; ++f)
    {
      Point<3> x;
      for (unsigned int v = 0; v < 3; ++v)
        x += (0.21 + v * (0.13 - 0.01 * (v - 1))) *
             unit_vertex(tetrahedron_faces[f][v]);
      const ModesAtPoint functions(fe, x);
      const auto         dofs = trace_dof_indices(fe, f);
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        if (std::count(dofs.begin(), dofs.end(), i) == 0)
          supports = std::max(supports, std::abs(functions.values[i]));
        else if (std::abs(functions.values[i]) < 1e-14)
          supports = 1.;
    }
  verdict(at(p) + "traces on lines are the functions of hexahedra",
          lines,
          1e-14);
  verdict(at(p) + "supports on faces", supports, 1e-12);
}

/// Functions of a face against those of the cell on it.
void
check_faces(const unsigned int p, const VertexOrder &order)
{
  const FE_SimplexLegendre fe(p, order);
  const TraceBasis        &trace = trace_basis(FaceShape::triangle, p);
  const double             t = 0.21, s = 0.34;
  double                   values_error = 0.;
  for (unsigned int f = 0; f < 4; ++f)
    {
      const auto          vertices = ascending_face_vertices(order, f);
      const Point<3>      origin   = unit_vertex(vertices[0]);
      const Tensor<1, 3>  along[2] = {unit_vertex(vertices[1]) - origin,
                                      unit_vertex(vertices[2]) - origin};
      const ModesAtPoint  cell(fe, origin + (t * along[0] + s * along[1]));
      std::vector<double> values(trace.size());
      trace.evaluate(t, s, values.data());
      const auto dofs = trace_dof_indices(fe, f);
      if (dofs.size() != values.size() || dofs.size() != fe.n_dofs_per_face(f))
        values_error = 1.;
      for (unsigned int i = 0; i < dofs.size(); ++i)
        values_error =
          std::max(values_error, std::abs(values[i] - cell.values[dofs[i]]));
    }
  verdict(at(p) + "functions of faces", values_error, 1e-12);
}

void
check_hierarchy(const unsigned int p, const VertexOrder &order)
{
  const FE_SimplexLegendre fe(p, order), next(p + 1, order);
  const Point<3>           x(0.23, 0.31, 0.17);
  const ModesAtPoint       low(fe, x), high(next, x);
  double                   worst   = 0.;
  const auto               compare = [&](const unsigned int i,
                           const unsigned int j,
                           const unsigned int n) {
    for (unsigned int mode = 0; mode < n; ++mode)
      worst =
        std::max(worst, std::abs(low.values[i + mode] - high.values[j + mode]));
  };
  compare(0, 0, 4);
  for (unsigned int l = 0; l < 6; ++l)
    compare(4 + l * n_line_modes(p), 4 + l * n_line_modes(p + 1), p - 1);
  for (unsigned int f = 0; f < 4; ++f)
    compare(fe.get_first_quad_index(f),
            next.get_first_quad_index(f),
            n_face_modes(p));
  compare(fe.get_first_hex_index(),
          next.get_first_hex_index(),
          n_interior_modes(p));
  verdict(at(p) + "modes are among those of the next degree", worst, 1e-15);
}

/// deal.II's lines and faces of cells against the tables of vertex_order.h.
void
check_entities(const Triangulation<3> &triangulation)
{
  unsigned int wrong = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      for (unsigned int l = 0; l < 6; ++l)
        {
          std::set<unsigned int> ours, theirs;
          for (unsigned int v = 0; v < 2; ++v)
            {
              ours.insert(cell->vertex_index(tetrahedron_lines[l][v]));
              theirs.insert(cell->line(l)->vertex_index(v));
            }
          wrong += ours != theirs;
        }
      for (unsigned int f = 0; f < 4; ++f)
        {
          std::set<unsigned int> ours, theirs;
          for (unsigned int v = 0; v < 3; ++v)
            {
              ours.insert(cell->vertex_index(tetrahedron_faces[f][v]));
              theirs.insert(cell->face(f)->vertex_index(v));
            }
          wrong += ours != theirs;
        }
    }
  verdict("deal.II's lines and faces are ours", wrong, 0.);
}

/// Difference of @p values for scalar or vector-valued shape functions from the
/// functions at points of the reference cell.
double
compare_values(const FEValuesBase<3>                                 &values,
               const typename Triangulation<3>::active_cell_iterator &cell)
{
  const auto  &fe    = SimplexElements::base(values.get_fe());
  double       worst = 0.;
  Tensor<2, 3> jacobian;
  for (unsigned int d = 0; d < 3; ++d)
    for (unsigned int e = 0; e < 3; ++e)
      jacobian[e][d] = (cell->vertex(d + 1) - cell->vertex(0))[e];
  const Tensor<2, 3> inverse = invert(jacobian);
  for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    {
      const ModesAtPoint functions(
        fe, Point<3>(inverse * (values.quadrature_point(q) - cell->vertex(0))));
      for (unsigned int i = 0; i < values.dofs_per_cell; ++i)
        {
          const unsigned int base =
            values.get_fe().system_to_component_index(i).second;
          worst = std::max(
            {worst,
             std::abs(values.shape_value(i, q) - functions.values[base]),
             (values.shape_grad(i, q) -
              transpose(inverse) * functions.gradients[base])
                 .norm() /
               (1. + functions.gradients[base].norm())});
        }
    }
  return worst;
}

void
check_fe_values(const unsigned int p)
{
  Triangulation<3> triangulation;
  simplex_test::create_shape("ball", p, false, triangulation);
  if (p == 1)
    check_entities(triangulation);
  // FESystem of a higher degree does not pass deal.II 9.4's assertions
  const unsigned int    n_components = p == 2 ? 3 : 1;
  const SimplexElements elements({p},
                                 n_components,
                                 simplex_test::all_vertex_orders());
  const MappingFE<3>    affine{FE_SimplexP<3>(1)};
  const UpdateFlags     flags =
    update_values | update_gradients | update_quadrature_points;
  double                 cells = 0., faces = 0.;
  std::set<unsigned int> seen;
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      const unsigned int index = elements.index(cell, p);
      if (!seen.insert(index).second)
        continue;
      FEValues<3> values(affine,
                         elements.collection[index],
                         simplex_quadrature<3>(3),
                         flags);
      values.reinit(cell);
      cells = std::max(cells, compare_values(values, cell));
      FEFaceValues<3> face_values(affine,
                                  elements.collection[index],
                                  simplex_quadrature<2>(5),
                                  flags);
      for (const unsigned int f : cell->face_indices())
        {
          face_values.reinit(cell, f);
          faces = std::max(faces, compare_values(face_values, cell));
        }
    }
  verdict(at(p) + "FEValues, " + std::to_string(seen.size()) +
            " orders of vertices",
          cells,
          1e-11);
  verdict(at(p) + "FEFaceValues", faces, 1e-11);
}

int
main()
{
  for (unsigned int p = 1; p <= max_simplex_degree; ++p)
    {
      const VertexOrder order = simplex_test::all_vertex_orders()[(7 * p) % 24];
      check_derivatives(p, order);
      check_traces(p, order);
      check_faces(p, order);
      if (p < max_simplex_degree)
        check_hierarchy(p, order);
      check_fe_values(p);
    }
}
