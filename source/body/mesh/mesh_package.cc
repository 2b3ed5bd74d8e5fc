#include <deal.II/base/mpi.h>

#include <boost/serialization/deque.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A coarse mesh on its way to other ranks.
    struct Package
    {
      std::vector<double>      vertices, nodes;
      std::vector<CellData<3>> cells;
      std::vector<CellData<2>> faces;
      MeshNames                names;
      std::string              remark;
      MeshFindings             findings;
      unsigned int             nodes_per_cell = 0;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &vertices &nodes &cells &faces &names.boundaries &names
          .materials &remark &findings &nodes_per_cell;
      }
    };

    std::vector<double>
    coordinates(const std::vector<Point<3>> &points)
    {
      std::vector<double> result;
      for (const Point<3> &x : points)
        result.insert(result.end(), x.begin_raw(), x.end_raw());
      return result;
    }

    std::vector<Point<3>>
    points(const std::vector<double> &coordinates)
    {
      std::vector<Point<3>> result;
      for (std::size_t i = 0; i < coordinates.size(); i += 3)
        result.emplace_back(coordinates[i],
                            coordinates[i + 1],
                            coordinates[i + 2]);
      return result;
    }
  } // namespace

  CoarseMesh
  broadcast(const CoarseMesh &mesh, const MPI_Comm comm)
  {
    Package package;
    package.vertices = coordinates(mesh.vertices);
    package.cells    = mesh.cells;
    package.faces    = mesh.faces.boundary_quads;
    package.names    = mesh.names;
    package.remark   = mesh.remark;
    package.findings = mesh.findings;
    if (mesh.geometry != nullptr)
      {
        package.nodes_per_cell = mesh.geometry->nodes_per_cell;
        package.nodes          = coordinates(mesh.geometry->nodes);
      }
    package = Utilities::MPI::broadcast(comm, package);
    CoarseMesh result;
    result.vertices             = points(package.vertices);
    result.cells                = package.cells;
    result.faces.boundary_quads = package.faces;
    result.names                = package.names;
    result.remark               = package.remark;
    result.findings             = package.findings;
    if (package.nodes_per_cell > 0)
      result.geometry = std::make_shared<CoarseGeometry>(package.nodes_per_cell,
                                                         points(package.nodes));
    return result;
  }
} // namespace mortise
