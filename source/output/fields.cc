#include <deal.II/lac/vector.h>

#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_out_faces.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <mortise/output/fields.h>
#include <mortise/output/simplex_fields.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Cauchy stress, 9 entries, and von Mises stress.
    class StressPostprocessor : public DataPostprocessor<dim>
    {
    public:
      explicit StressPostprocessor(const LinearElastic &material)
        : material(material)
      {}

      std::vector<std::string>
      get_names() const override
      {
        std::vector<std::string> names(dim * dim, "stress");
        names.push_back("von_mises");
        return names;
      }

      std::vector<DataComponentInterpretation::DataComponentInterpretation>
      get_data_component_interpretation() const override
      {
        std::vector<DataComponentInterpretation::DataComponentInterpretation>
          kinds(dim * dim,
                DataComponentInterpretation::component_is_part_of_tensor);
        kinds.push_back(DataComponentInterpretation::component_is_scalar);
        return kinds;
      }

      UpdateFlags
      get_needed_update_flags() const override
      {
        return update_gradients;
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
            const SymmetricTensor<2, dim> stress =
              material.stress(symmetrize(gradient));
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                computed[q](dim * i + j) = stress[i][j];
            computed[q](dim * dim) = std::sqrt(1.5) * deviator(stress).norm();
          }
      }

    private:
      const LinearElastic material;
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

    /// Gap by local L2 projection on each face: mass^{-1} int N_i (x_master -
    /// x_slave).
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
            inverse.invert(local.mass);
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
  write_body_fields(const Body           &body,
                    const BodyVector     &displacement,
                    const FieldSelection &selection,
                    const std::string    &directory)
  {
    if (body.mesh.tetrahedra)
      return write_tetrahedra(body, displacement, selection, directory);
    const unsigned int        degree = body.max_degree();
    const StressPostprocessor stress(body.material);
    DataOut<dim>              output;
    output.set_flags(flags(degree));
    output.attach_dof_handler(body.dof_handler);
    if (selection.displacement)
      output.add_data_vector(displacement,
                             std::vector<std::string>(dim, "displacement"),
                             DataOut<dim>::type_dof_data,
                             vector_field);
    if (selection.stress)
      output.add_data_vector(displacement, stress);
    output.build_patches(*body.mapping,
                         degree,
                         body.mesh.curved ? DataOut<dim>::curved_inner_cells :
                                            DataOut<dim>::no_curved_cells);
    output.write_vtu_in_parallel(directory + "/" + body.name + ".vtu",
                                 body.triangulation().get_communicator());
  }

  void
  write_interface_fields(const Body                             &slave_body,
                         const Coupling                         &coupling,
                         const std::vector<std::vector<double>> &coefficients,
                         const BodyVector                       &displacement,
                         const std::string                      &directory)
  {
    const BodySurface &surface = coupling.interface->slave();
    if (slave_body.mesh.tetrahedra)
      return write_triangles({coupling.interface->name(),
                              directory,
                              slave_body.triangulation().get_communicator()},
                             surface,
                             coefficients,
                             gap_coefficients(coupling),
                             displacement);
    const unsigned int degree = slave_body.max_degree();
    const BodyVector   traction =
      from_faces(slave_body, surface, coefficients, -1.);
    const BodyVector gap =
      from_faces(slave_body, surface, gap_coefficients(coupling), 1.);

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
    add(gap, "gap");
    add(displacement, "displacement");
    output.build_patches(*slave_body.mapping, degree);
    output.write_vtu_in_parallel(directory + "/" + coupling.interface->name() +
                                   ".vtu",
                                 slave_body.triangulation().get_communicator());
  }
} // namespace mortise
