#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <deal.II/grid/manifold_lib.h>

#include <mortise/body/mesh/generators.h>
#include <mortise/body/mesh/manifolds.h>

#include <cmath>
#include <cstdint>
#include <functional>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Zero is what faces get where the part of a mesh that a rank knows ends.
    constexpr types::boundary_id first_id = 1;

    using Lattice = std::array<unsigned int, 3>;

    /// No boundary on this side of a block of cells.
    constexpr int none = -1;

    /// A block of n[0] x n[1] x n[2] cells between vertices that exist already.
    struct Block
    {
      Lattice n;
      std::function<unsigned int(const Lattice &)>
        vertex; ///< index of a lattice point's vertex
      std::function<unsigned int(const Lattice &)> material; ///< id of a cell
      /// Ids above first_id, in deal.II's order of faces.
      std::array<int, 6> boundaries;
    };

    void
    add_cells(CoarseMesh &mesh, const Block &block)
    {
      for (unsigned int k = 0; k < block.n[2]; ++k)
        for (unsigned int j = 0; j < block.n[1]; ++j)
          for (unsigned int i = 0; i < block.n[0]; ++i)
            {
              CellData<3> cell;
              for (unsigned int v = 0; v < 8; ++v)
                cell.vertices[v] =
                  block.vertex({{i + v % 2, j + v / 2 % 2, k + v / 4}});
              cell.material_id = block.material({{i, j, k}});
              mesh.cells.push_back(cell);
            }
      LatticeBlock lattice;
      lattice.n = block.n;
      for (unsigned int k = 0; k <= block.n[2]; ++k)
        for (unsigned int j = 0; j <= block.n[1]; ++j)
          for (unsigned int i = 0; i <= block.n[0]; ++i)
            lattice.vertices.push_back(block.vertex({{i, j, k}}));
      mesh.lattice.push_back(std::move(lattice));
    }

    void
    add_boundary(CoarseMesh &mesh, const Block &block)
    {
      for (unsigned int face = 0; face < 6; ++face)
        if (block.boundaries[face] != none)
          {
            const unsigned int d = face / 2, e = (d + 1) % 3, f = (d + 2) % 3;
            for (unsigned int a = 0; a < block.n[e]; ++a)
              for (unsigned int b = 0; b < block.n[f]; ++b)
                {
                  CellData<2> quad;
                  for (unsigned int v = 0; v < 4; ++v)
                    {
                      Lattice p;
                      p[d]             = face % 2 * block.n[d];
                      p[e]             = a + v % 2;
                      p[f]             = b + v / 2;
                      quad.vertices[v] = block.vertex(p);
                    }
                  quad.boundary_id = first_id + block.boundaries[face];
                  mesh.faces.boundary_quads.push_back(quad);
                }
          }
    }

    /// A block of cells with vertices of its own at place(lattice point).
    void
    add_block(CoarseMesh                                     &mesh,
              Block                                           block,
              const std::function<Point<3>(const Lattice &)> &place)
    {
      const Lattice      n     = block.n;
      const unsigned int first = mesh.vertices.size();
      for (unsigned int k = 0; k <= n[2]; ++k)
        for (unsigned int j = 0; j <= n[1]; ++j)
          for (unsigned int i = 0; i <= n[0]; ++i)
            mesh.vertices.push_back(place({{i, j, k}}));
      block.vertex = [n, first](const Lattice &p) {
        return first + p[0] + (n[0] + 1) * (p[1] + (n[1] + 1) * p[2]);
      };
      add_cells(mesh, block);
      add_boundary(mesh, block);
    }

    /// a at i = 0 and b at i = n, both exactly.
    double
    between(const double       a,
            const double       b,
            const double       i,
            const unsigned int n)
    {
      return i == n ? b : a + (b - a) * (i / n);
    }

    /// A number in (-1, 1) that depends on its arguments only (splitmix64's
    /// mixing).
    double
    scatter(const Lattice &p, const unsigned int direction)
    {
      std::uint64_t z = p[0];
      for (const std::uint64_t next : {p[1], p[2], direction})
        {
          z = (z << 20) + next + 0x9e3779b97f4a7c15ULL;
          z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
          z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
          z ^= z >> 31;
        }
      return static_cast<double>(z >> 11) * 0x1p-52 - 1.;
    }

    CoarseMesh
    box(const MeshParameters &q)
    {
      const std::vector<double> &e = q.extent;
      const Lattice              n = {
        {q.subdivisions[0], q.subdivisions[1], q.subdivisions[2]}};
      CoarseMesh        mesh;
      const RigidMotion motion = rigid_motion(q);

      Block block;
      block.n          = n;
      block.boundaries = {{0, 1, 2, 3, 4, 5}};
      block.material   = [n](const Lattice &c) {
        return (2 * c[0] + 1 > n[0]) + 2 * (2 * c[1] + 1 > n[1]) +
               4 * (2 * c[2] + 1 > n[2]);
      };
      add_block(mesh, block, [&](const Lattice &p) {
        std::array<double, 3> at;
        for (unsigned int d = 0; d < 3; ++d)
          at[d] =
            p[d] + (p[d] > 0 && p[d] < n[d] ? q.distort * scatter(p, d) : 0.);
        const double x   = between(e[0], e[3], at[0], n[0]),
                     y   = between(e[1], e[4], at[1], n[1]);
        const auto plane = [&](const double                 z,
                               const std::array<double, 2> &slope) {
          return z + slope[0] * (x - e[0]) + slope[1] * (y - e[1]);
        };
        return motion(Point<3>(x,
                               y,
                               between(plane(e[2], q.bottom_slope),
                                       plane(e[5], q.top_slope),
                                       at[2],
                                       n[2])));
      });
      for (unsigned int octant = 0; octant < 8; ++octant)
        mesh.names.materials[octant] =
          std::string("x ") + (octant % 2 ? "upper" : "lower") + ", y " +
          (octant / 2 % 2 ? "upper" : "lower") + ", z " +
          (octant / 4 ? "upper" : "lower") + " half";
      return mesh;
    }

    /// An octant of the cube [0, n]^3's outer surface, projected to spheres:
    /// the lattice points with largest coordinate n lie in the directions
    /// tan(45 degrees i/n), which divides each patch into equal angles.
    CoarseMesh
    shell_octant(const MeshParameters &q)
    {
      const unsigned int n = q.subdivisions[0], m = q.subdivisions[1];
      const RigidMotion  motion = rigid_motion(q);
      CoarseMesh         mesh;
      // tetrahedra are not cut, and means are as accurate as their elements
      if (q.cells == "tetrahedra")
        mesh.manifold = std::make_unique<SphereManifold>(motion);
      else
        mesh.manifold = std::make_unique<ShellOctantManifold>(n, motion);

      std::map<Lattice, unsigned int> index; // of the directions
      std::vector<Tensor<1, 3>>       directions;
      for (unsigned int k = 0; k <= n; ++k)
        for (unsigned int j = 0; j <= n; ++j)
          for (unsigned int i = 0; i <= n; ++i)
            if (const Lattice p = {{i, j, k}}; i == n || j == n || k == n)
              {
                Tensor<1, 3> direction;
                for (unsigned int d = 0; d < 3; ++d)
                  direction[d] =
                    p[d] == n ? 1. : std::tan(0.25 * numbers::PI * p[d] / n);
                index[p] = directions.size();
                directions.push_back(direction / direction.norm());
              }
      for (unsigned int layer = 0; layer <= m; ++layer)
        for (const Tensor<1, 3> &direction : directions)
          mesh.vertices.push_back(motion(
            Point<3>(between(q.extent[0], q.extent[1], layer, m) * direction)));

      for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const unsigned int l = (axis + 1) % 3, k = (axis + 2) % 3;
          Block              block;
          block.n      = {{n, n, m}};
          block.vertex = [&, axis, l, k](const Lattice &p) {
            Lattice direction;
            direction[axis] = n;
            direction[l]    = p[0];
            direction[k]    = p[1];
            return index.at(direction) + directions.size() * p[2];
          };
          block.material   = [axis](const Lattice &) { return axis; };
          block.boundaries = {{2 + int(l), none, 2 + int(k), none, 0, 1}};
          add_cells(mesh, block);
          add_boundary(mesh, block);
          mesh.names.materials[axis] =
            std::string("patch around ") + "xyz"[axis];
        }
      return mesh;
    }

    CoarseMesh
    cylinder_sector(const MeshParameters &q)
    {
      const Lattice n = {
        {q.subdivisions[1], q.subdivisions[0], q.subdivisions[2]}};
      const RigidMotion motion = rigid_motion(q);
      CoarseMesh        mesh;
      mesh.manifold = std::make_unique<CylindricalManifold<3>>(
        Tensor<1, 3>(motion.rotation * Point<3>(0., 0., 1.)),
        Point<3>(motion.translation));

      // Radial, around, axial is right handed.
      Block block;
      block.n          = n;
      block.boundaries = {{0, 1, 3, 2, 4, 5}};
      block.material   = [](const Lattice &) { return 0; };
      add_block(mesh, block, [&](const Lattice &p) {
        const double r     = between(q.extent[0], q.extent[1], p[0], n[0]);
        const double angle = between(0., 0.5 * numbers::PI, p[1], n[1]);
        return motion(Point<3>(r * std::cos(angle),
                               r * std::sin(angle),
                               between(0., q.extent[2], p[2], n[2])));
      });
      mesh.names.materials[0] = "sector";
      return mesh;
    }

    CurvedBlockManifold::Surface
    surface_of(const std::string &name)
    {
      return name == "bump"   ? CurvedBlockManifold::Surface::bump :
             name == "saddle" ? CurvedBlockManifold::Surface::saddle :
                                CurvedBlockManifold::Surface::wave;
    }

    CoarseMesh
    curved_block(const MeshParameters &q)
    {
      const std::vector<double> &e        = q.extent;
      const double               z_middle = e[2] + q.middle * (e[5] - e[2]);
      CoarseMesh                 mesh;
      mesh.manifold = std::make_unique<CurvedBlockManifold>(
        CurvedBlockManifold::Shape{e[0],
                                   e[1],
                                   e[2],
                                   e[3],
                                   e[4],
                                   e[5],
                                   z_middle,
                                   q.amplitude,
                                   surface_of(q.surface)},
        rigid_motion(q));
      const auto &chart =
        dynamic_cast<const CurvedBlockManifold &>(*mesh.manifold);

      const bool         both = q.half == "both", upper = q.half == "upper";
      const Lattice      n       = {{q.subdivisions[0],
                                     q.subdivisions[1],
                                     q.subdivisions[2] + (both ? q.subdivisions[3] : 0)}};
      const unsigned int n_lower = upper ? 0 : q.subdivisions[2];
      Block              block;
      block.n = n;
      // both: ..., zmin, zmax; lower: ..., zmin, interface; upper: ...,
      // interface, zmax.
      block.boundaries = {{0, 1, 2, 3, upper ? 5 : 4, upper ? 4 : 5}};
      block.material   = [n_lower](const Lattice &cell) {
        return cell[2] < n_lower ? 0 : 1;
      };
      add_block(mesh, block, [&](const Lattice &p) {
        const double z =
          p[2] <= n_lower ?
            (upper ? z_middle : between(e[2], z_middle, p[2], n_lower)) :
            between(z_middle, e[5], p[2] - n_lower, n[2] - n_lower);
        return chart.push_forward(Point<3>(between(e[0], e[3], p[0], n[0]),
                                           between(e[1], e[4], p[1], n[1]),
                                           z));
      });
      if (!upper)
        mesh.names.materials[0] = "lower half";
      if (upper || both)
        mesh.names.materials[1] = "upper half";
      return mesh;
    }
  } // namespace

  std::vector<std::string>
  generator_names()
  {
    return {"box", "shell octant", "cylinder sector", "curved block"};
  }

  std::vector<std::string>
  surface_names()
  {
    return {"bump", "saddle", "wave"};
  }

  std::vector<std::string>
  generator_boundaries(const MeshParameters &parameters)
  {
    if (parameters.source == "shell octant")
      return {"inside", "outside", "xmin", "ymin", "zmin"};
    if (parameters.source == "cylinder sector")
      return {"inside", "outside", "xmin", "ymin", "zmin", "zmax"};
    if (parameters.source == "curved block" && parameters.half == "lower")
      return {"xmin", "xmax", "ymin", "ymax", "zmin", "interface"};
    if (parameters.source == "curved block" && parameters.half == "upper")
      return {"xmin", "xmax", "ymin", "ymax", "zmax", "interface"};
    return {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  }

  CoarseMesh
  generate(const MeshParameters &parameters)
  {
    CoarseMesh mesh =
      parameters.source == "box"             ? box(parameters) :
      parameters.source == "shell octant"    ? shell_octant(parameters) :
      parameters.source == "cylinder sector" ? cylinder_sector(parameters) :
                                               curved_block(parameters);
    const std::vector<std::string> boundaries =
      generator_boundaries(parameters);
    for (unsigned int id = 0; id < boundaries.size(); ++id)
      mesh.names.boundaries[boundaries[id]] = first_id + id;
    return mesh;
  }
} // namespace mortise
