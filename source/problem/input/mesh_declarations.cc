#include <mortise/problem/input/parameter_schema.h>

namespace mortise
{
  namespace
  {
    void
    declare_mesh_file(const ParameterSection &section, MeshParameters &mesh)
    {
      section.add(
        "File",
        mesh.file,
        "For the source file: a mesh of gmsh (.msh, version 2.2 or 4.1, first or second "
        "order), one of Abaqus or CalculiX (.inp), of VTK (.vtu) or of another program that gmsh reads (.unv, .bdf, .nas, .vtk), or a geometry that gmsh "
        "meshes (.geo, .step, .brep). Looked for in the working directory, then beside the parameter file.",
        {"name of a file"});
      section.add(
        "Part",
        mesh.part,
        "The physical volume of the file that is this body. Empty: all.",
        {"name (or tag) of a physical volume"});
      section.add(
        "Mesh size",
        mesh.mesh_size,
        {"Longest edge where gmsh meshes a geometry, and the value of mesh_size if a .geo file has DefineConstant[ "
         "mesh_size = ... ] []. 0: as the geometry specifies.",
         "length"},
        {"0 or a positive number"});
      section.add(
        "Boundaries",
        mesh.boundaries,
        {"Names for boundaries of a file, chosen by place and shape, before Rotate and Translate; they take their faces from the "
         "boundaries that the file names. plane: faces in it; box: faces within it; cylinder, sphere, free: faces of a geometry, or "
         "of a mesh those that meet smoothly, of that shape; near: the nearest of them, with what goes on on the same surface; faces: "
         "by the numbers of mortise --boundaries FILE; named: boundaries of the file [].",
         "length"},
        {"\"name: plane x = 1; name: plane through x, y, z normal nx, ny, nz; name: box x0, y0, z0, x1, y1, z1; name: cylinder "
         "[radius r] [near x, y, z]; name: sphere ...; name: free ...; name: faces 7, 9; name: named A, B; name: ... and ...\""});
      section.add(
        "Curved boundaries",
        mesh.curved_boundaries,
        {"True shapes of boundaries of a file of first order, which refined cells and cells "
         "of higher degree follow, before Rotate and Translate; centre, axis (a point on it "
         "and a direction) and radius are fitted to the vertices where they are left out "
         "[].",
         "length"},
        {"\"boundary: sphere [x, y, z[, radius]]; boundary: cylinder [x, y, z, ax, ay, "
         "az[, radius]]; boundary: step FILE; ...\""});
    }

    void
    declare_mesh_source(const ParameterSection &section, MeshParameters &mesh)
    {
      section.add("Source",
                  mesh.source,
                  "Where the mesh comes from.",
                  Allowed::one_of(mesh_source_names()));
      section.add(
        "Cells",
        mesh.cells,
        "Shape of the cells. auto: that of a file of hexahedra or tetrahedra, else tetrahedra into which pyramids, wedges and "
        "hexahedra of a file are cut; hexahedra from generators. tetrahedra: everything is cut.",
        Allowed::one_of({"auto", "hexahedra", "tetrahedra"}));
      section.add(
        "Extent",
        mesh.extent,
        {"Size of a generated body []. box and curved block: x0, y0, z0, x1, y1, "
         "z1 (of the whole block); shell octant: r_in, r_out; cylinder sector: r_in, "
         "r_out, length.",
         "length"},
        {"2, 3 or 6 numbers, as the generator needs"});
      section.add(
        "Subdivisions",
        mesh.subdivisions,
        "Cells of a generated body. box: nx, ny, nz; shell octant: n, m (three patches of "
        "n x n, m radial); cylinder sector: around, radial, axial; curved block: nx, ny, "
        "nz, or nx, ny, nz_lower, nz_upper for both halves.",
        {"2 to 4 integers of 1 or more, as the generator needs"});
      section.add(
        "Refinements",
        mesh.refinements,
        "How often all cells are cut into eight, after Subdivisions or File.",
        Allowed::integer(0));
      section.add(
        "Refine near",
        mesh.refine_near,
        {"Local refinement after Refinements: cells that reach into a ball are cut the given number of times [], "
         "after Rotate and Translate.",
         "length"},
        {"\"x, y, z, radius, times; ...\""});
      declare_mesh_file(section, mesh);
      section.add("Rotate",
                  mesh.rotate,
                  {"Rotates the body about the axes x, then y, then z [].",
                   "degrees"},
                  {"3 numbers"});
      section.add("Translate",
                  mesh.translate,
                  {"Moves the body, after Rotate [].", "length"},
                  {"3 numbers"});
    }

    void
    declare_mesh_shape(const ParameterSection &section, MeshParameters &mesh)
    {
      section.add(
        "Bottom slope",
        mesh.bottom_slope,
        {"box: the face zmin lies in z = z0 + sx (x - x0) + sy (y - y0) [].",
         "-"},
        {"2 numbers: sx, sy"});
      section.add(
        "Top slope",
        mesh.top_slope,
        {"box: the face zmax lies in z = z1 + sx (x - x0) + sy (y - y0) [].",
         "-"},
        {"2 numbers: sx, sy"});
      section.add(
        "Distort",
        mesh.distort,
        {"box: largest shift of a vertex as a fraction of its cell's edges, the same on "
         "every run [].",
         "-"},
        {"a number from 0 to 0.3"});
      section.add("Half",
                  mesh.half,
                  "curved block: which side of the curved surface.",
                  Allowed::one_of({"lower", "upper", "both"}));
      section.add(
        "Surface",
        mesh.surface,
        "curved block: the surface in which the halves meet, z = z_middle + Amplitude "
        "f(s, t) with s, t in [-1, 1] across the block. bump: cos(pi s/2) cos(pi t/2); "
        "saddle: (s^2 - t^2 + s/2) / 1.5; wave: sin(pi s/2 + 1/2) cos(pi t/2).",
        Allowed::one_of({"bump", "saddle", "wave"}));
      section.add(
        "Amplitude",
        mesh.amplitude,
        {"curved block: height of that surface [].", "length"},
        {"a number smaller in magnitude than the height of each half"});
      section.add(
        "Middle",
        mesh.middle,
        {"curved block: z_middle as a fraction of the block's height [].", "-"},
        {"a number between 0 and 1"});
    }
  } // namespace

  void
  declare_mesh(const ParameterSection &section, MeshParameters &mesh)
  {
    declare_mesh_source(section, mesh);
    declare_mesh_shape(section, mesh);
  }
} // namespace mortise
