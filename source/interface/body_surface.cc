#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/interface/body_surface.h>

#include <algorithm>
#include <limits>
#include <string>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// How far the cell reaches from the face, normal to it.
    double
    depth(const Body::CellIterator &cell, const CellFace &face)
    {
      const auto vertex = [&](const unsigned int v) {
        return Tensor<1, dim>(cell->vertex(face.vertices[v]));
      };
      const unsigned int n = face.basis->n_vertices();
      Tensor<1, dim>     on_face, elsewhere;
      for (unsigned int v = 0; v < n; ++v)
        on_face += vertex(v);
      for (const unsigned int v : cell->vertex_indices())
        elsewhere += cell->vertex(v);
      elsewhere -= on_face;
      // by the diagonals of a quadrilateral, whose vertices are those of a
      // lattice
      const Tensor<1, dim> normal =
        n == 3 ?
          cross_product_3d(vertex(1) - vertex(0), vertex(2) - vertex(0)) :
          cross_product_3d(vertex(3) - vertex(0), vertex(2) - vertex(1));
      return std::fabs((elsewhere / (cell->n_vertices() - n) - on_face / n) *
                       normal) /
             normal.norm();
    }

    FaceTrace
    face_trace(const Body                      &body,
               const Body::CellIterator        &cell,
               const unsigned int               f,
               const FieldNumbering            &numbering,
               const AffineConstraints<double> &constraints)
    {
      FaceTrace trace;
      trace.shape =
        body.mesh.tetrahedra ? FaceShape::triangle : FaceShape::quadrilateral;
      trace.degree    = body.degree(cell);
      trace.modulus   = body.material.modulus();
      trace.depth     = depth(cell, CellFace(cell, f));
      const auto dofs = face_dofs(cell, f);
      trace.begin     = {0};
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int k = 0; k < trace.n_functions(); ++k)
          {
            const auto dof = numbering(body.index, dofs[c][k]);
            if (constraints.is_constrained(dof))
              for (const auto &entry : *constraints.get_constraint_entries(dof))
                {
                  trace.column.push_back(entry.first);
                  trace.weight.push_back(entry.second);
                }
            else
              {
                trace.column.push_back(dof);
                trace.weight.push_back(1.);
              }
            trace.prescribed.push_back(constraints.is_constrained(dof) ?
                                         dof :
                                         numbers::invalid_dof_index);
            trace.begin.push_back(trace.column.size());
          }
      return trace;
    }

    /// Throws InputError on all ranks where a face of one cannot be finalized.
    /// Collective.
    void
    finalize(std::vector<SurfaceFace> &faces, const Body &body)
    {
      std::string wrong;
      for (SurfaceFace &face : faces)
        try
          {
            face.finalize();
          }
        catch (const InputError &error)
          {
            wrong = error.what();
            break;
          }
      throw_if_any(wrong, body.triangulation().get_communicator());
    }
  } // namespace

  SurfaceFace
  face_geometry(const Body         &body,
                const BoundaryFace &at,
                const Displacement  displacement)
  {
    const CellFace face(at.cell, at.number);
    SurfaceFace    result;
    result.shape       = face.basis->shape;
    result.degree      = displacement ?
                           std::max(body.mapping_degree, face.basis->degree) :
                           body.mapping_degree;
    result.orientation = face.orientation;
    result.id          = at.cell->global_active_cell_index() * 6 + at.number;
    result.owner       = at.cell->subdomain_id();
    const QGaussLobatto<1> nodes(result.degree + 1);
    for (unsigned int j = 0; j <= result.degree; ++j)
      for (unsigned int i = 0; i <= result.degree; ++i)
        // a triangle's points beyond it follow from the others
        result.points.push_back(
          result.shape == FaceShape::triangle && i + j > result.degree ?
            Point<3>() :
            body.mapping->transform_unit_to_real_cell(
              at.cell, face.unit_point(nodes.point(i)[0], nodes.point(j)[0])));
    if (!displacement)
      return result;
    const auto          dofs = face_dofs(at.cell, at.number);
    std::vector<double> values(face.basis->size());
    for (unsigned int j = 0; j <= result.degree; ++j)
      for (unsigned int i = 0; i <= result.degree; ++i)
        {
          face.basis->evaluate(nodes.point(i)[0],
                               nodes.point(j)[0],
                               values.data());
          Point<3> &x = result.points[j * (result.degree + 1) + i];
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int k = 0; k < values.size(); ++k)
              x[c] += values[k] * (*displacement)(dofs[c][k]);
        }
    return result;
  }

  std::vector<SurfaceFace>
  whole_boundary(const Body &body, const Displacement displacement)
  {
    std::vector<SurfaceFace> result;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            result.push_back(face_geometry(body, {cell, f}, displacement));
    finalize(result, body);
    return result;
  }

  std::array<std::uint64_t, 4>
  face_vertices(const BoundaryFace &at)
  {
    const CellFace               face(at.cell, at.number);
    std::array<std::uint64_t, 4> result{};
    for (unsigned int v = 0; v < face.basis->n_vertices(); ++v)
      result[v] = at.cell->vertex_index(face.vertices[v]);
    return result;
  }

  std::array<std::vector<types::global_dof_index>, dim>
  face_dofs(const Body::CellIterator &cell, const unsigned int face_number)
  {
    const auto                          &fe = cell->get_fe();
    std::vector<types::global_dof_index> cell_dofs(fe.n_dofs_per_cell());
    cell->get_dof_indices(cell_dofs);
    const CellFace face(cell, face_number);

    std::array<std::vector<types::global_dof_index>, dim> dofs;
    for (unsigned int c = 0; c < dim; ++c)
      for (const unsigned int i : face.indices)
        dofs[c].push_back(cell_dofs[fe.component_to_system_index(c, i)]);
    return dofs;
  }

  BodySurface
  extract_surface(const Body                      &body,
                  const std::vector<BoundaryFace> &known,
                  const FieldNumbering            &numbering,
                  const AffineConstraints<double> &constraints,
                  const NodalSpaces               &levels,
                  const Displacement               displacement)
  {
    // ghost cells take part in the averaging of normals
    BodySurface surface;
    surface.known = known;
    std::vector<SurfaceFace>                  faces;
    std::vector<std::array<std::uint64_t, 4>> vertices;
    std::vector<bool>                         owned;
    for (const BoundaryFace &at : known)
      {
        const auto &[cell, f] = at;
        faces.push_back(face_geometry(body, at, displacement));
        vertices.push_back(face_vertices(at));
        owned.push_back(cell->is_locally_owned());
        if (owned.back())
          {
            surface.cells.push_back(cell);
            surface.face_numbers.push_back(f);
          }
      }
    average_vertex_normals(faces, vertices);

    for (unsigned int i = 0; i < faces.size(); ++i)
      if (owned[i])
        {
          const unsigned int local = surface.faces.size();
          surface.traces.push_back(face_trace(body,
                                              surface.cells[local],
                                              surface.face_numbers[local],
                                              numbering,
                                              constraints));
          for (const auto &level : levels)
            surface.traces.back().nodes.push_back(level->face_nodes(
              body, surface.cells[local], surface.face_numbers[local]));
          faces[i].payload = Utilities::pack(surface.traces.back(), false);
          surface.faces.push_back(std::move(faces[i]));
        }
    finalize(surface.faces, body);
    return surface;
  }

  std::vector<SurfaceFace>
  undeformed_faces(const Body &body, const BodySurface &surface)
  {
    std::vector<SurfaceFace> result;
    for (unsigned int s = 0; s < surface.faces.size(); ++s)
      {
        result.push_back(
          face_geometry(body, {surface.cells[s], surface.face_numbers[s]}));
        result.back().finalize();
      }
    return result;
  }

  void
  place(const RigidMotion &motion, std::vector<SurfaceFace> &faces)
  {
    for (SurfaceFace &face : faces)
      {
        for (Point<3> &point : face.points)
          point = motion(point);
        for (Tensor<1, 3> &normal : face.vertex_normals)
          normal = motion.rotation * normal;
        face.finalize();
      }
  }

  BodySurface
  rigid_obstacle(const BodySurface &surface)
  {
    BodySurface result = surface;
    for (unsigned int s = 0; s < result.faces.size(); ++s)
      {
        SurfaceFace &face  = result.faces[s];
        FaceTrace   &trace = result.traces[s];
        face.orientation *= -1.;
        for (auto &normal : face.vertex_normals)
          normal *= -1.;
        face.finalize();
        trace.modulus = std::numeric_limits<double>::infinity();
        std::fill(trace.begin.begin(), trace.begin.end(), 0);
        std::fill(trace.prescribed.begin(),
                  trace.prescribed.end(),
                  numbers::invalid_dof_index);
        trace.column.clear();
        trace.weight.clear();
        for (FaceNodes &nodes : trace.nodes)
          nodes = {nodes.degree,
                   {},
                   std::vector<unsigned int>(
                     trace_basis(trace.shape, nodes.degree).size() + 1, 0),
                   {},
                   {}};
        face.payload = Utilities::pack(trace, false);
      }
    return result;
  }
} // namespace mortise
