// Proves that FE_SimplexLegendre is conforming on tetrahedra however vertices
// and cells are numbered: a random function does not jump across any face,
// those between ranks included, for one degree and for degrees drawn at random
// with the minimum-rule constraints, and polynomials of the lowest degree are
// in the space.

#include <deal.II/base/function.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>

#include <deal.II/hp/mapping_collection.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <deal.II/numerics/vector_tools.h>

#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/spaces/hp_constraints.h>
#include <verdict.h>

#include <iostream>

#include "simplex_meshes.h"

using namespace dealii;
using namespace simplex_test;

using DistributedVector = LinearAlgebra::distributed::Vector<double>;
using CellIterator      = DoFHandler<3>::active_cell_iterator;

/// Values of all components at the points of the reference cell.
std::vector<Vector<double>>
evaluate(const CellIterator          &cell,
         const DistributedVector     &u,
         const std::vector<Point<3>> &points)
{
  const auto &fe   = cell->get_fe();
  const auto &base = mortise::SimplexElements::base(fe);
  const mortise::SimplexLegendrePolynomials polynomials(base.degree,
                                                        base.order);
  std::vector<types::global_dof_index>      dofs(fe.n_dofs_per_cell());
  cell->get_dof_indices(dofs);
  std::vector<double>         shapes(base.n_dofs_per_cell());
  std::vector<Tensor<1, 3>>   no_1;
  std::vector<Tensor<2, 3>>   no_2;
  std::vector<Tensor<3, 3>>   no_3;
  std::vector<Tensor<4, 3>>   no_4;
  std::vector<Vector<double>> values(points.size(),
                                     Vector<double>(fe.n_components()));
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      polynomials.evaluate(points[q], shapes, no_1, no_2, no_3, no_4);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto component = fe.system_to_component_index(i);
          values[q][component.first] += u(dofs[i]) * shapes[component.second];
        }
    }
  return values;
}

/// Point of the reference cell with the weights @p weights of the vertices
/// @p vertices of the mesh: this uses no orientation flags.
template <typename Cell>
Point<3>
point_by_vertices(const Cell                        &cell,
                  const std::array<unsigned int, 3> &vertices,
                  const std::array<double, 3>       &weights)
{
  Point<3> x;
  for (unsigned int v = 1; v < 4; ++v)
    for (unsigned int w = 0; w < 3; ++w)
      if (cell->vertex_index(v) == vertices[w])
        x[v - 1] = weights[w];
  return x;
}

/// Largest jump across the faces of this rank's cells.
double
largest_jump(const DoFHandler<3> &dof_handler, const DistributedVector &u)
{
  double jump = 0.;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int f : cell->face_indices())
        {
          if (cell->at_boundary(f))
            continue;
          const CellIterator          neighbor = cell->neighbor(f);
          std::array<unsigned int, 3> vertices;
          for (unsigned int v = 0; v < 3; ++v)
            vertices[v] = cell->vertex_index(mortise::tetrahedron_faces[f][v]);
          std::vector<Point<3>> here, there;
          for (unsigned int i = 0; i <= 4; ++i)
            for (unsigned int j = 0; i + j <= 4; ++j)
              {
                const std::array<double, 3> weights = {
                  {i / 4., j / 4., 1. - (i + j) / 4.}};
                here.push_back(point_by_vertices(cell, vertices, weights));
                there.push_back(point_by_vertices(neighbor, vertices, weights));
              }
          const auto values = evaluate(cell, u, here),
                     others = evaluate(neighbor, u, there);
          for (unsigned int q = 0; q < values.size(); ++q)
            for (unsigned int c = 0; c < values[q].size(); ++c)
              jump = std::max(jump, std::abs(values[q][c] - others[q][c]));
        }
  return Utilities::MPI::max(jump, dof_handler.get_communicator());
}

/// Polynomial of degree @p p, another in each component.
class TestPolynomial : public Function<3>
{
public:
  TestPolynomial(const unsigned int n_components, const unsigned int p)
    : Function<3>(n_components)
    , p(p)
  {}

  double
  value(const Point<3> &x, const unsigned int c) const override
  {
    return std::pow(x[c] - 0.2 * x[(c + 2) % 3], p) -
           std::pow(0.3 - x[(c + 1) % 3], p - 1) * x[(c + 2) % 3];
  }

private:
  const unsigned int p;
};

/// Vertices, lines, faces and cells of the whole mesh, if it is on one rank.
types::global_dof_index
expected_dofs(const DoFHandler<3> &dof_handler, const unsigned int p)
{
  const auto &mesh = dof_handler.get_triangulation();
  return mesh.n_used_vertices() + mesh.n_active_lines() * (p - 1) +
         mesh.n_active_faces() * mortise::n_face_modes(p) +
         mesh.n_active_cells() * mortise::n_interior_modes(p);
}

struct Result
{
  double                  jump; ///< of a random function of size 1
  double                  lost; ///< change of a polynomial by the constraints
  double                  interpolation; ///< error of that polynomial
  bool                    consistent;
  types::global_dof_index n_free;
  bool                    minimal; ///< no more indices than functions
};

/// Largest difference of @p u and @p f at points of this rank's cells.
double
largest_error(const DoFHandler<3>     &dof_handler,
              const DistributedVector &u,
              const Function<3>       &f)
{
  const std::vector<Point<3>> points = mortise::simplex_interpolation_points(5);
  double                      error  = 0.;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const auto values = evaluate(cell, u, points);
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            Point<3> x = cell->vertex(0);
            for (unsigned int d = 0; d < 3; ++d)
              x += points[q][d] * (cell->vertex(d + 1) - cell->vertex(0));
            for (unsigned int c = 0; c < f.n_components; ++c)
              error = std::max(error, std::abs(values[q][c] - f.value(x, c)));
          }
      }
  return Utilities::MPI::max(error, dof_handler.get_communicator());
}

Result
check(const Triangulation<3> &triangulation,
      const bool              ordered,
      const unsigned int      n_components,
      const unsigned int      first,
      const unsigned int      last,
      const unsigned int      seed)
{
  std::vector<unsigned int> degrees;
  for (unsigned int p = first; p <= last; ++p)
    degrees.push_back(p);
  const mortise::SimplexElements elements(degrees,
                                          n_components,
                                          ordered ?
                                            mortise::standard_vertex_orders() :
                                            all_vertex_orders());
  DoFHandler<3>                  dof_handler(triangulation);
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_active_fe_index(
        elements.index(cell,
                       degrees[cell_number(cell, seed) % degrees.size()]));
  dof_handler.distribute_dofs(elements.collection);

  AffineConstraints<double> constraints;
  mortise::make_conformity_constraints(dof_handler, constraints);
  const MPI_Comm comm = dof_handler.get_communicator();
  IndexSet       relevant, active;
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  DoFTools::extract_locally_active_dofs(dof_handler, active);
  constraints.close();

  Result result;
  result.consistent = constraints.is_consistent_in_parallel(
    Utilities::MPI::all_gather(comm, dof_handler.locally_owned_dofs()),
    active,
    comm);

  types::global_dof_index n_free = 0;
  DistributedVector       u(dof_handler.locally_owned_dofs(), relevant, comm);
  for (const auto i : dof_handler.locally_owned_dofs())
    if (!constraints.is_constrained(i))
      {
        ++n_free;
        std::mt19937 random(i + seed);
        u(i) = std::uniform_real_distribution<double>(-1., 1.)(random);
      }
  result.n_free  = Utilities::MPI::sum(n_free, comm);
  result.minimal = !ordered || dof_handler.n_dofs() == result.n_free;
  if (first == last && Utilities::MPI::n_mpi_processes(comm) == 1)
    result.minimal =
      result.minimal &&
      result.n_free == n_components * expected_dofs(dof_handler, first);
  constraints.distribute(u);
  u.update_ghost_values();
  result.jump = largest_jump(dof_handler, u);

  const TestPolynomial     f(n_components, first);
  const MappingFE<3>       affine{FE_SimplexP<3>(1)};
  hp::MappingCollection<3> mapping(affine);
  DistributedVector v(dof_handler.locally_owned_dofs(), relevant, comm), w(v);
  VectorTools::interpolate(mapping, dof_handler, f, v);
  v.update_ghost_values();
  result.interpolation = largest_error(dof_handler, v, f);
  w                    = v;
  w.zero_out_ghost_values();
  constraints.distribute(w);
  v.zero_out_ghost_values();
  w -= v;
  result.lost = w.linfty_norm();
  return result;
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                   comm = MPI_COMM_WORLD;
  const bool serial = Utilities::MPI::n_mpi_processes(comm) == 1;

  // Another first seed may be given, for longer searches than a test affords.
  std::mt19937 random(argc > 1 ? std::stoi(argv[1]) : 1);
  for (const std::string &shape : shapes)
    for (unsigned int p = 1; p <= 8; ++p)
      for (const bool ordered : {true, false})
        for (const bool mixed : {false, true})
          {
            const unsigned int seed        = random();
            const bool         distributed = random() % 2 == 0 || !serial;
            const unsigned int last        = mixed ? std::min(p + 3, 8u) : p;
            if (mixed && last == p)
              continue;
            std::unique_ptr<Triangulation<3>> triangulation;
            if (distributed)
              triangulation = create_distributed(shape, seed, ordered, comm);
            else
              {
                triangulation = std::make_unique<Triangulation<3>>();
                create_shape(shape, seed, ordered, *triangulation);
              }
            const unsigned int n = last <= 4 ? 3 : 1;
            const Result       result =
              check(*triangulation, ordered, n, p, last, seed);

            const std::string what =
              shape + (ordered ? ", ordered" : ", any order") +
              ", p=" + std::to_string(p) + ".." + std::to_string(last) + ", " +
              std::to_string(n) + " components, " +
              std::to_string(triangulation->n_global_active_cells()) +
              " cells, " + std::to_string(result.n_free) + " free";
            verdict(result.jump <= 1e-12,
                    what + ": jump <= 1e-12",
                    result.jump);
            verdict(result.consistent, what + ": the same on every rank", 0.);
            verdict(result.interpolation <= 1e-12,
                    what + ": polynomials are interpolated, 1e-12",
                    result.interpolation);
            verdict(result.lost <= 1e-12,
                    what + ": polynomials are kept, 1e-12",
                    result.lost);
            if (!mixed)
              verdict(result.minimal, what + ": one index a function", 0.);
          }
}
