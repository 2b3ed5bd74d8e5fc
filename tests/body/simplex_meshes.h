// Meshes of the tests of tetrahedra: shapes whose vertices, cells and vertices
// in cells are numbered at random.
#pragma once

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/fully_distributed_tria.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria_description.h>

#include <mortise/body/mesh/vertex_order.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace simplex_test
{
  using namespace dealii;

  const std::vector<std::string> shapes = {"cube", "ball", "shell"};

  /// All 24.
  inline std::vector<mortise::VertexOrder>
  all_vertex_orders()
  {
    std::vector<mortise::VertexOrder> all;
    mortise::VertexOrder              order = {{0, 1, 2, 3}};
    do
      all.push_back(order);
    while (std::next_permutation(order.begin(), order.end()));
    return all;
  }

  /// Number vertices, cells and the vertices of each cell at random; volumes
  /// stay positive.
  inline void
  number_at_random(std::vector<Point<3>>    &vertices,
                   std::vector<CellData<3>> &cells,
                   std::mt19937             &random)
  {
    std::vector<unsigned int> place(vertices.size());
    for (unsigned int v = 0; v < place.size(); ++v)
      place[v] = v;
    std::shuffle(place.begin(), place.end(), random);
    const std::vector<Point<3>> before = vertices;
    for (unsigned int v = 0; v < place.size(); ++v)
      vertices[place[v]] = before[v];
    std::shuffle(cells.begin(), cells.end(), random);
    for (CellData<3> &cell : cells)
      {
        for (unsigned int &v : cell.vertices)
          v = place[v];
        // even permutations are made by rotations of three vertices
        for (unsigned int turn = 0; turn < 6; ++turn)
          {
            const unsigned int start = random() % 2;
            std::rotate(cell.vertices.begin() + start,
                        cell.vertices.begin() + start + 1,
                        cell.vertices.begin() + start + 3);
          }
      }
  }

  /// @p ordered: through order_vertices(), else any order may appear.
  inline void
  create_shape(const std::string &shape,
               const unsigned int seed,
               const bool         ordered,
               Triangulation<3>  &triangulation)
  {
    Triangulation<3> coarse, hexahedra;
    if (shape == "cube")
      GridGenerator::subdivided_hyper_cube_with_simplices(coarse, 2);
    else
      {
        if (shape == "ball")
          GridGenerator::hyper_ball(hexahedra);
        else
          GridGenerator::hyper_shell(hexahedra, Point<3>(), 0.5, 1., 6);
        GridGenerator::convert_hypercube_to_simplex_mesh(hexahedra, coarse);
      }
    auto [vertices, cells, faces] =
      GridTools::get_coarse_mesh_description(coarse);
    std::mt19937 random(seed);
    for (CellData<3> &cell : cells)
      cell.manifold_id = numbers::flat_manifold_id;
    number_at_random(vertices, cells, random);
    if (ordered)
      mortise::order_vertices(vertices, cells);
    triangulation.create_triangulation(vertices, cells, SubCellData());
  }

  /// A quarter of a thick cylinder in coordinates of the unit cube.
  class Quarter : public ChartManifold<3>
  {
  public:
    Point<3>
    push_forward(const Point<3> &y) const override
    {
      const double phi = y[1] * numbers::PI_2;
      return {(1. + y[0]) * std::cos(phi), (1. + y[0]) * std::sin(phi), y[2]};
    }

    Point<3>
    pull_back(const Point<3> &x) const override
    {
      return {std::hypot(x[0], x[1]) - 1.,
              std::atan2(x[1], x[0]) / numbers::PI_2,
              x[2]};
    }

    std::unique_ptr<Manifold<3>>
    clone() const override
    {
      return std::make_unique<Quarter>();
    }
  };

  inline void
  create_quarter(const unsigned int n,
                 const bool         ordered,
                 Triangulation<3>  &triangulation)
  {
    Triangulation<3> coarse;
    GridGenerator::subdivided_hyper_cube_with_simplices(coarse, n);
    auto [vertices, cells, faces] =
      GridTools::get_coarse_mesh_description(coarse);
    for (Point<3> &x : vertices)
      x = Quarter().push_forward(x);
    std::mt19937 random(3);
    number_at_random(vertices, cells, random);
    if (ordered)
      mortise::order_vertices(vertices, cells);
    triangulation.create_triangulation(vertices, cells, SubCellData());
    triangulation.set_all_manifold_ids(0);
    triangulation.set_manifold(0, Quarter());
  }

  /// Triangulation of create_shape() spread over all ranks.
  inline std::unique_ptr<Triangulation<3>>
  create_distributed(const std::string &shape,
                     const unsigned int seed,
                     const bool         ordered,
                     const MPI_Comm     comm)
  {
    Triangulation<3> serial;
    create_shape(shape, seed, ordered, serial);
    GridTools::partition_triangulation(Utilities::MPI::n_mpi_processes(comm),
                                       serial);
    auto triangulation =
      std::make_unique<parallel::fullydistributed::Triangulation<3>>(comm);
    triangulation->create_triangulation(
      TriangulationDescription::Utilities::
        create_description_from_triangulation(serial, comm));
    return triangulation;
  }

  /// A number that depends on the place of the cell only, not on the rank.
  template <typename CellIterator>
  unsigned int
  cell_number(const CellIterator &cell, const unsigned int seed)
  {
    const Point<3> center = cell->center();
    std::seed_seq  seeds{seed,
                        unsigned(1000. * (center[0] + 7.)),
                        unsigned(1000. * (center[1] + 7.)),
                        unsigned(1000. * (center[2] + 7.))};
    std::mt19937   random(seeds);
    random.discard(3);
    return random();
  }
} // namespace simplex_test
