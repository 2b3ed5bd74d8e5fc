#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/vector.h>

#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_out_faces.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <mortise/body/elements/legendre_elements.h>
#include <mortise/operators/cells/cell_values.h>
#include <mortise/output/fields.h>
#include <mortise/output/simplex_fields.h>
#include <mortise/output/vtu_file.h>

#include <cmath>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Cauchy stress, 9 entries, von Mises stress, and mean pressure, from
    /// displacement and, in mixed form, pressure as a fourth component.
    class StressPostprocessor : public DataPostprocessor<dim>
    {
    public:
      StressPostprocessor(const Material       &material,
                          const FieldSelection &selection)
        : material(material)
        , selection(selection)
      {}

      std::vector<std::string>
      get_names() const override
      {
        std::vector<std::string> names;
        if (selection.stress)
          {
            names.assign(dim * dim, "stress");
            names.push_back("von_mises");
          }
        if (selection.pressure)
          names.push_back("pressure");
        return names;
      }

      std::vector<DataComponentInterpretation::DataComponentInterpretation>
      get_data_component_interpretation() const override
      {
        std::vector<DataComponentInterpretation::DataComponentInterpretation>
          kinds;
        for (const std::string &name : get_names())
          kinds.push_back(
            name == "stress" ?
              DataComponentInterpretation::component_is_part_of_tensor :
              DataComponentInterpretation::component_is_scalar);
        return kinds;
      }

      UpdateFlags
      get_needed_update_flags() const override
      {
        return update_values | update_gradients;
      }

      void
      evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &input,
        std::vector<dealii::Vector<double>>        &computed) const override
      {
        for (unsigned int q = 0; q < computed.size(); ++q)
          {
            Tensor<2, dim> gradient;
            for (unsigned int c = 0; c < dim; ++c)
              gradient[c] = input.solution_gradients[q][c];
            const SymmetricTensor<2, dim> stress = material.stress(
              gradient, material.mixed() ? input.solution_values[q][dim] : 0.);
            unsigned int next = 0;
            if (selection.stress)
              {
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = 0; j < dim; ++j)
                    computed[q](next++) = stress[i][j];
                computed[q](next++) = std::sqrt(1.5) * deviator(stress).norm();
              }
            if (selection.pressure)
              computed[q](next++) = -trace(stress) / dim;
          }
      }

    private:
      const Material       material;
      const FieldSelection selection;
    };

    /// Displacement and pressure of a body in mixed form as one field of four
    /// components of one degree: the pressure has no modes of the highest.
    struct MixedField
    {
      MixedField(const Body &body, const BodySolution &solution)
        : handler(body.triangulation())
      {
        std::set<unsigned int> used;
        for (unsigned int i = 0; i < body.fe.size(); ++i)
          used.insert(body.fe[i].degree);
        const auto given = [&](const auto &cell) {
          return Body::CellIterator(&body.triangulation(),
                                    cell->level(),
                                    cell->index(),
                                    &body.dof_handler);
        };
        distribute_legendre_dofs(
          used,
          [&](const auto &cell) { return body.degree(given(cell)); },
          dim + 1,
          fe,
          handler);
        IndexSet relevant;
        DoFTools::extract_locally_relevant_dofs(handler, relevant);
        vector.reinit(handler.locally_owned_dofs(),
                      relevant,
                      body.triangulation().get_communicator());
        for (const auto &cell : handler.active_cell_iterators())
          if (cell->is_locally_owned())
            set_cell(cell, given(cell), body, solution);
        vector.update_ghost_values();
      }

      hp::FECollection<dim> fe;
      DoFHandler<dim>       handler;
      BodyVector            vector;

    private:
      void
      set_cell(const Body::CellIterator &cell,
               const Body::CellIterator &given,
               const Body               &body,
               const BodySolution       &solution)
      {
        const auto        &all = cell->get_fe();
        const unsigned int p   = all.degree;
        dofs.resize(all.n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        const auto set = [&](const unsigned int c,
                             const unsigned int mode,
                             const double       value) {
          const auto dof = dofs[all.component_to_system_index(c, mode)];
          if (vector.in_local_range(dof))
            vector(dof) = value;
        };
        const auto displacement =
          cell_coefficients(given, solution.displacement);
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int i = 0; i < displacement[c].size(); ++i)
            set(c, i, displacement[c][i]);
        const auto own =
          scalar_coefficients(body.pressure->cell(cell), solution.pressure);
        const auto modes = nested_modes(cell->reference_cell(), p - 1, p);
        for (unsigned int i = 0; i < modes.size(); ++i)
          set(dim, modes[i], own[i]);
      }

      std::vector<types::global_dof_index> dofs;
    };

    /// Only the slave faces of one interface.
    class SurfaceOutput : public DataOutFaces<dim>
    {
    public:
      explicit SurfaceOutput(const BodySurface &surface)
        : surface(surface)
      {}

    protected:
      typename DataOutFaces<dim>::FaceDescriptor
      first_face() override
      {
        next = 0;
        return descriptor();
      }

      typename DataOutFaces<dim>::FaceDescriptor
      next_face(const typename DataOutFaces<dim>::FaceDescriptor &) override
      {
        ++next;
        return descriptor();
      }

    private:
      typename DataOutFaces<dim>::FaceDescriptor
      descriptor() const
      {
        if (next >= surface.faces.size())
          return {triangulation->end(), 0};
        return {typename Triangulation<dim>::cell_iterator(surface.cells[next]),
                surface.face_numbers[next]};
      }

      const BodySurface &surface;
      unsigned int       next = 0;
    };

    DataOutBase::VtkFlags
    flags(const unsigned int degree)
    {
      DataOutBase::VtkFlags result;
      result.write_higher_order_cells = degree > 1;
      result.compression_level        = DataOutBase::VtkFlags::best_speed;
      return result;
    }

    const std::vector<DataComponentInterpretation::DataComponentInterpretation>
      vector_field(dim,
                   DataComponentInterpretation::component_is_part_of_vector);

    /// A field on a slave surface as coefficients of the body's displacement
    /// space, from coefficients on faces; where faces disagree, their mean.
    BodyVector
    from_faces(const Body                             &body,
               const BodySurface                      &surface,
               const std::vector<std::vector<double>> &coefficients,
               const double                            factor)
    {
      BodyVector vector(body.dof_handler.locally_owned_dofs(),
                        body.relevant_dofs,
                        body.triangulation().get_communicator());
      BodyVector count(vector);
      for (unsigned int s = 0; s < surface.faces.size(); ++s)
        {
          if (coefficients[s].empty())
            continue;
          const auto dofs =
            face_dofs(surface.cells[s], surface.face_numbers[s]);
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int k = 0; k < dofs[c].size(); ++k)
              {
                vector(dofs[c][k]) +=
                  factor * coefficients[s][c * dofs[c].size() + k];
                count(dofs[c][k]) += 1.;
              }
        }
      vector.compress(VectorOperation::add);
      count.compress(VectorOperation::add);
      for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
        vector.local_element(i) /= std::max(1., count.local_element(i));
      vector.update_ghost_values();
      return vector;
    }

    /// Gap by local projection on each face: that of x_master - x_slave, as
    /// multipliers see it.
    std::vector<std::vector<double>>
    gap_coefficients(const Coupling &coupling)
    {
      std::vector<std::vector<double>> result(coupling.local.size());
      for (unsigned int s = 0; s < coupling.local.size(); ++s)
        if (!coupling.local[s].partners.empty() &&
            coupling.interface->coverage()[s] > 0.5)
          {
            const auto        &local = coupling.local[s];
            const unsigned int n     = local.mass.m();
            FullMatrix<double> inverse(n, n);
            inverse.invert(local.constraint);
            result[s].assign(dim * n, 0.);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                for (unsigned int c = 0; c < dim; ++c)
                  result[s][c * n + i] +=
                    inverse(i, j) * local.gap_moment[j][c];
          }
      return result;
    }
  } // namespace

  void
  write_body_fields(const Body                   &body,
                    const BodySolution           &solution,
                    const FieldSelection         &selection,
                    const std::vector<CellField> &of_cells,
                    const std::string            &file)
  {
    if (body.mesh.tetrahedra)
      return write_tetrahedra(body, solution, selection, of_cells, file);
    const unsigned int          degree = body.max_degree();
    const StressPostprocessor   stress(body.material, selection);
    std::unique_ptr<MixedField> mixed;
    DataOut<dim>                output;
    output.set_flags(flags(degree));
    output.attach_dof_handler(body.dof_handler);
    if (selection.displacement)
      output.add_data_vector(solution.displacement,
                             std::vector<std::string>(dim, "displacement"),
                             DataOut<dim>::type_dof_data,
                             vector_field);
    if (selection.stress || selection.pressure)
      {
        if (body.pressure)
          {
            mixed = std::make_unique<MixedField>(body, solution);
            output.add_data_vector(mixed->handler, mixed->vector, stress);
          }
        else
          output.add_data_vector(solution.displacement, stress);
      }
    std::vector<dealii::Vector<float>> numbers; // which the output refers to
    numbers.reserve(of_cells.size());
    for (const CellField &field : of_cells)
      {
        numbers.emplace_back(field.values.begin(), field.values.end());
        output.add_data_vector(numbers.back(),
                               field.name,
                               DataOut<dim>::type_cell_data);
      }
    output.build_patches(*body.mapping,
                         degree,
                         body.mesh.curved ? DataOut<dim>::curved_inner_cells :
                                            DataOut<dim>::no_curved_cells);
    write_vtu_file(output, file, body.triangulation().get_communicator());
  }

  void
  write_interface_fields(const Body                             &slave_body,
                         const Coupling                         &coupling,
                         const std::vector<std::vector<double>> &coefficients,
                         const std::vector<std::vector<double>> &contact,
                         const BodyVector                       &displacement,
                         const std::string                      &file)
  {
    const BodySurface &surface = coupling.interface->slave();
    if (slave_body.mesh.tetrahedra)
      return write_triangles({file,
                              slave_body.triangulation().get_communicator()},
                             surface,
                             coefficients,
                             coupling.is_contact ? contact :
                                                   gap_coefficients(coupling),
                             coupling.is_contact,
                             displacement);
    const unsigned int degree = slave_body.max_degree();
    const BodyVector   traction =
      from_faces(slave_body, surface, coefficients, -1.);
    const BodyVector gap =
      from_faces(slave_body,
                 surface,
                 coupling.is_contact ? contact : gap_coefficients(coupling),
                 1.);

    SurfaceOutput output(surface);
    output.set_flags(flags(degree));
    output.attach_dof_handler(slave_body.dof_handler);
    const auto add = [&](const BodyVector &field, const std::string &name) {
      output.add_data_vector(field,
                             std::vector<std::string>(dim, name),
                             DataOutFaces<dim>::type_dof_data,
                             vector_field);
    };
    add(traction, "traction");
    if (coupling.is_contact)
      output.add_data_vector(gap,
                             contact_field_names(),
                             DataOutFaces<dim>::type_dof_data);
    else
      add(gap, "gap");
    add(displacement, "displacement");
    output.build_patches(*slave_body.mapping, degree);
    write_vtu_file(output, file, slave_body.triangulation().get_communicator());
  }
} // namespace mortise
