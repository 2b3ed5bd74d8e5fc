// The loads on one cell: by sum factorisation on hexahedra, tractions with the
// functions of the face alone.
#pragma once

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/vector.h>

#include <mortise/operators/cells/face_values.h>
#include <mortise/operators/scene_load.h>

#include <array>
#include <memory>
#include <vector>

namespace mortise
{
  /// Loads on the cells of one element. Tables are made on demand.
  class LoadKernel
  {
  public:
    /// Both are kept by reference.
    LoadKernel(const Body &body, const dealii::FiniteElement<dim> &system);
    ~LoadKernel();

    /// int b.v + int t.v - int sigma_0 : grad v, see for_each_loaded_cell(), in
    /// the numbering of @p cell.
    const dealii::Vector<double> &
    compute(const Body::CellIterator &cell, const Loads &loads);

  private:
    struct Hexahedra;

    void
    add_to_hexahedron(const Body::CellIterator &cell, const Loads &loads);
    void
    add_to_tetrahedron(const Body::CellIterator &cell, const Loads &loads);
    /// Thermal stress without displacement, without the pressure of the mixed
    /// form.
    dealii::Tensor<2, dim>
    thermal_stress(const Loads &loads, const dealii::Point<dim> &x) const;
    void
    add_traction(const Body::CellIterator &cell,
                 unsigned int              f,
                 const TractionCondition  &condition);

    const Body                                &body;
    const dealii::FiniteElement<dim>          &system;
    std::array<std::vector<unsigned int>, dim> system_index;
    dealii::Vector<double>                     load;
    std::unique_ptr<Hexahedra>                 hexahedra;
    std::unique_ptr<dealii::FEValues<dim>>     tetrahedra;
    std::array<std::unique_ptr<FaceValues>, 6> faces;
  };
} // namespace mortise
