#include <mortise/operators/cells/cell_values.h>
#include <mortise/output/patches.h>
#include <mortise/output/simplex_fields.h>
#include <mortise/output/vtu_file.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The fields at the points of @p values, as they are announced; @p pressures
    /// are those of the mixed form, or zero.
    std::vector<std::vector<double>>
    evaluate_cell(const FEValues<dim>                        &values,
                  const std::array<std::vector<double>, dim> &coefficients,
                  const std::vector<double>                  &pressures,
                  const Material                             &material,
                  const FieldSelection                       &selection)
    {
      std::vector<std::vector<double>> data(values.n_quadrature_points);
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          if (selection.displacement)
            {
              const auto u = value(values, coefficients, q);
              data[q].insert(data[q].end(), u.begin_raw(), u.end_raw());
            }
          if (!selection.stress && !selection.pressure)
            continue;
          const auto stress =
            material.stress(gradient(values, coefficients, q), pressures[q]);
          if (selection.stress)
            {
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < dim; ++j)
                  data[q].push_back(stress[i][j]);
              data[q].push_back(std::sqrt(1.5) * deviator(stress).norm());
            }
          if (selection.pressure)
            data[q].push_back(-trace(stress) / dim);
        }
      return data;
    }
  } // namespace

  void
  write_tetrahedra(const Body                   &body,
                   const BodySolution           &solution,
                   const FieldSelection         &selection,
                   const std::vector<CellField> &of_cells,
                   const std::string            &file)
  {
    SimplexPatches<dim> output(body.max_degree());
    if (selection.displacement)
      output.add_field("displacement", dim);
    if (selection.stress)
      {
        output.add_field("stress", dim * dim);
        output.add_field("von_mises", 1);
      }
    if (selection.pressure)
      output.add_field("pressure", 1);
    for (const CellField &field : of_cells)
      output.add_field(field.name, 1);
    const Quadrature<dim> points(output.lattice.points);

    const auto rule = [&](const FiniteElement<dim> &) { return points; };
    ValuesByElement<FEValues<dim>> by_element(
      body, rule, update_values | update_gradients | update_quadrature_points),
      pressure_by_element(body, rule, update_values);
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          auto &values = by_element(cell);
          values.reinit(Triangulation<dim>::cell_iterator(cell));
          std::vector<double> pressures(points.size());
          if (body.pressure)
            {
              const auto own             = body.pressure->cell(cell);
              auto      &pressure_values = pressure_by_element(own);
              pressure_values.reinit(Triangulation<dim>::cell_iterator(own));
              pressures =
                pressures_at(pressure_values,
                             scalar_coefficients(own, solution.pressure));
            }
          auto data =
            evaluate_cell(values,
                          cell_coefficients(cell, solution.displacement),
                          pressures,
                          body.material,
                          selection);
          for (auto &at_point : data)
            for (const CellField &field : of_cells)
              at_point.push_back(field.values[cell->active_cell_index()]);
          output.add_simplex(values.get_quadrature_points(), data);
        }
    write_vtu_file(output, file, body.triangulation().get_communicator());
  }

  namespace
  {
    /// Append @p factor times the field with @p coefficients at the point where the functions have
    /// @p values.
    void
    append_field(const std::vector<double> &values,
                 const std::vector<double> &coefficients,
                 const double               factor,
                 std::vector<double>       &data)
    {
      for (unsigned int c = 0; c < dim; ++c)
        {
          double sum = 0.;
          if (!coefficients.empty())
            for (unsigned int k = 0; k < values.size(); ++k)
              sum += values[k] * coefficients[c * values.size() + k];
          data.push_back(factor * sum);
        }
    }
  } // namespace

  void
  write_triangles(const FieldFile                        &file,
                  const BodySurface                      &surface,
                  const std::vector<std::vector<double>> &multiplier,
                  const std::vector<std::vector<double>> &gap,
                  const bool                              is_contact,
                  const BodyVector                       &displacement)
  {
    unsigned int degree = 1;
    for (const FaceTrace &trace : surface.traces)
      degree = std::max(degree, trace.degree);
    SimplexPatches<2> output(Utilities::MPI::max(degree, file.comm));
    output.add_field("traction", dim);
    if (!is_contact)
      output.add_field("gap", dim);
    else
      for (const std::string &name : contact_field_names())
        output.add_field(name, 1);
    output.add_field("displacement", dim);

    for (unsigned int s = 0; s < surface.faces.size(); ++s)
      {
        std::vector<double> on_face;
        for (const auto &component :
             face_dofs(surface.cells[s], surface.face_numbers[s]))
          for (const auto dof : component)
            on_face.push_back(displacement(dof));

        const TraceBasis                &basis = surface.traces[s].basis();
        std::vector<double>              values(basis.size());
        std::vector<Point<dim>>          positions;
        std::vector<std::vector<double>> data;
        for (const Point<2> &xi : output.lattice.points)
          {
            basis.evaluate(xi[0], xi[1], values.data());
            positions.push_back(face_point(surface.faces[s], xi));
            data.emplace_back();
            append_field(values, multiplier[s], -1., data.back());
            append_field(values, gap[s], 1., data.back());
            append_field(values, on_face, 1., data.back());
          }
        output.add_simplex(positions, data);
      }
    write_vtu_file(output, file.name, file.comm);
  }
} // namespace mortise
