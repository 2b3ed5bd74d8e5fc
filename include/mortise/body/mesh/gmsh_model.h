// Meshes of gmsh as plain data: nodes, elements, names of physical groups; the
// only use of the gmsh library. It meshes in a process of its own: what it
// keeps from one mesh makes it crash at the next (4.8, pyramids).
#pragma once

#include <deal.II/base/point.h>

#include <mortise/body/mesh/size_field.h>

#include <map>
#include <string>
#include <vector>

namespace mortise
{
  /// Elements of one type in one surface or volume of the model.
  struct GmshElements
  {
    std::vector<int> groups; ///< tags of its physical groups

    unsigned int dimension  = 0; ///< 2 or 3
    unsigned int n_vertices = 0;
    unsigned int order      = 0;
    std::string  type; ///< gmsh's name of the type, e.g. "Hexahedron 27"

    /// Places of the nodes of an element, in [-1,1]^d for quadrilaterals and
    /// hexahedra, in the unit simplex for triangles and tetrahedra.
    std::vector<dealii::Point<3>> reference;

    /// Indices into GmshModel::nodes, reference.size() for each element.
    std::vector<unsigned int> nodes;

    std::vector<std::size_t> tags; ///< numbers of the elements in the file

    std::size_t
    size() const
    {
      return nodes.size() / reference.size();
    }

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &groups &dimension &n_vertices &order &type &reference &nodes
        &tags;
    }
  };

  struct GmshModel
  {
    std::vector<dealii::Point<3>> nodes;
    std::vector<std::size_t>      node_tags;     ///< their numbers in the file
    std::vector<GmshElements>     elements;      ///< surfaces, then volumes
    std::map<int, std::string>    surface_names; ///< of physical groups by tag;
    std::map<int, std::string>    volume_names;  ///< unnamed: the tag as text

    /// The groups of surfaces are those of a geometry, each on its own.
    bool surfaces_of_geometry = false;

    /// A face may be in several groups of surfaces (.inp).
    bool surfaces_may_overlap = false;

    /// A cell in several groups of volumes is repeated for each of them (.msh
    /// of version 2.2).
    bool cells_are_in_one_group = false;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &node_tags &elements &surface_names &volume_names
        &surfaces_of_geometry;
    }
  };

  /// Does @p file_name end like a geometry that gmsh can mesh (.geo, .step,
  /// .stp, .brep)?
  bool
  is_geometry_file(const std::string &file_name);

  /// Does it end like a mesh that gmsh's library reads for us (.unv, .bdf,
  /// .nas, .vtk)?
  bool
  is_foreign_mesh_file(const std::string &file_name);

  /// Dimension, order and reference element of gmsh's element type @p type,
  /// which exists.
  GmshElements
  describe_gmsh_elements(int type);

  /// Read the mesh, or mesh the geometry, @p file_name, the latter with edges of at most @p mesh_size if that
  /// is positive, and that number for the constant mesh_size of a .geo file,
  /// and of at most @p sizes if it is not null. Where there
  /// are no physical groups every surface and volume is one. Throws
  /// std::runtime_error with what gmsh says, or that it crashed.
  GmshModel
  mesh_geometry(const std::string &file_name,
                double             mesh_size,
                const SizeField   *sizes = nullptr);
} // namespace mortise
