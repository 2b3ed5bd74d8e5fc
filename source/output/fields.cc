#include <mortise/operators/cells/cell_fields.h>
#include <mortise/output/fields.h>
#include <mortise/output/vtu_file.h>

#include <cmath>
#include <map>

namespace mortise
{
  using namespace dealii;

  double
  von_mises(const SymmetricTensor<2, dim> &stress)
  {
    return std::sqrt(1.5) * deviator(stress).norm();
  }

  namespace
  {
    /// The displacement on a cell as @p degree asks for it, at the nodes of a cell of a file.
    class CellNodes
    {
    public:
      CellNodes(const Body &body, const unsigned int degree)
        : shape(body.mesh.tetrahedra ? LagrangeShape::tetrahedron :
                                       LagrangeShape::hexahedron)
        , degree(degree)
        , fields(body, [&](const auto &) { return rule(); })
      {
        for (const auto &node : lagrange_nodes(shape, degree))
          place.push_back(shape == LagrangeShape::hexahedron ?
                            node[0] + (degree + 1) *
                                        (node[1] + (degree + 1) * node[2]) :
                            place.size());
      }

      const LagrangeShape       shape;
      const unsigned int        degree;
      CellFields                fields;
      std::vector<unsigned int> place; ///< of a node among the points of fields

    private:
      Quadrature<dim>
      rule() const
      {
        if (shape == LagrangeShape::hexahedron)
          return Quadrature<dim>(QIterated<1>(QTrapezoid<1>(), degree));
        std::vector<Point<dim>> points;
        for (const auto &node : lagrange_nodes(shape, degree))
          points.emplace_back(double(node[0]) / degree,
                              double(node[1]) / degree,
                              double(node[2]) / degree);
        return Quadrature<dim>(points);
      }
    };

    std::vector<VtuField>
    announce(const FieldSelection &selection)
    {
      std::vector<VtuField> fields;
      if (selection.displacement)
        fields.push_back({"displacement", dim, {}});
      if (selection.stress)
        {
          fields.push_back({"stress", dim * dim, {}});
          fields.push_back({"von_mises", 1, {}});
        }
      if (selection.pressure)
        fields.push_back({"pressure", 1, {}});
      if (selection.plastic_strain)
        fields.push_back({"plastic_strain", 1, {}});
      if (selection.deformation_gradient)
        fields.push_back({"deformation_gradient", dim * dim, {}});
      return fields;
    }

    /// Append the fields at point @p q, as they are announced.
    void
    append(const CellFields      &fields,
           const unsigned int     q,
           const FieldSelection  &selection,
           std::vector<VtuField> &target)
    {
      auto       field = target.begin();
      const auto put   = [&](const double value) {
        field->values.push_back(value);
      };
      if (selection.displacement)
        {
          for (unsigned int c = 0; c < dim; ++c)
            put(fields.values[q][c]);
          ++field;
        }
      SymmetricTensor<2, dim> stress;
      if (selection.stress || selection.pressure)
        stress = fields.stress(q);
      if (selection.stress)
        {
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              put(stress[i][j]);
          ++field;
          put(von_mises(stress));
          ++field;
        }
      if (selection.pressure)
        {
          put(-trace(stress) / dim);
          ++field;
        }
      if (selection.plastic_strain)
        {
          put(fields.plastic_strain(q));
          ++field;
        }
      if (selection.deformation_gradient)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            put(fields.gradients[q][i][j] + (i == j ? 1. : 0.));
    }
  } // namespace

  void
  write_body_fields(const Body                   &body,
                    const BodySolution           &solution,
                    const FieldSelection         &selection,
                    const std::vector<CellField> &of_cells,
                    const std::string            &file)
  {
    VtuPiece piece;
    piece.of_points = announce(selection);
    for (const CellField &field : of_cells)
      piece.of_cells.push_back({field.name, 1, {}});
    const CellGeometry                                 geometry(body,
                                body.mesh.tetrahedra ?
                                                                  ReferenceCells::Tetrahedron :
                                                                  ReferenceCells::Hexahedron,
                                QMidpoint<dim>());
    std::map<unsigned int, std::unique_ptr<CellNodes>> by_degree;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int degree =
            geometry.constant_jacobian(cell) ?
              body.degree(cell) :
              std::max(body.degree(cell), body.mapping_degree);
          auto &nodes = by_degree[degree];
          if (!nodes)
            nodes = std::make_unique<CellNodes>(body, degree);
          nodes->fields.reinit(cell, solution);
          piece.begin_cell(nodes->shape, degree);
          for (const unsigned int q : nodes->place)
            {
              piece.add_point(nodes->fields.points[q]);
              append(nodes->fields, q, selection, piece.of_points);
            }
          for (unsigned int i = 0; i < of_cells.size(); ++i)
            piece.of_cells[i].values.push_back(
              of_cells[i].values[cell->active_cell_index()]);
        }
    write_vtu_file(piece, file, body.triangulation().get_communicator());
  }
} // namespace mortise
