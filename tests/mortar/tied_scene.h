// Two bodies tied at one interface, from plain data up to B and the
// multipliers, and functions on their surfaces, for tests of the coupling.
#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/boundary_conditions.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/mortar/coupling.h>
#include <mortise/mortar/nodal_block.h>
#include <mortise/operators/scene_system.h>

#include <functional>

#include "hierarchical_constraint.h"

namespace mortise::testing
{
  using Field =
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

  struct Held
  {
    std::string           boundary;
    std::array<bool, dim> components{{true, true, true}};
  };

  struct TiedBody
  {
    MeshParameters                                 mesh;
    std::string                                    surface;
    unsigned int                                   degree = 1;
    std::vector<Held>                              dirichlet; ///< at zero
    std::map<dealii::types::material_id, unsigned> degree_by_region;
  };

  inline MeshParameters
  box_mesh(const std::vector<double>       &extent,
           const std::vector<unsigned int> &subdivisions,
           const bool                       tetrahedra = false)
  {
    MeshParameters mesh;
    mesh.extent       = extent;
    mesh.subdivisions = subdivisions;
    mesh.cells        = tetrahedra ? "tetrahedra" : "auto";
    return mesh;
  }

  /// Points on a face that determine the functions of its basis.
  inline std::vector<dealii::Point<2>>
  face_lattice(const TraceBasis &basis)
  {
    std::vector<dealii::Point<2>> points;
    for (unsigned int j = 0; j <= basis.degree; ++j)
      for (unsigned int i = 0; i <= basis.degree; ++i)
        if (basis.shape == FaceShape::quadrilateral || i + j <= basis.degree)
          points.emplace_back(double(i) / basis.degree,
                              double(j) / basis.degree);
    return points;
  }

  /// By slave face, the values at its nodes: entry c n + k of component c at node k of n. @p function: a polynomial that the
  /// faces' functions have.
  inline std::vector<std::vector<double>>
  values_at_nodes(const BodySurface &slave, const Field &function)
  {
    std::vector<std::vector<double>> result;
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      {
        const TraceBasis  &basis  = slave.traces[s].basis();
        const auto         points = face_lattice(basis);
        const unsigned int n      = points.size();
        // functions by values at the lattice, then values at the nodes
        dealii::FullMatrix<double> at_points(n, n), inverse(n, n),
          to_nodes(n, n);
        for (unsigned int q = 0; q < n; ++q)
          basis.evaluate(points[q][0], points[q][1], &at_points(q, 0));
        inverse.invert(at_points);
        face_nodal_basis(basis.shape, basis.degree)
          .values.mmult(to_nodes, inverse);
        result.emplace_back(dim * n, 0.);
        for (unsigned int q = 0; q < n; ++q)
          {
            const auto value = function(face_point(slave.faces[s], points[q]));
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int k = 0; k < n; ++k)
                result[s][c * n + k] += to_nodes(k, q) * value[c];
          }
      }
    return result;
  }

  /// A Gauss rule on the reference face, exact for degree 2 n - 2.
  inline dealii::Quadrature<2>
  face_rule(const FaceShape shape, const unsigned int n)
  {
    const dealii::QGauss<2> square(n);
    if (shape == FaceShape::quadrilateral)
      return square;
    std::vector<dealii::Point<2>> points;
    std::vector<double>           weights;
    for (unsigned int q = 0; q < square.size(); ++q)
      {
        const auto &x = square.point(q);
        points.emplace_back(x[0], x[1] * (1. - x[0]));
        weights.push_back(square.weight(q) * (1. - x[0]));
      }
    return {points, weights};
  }

  class TiedScene
  {
  public:
    /// The slave, body 0, and the master, body 1. @p nodal: with B in values at
    /// nodes, as for solvers without a matrix. @p one_sided: multipliers along normals
    /// that have the sign of the pressure. @p friction: and all components of
    /// the traction with them.
    TiedScene(const TiedBody       &slave,
              const TiedBody       &master,
              const MPI_Comm        comm      = MPI_COMM_WORLD,
              const bool            nodal     = false,
              const MultiplierBasis basis     = MultiplierBasis::standard,
              const bool            one_sided = false,
              const bool            friction  = false)
      : comm(comm)
      , given{{slave, master}}
    {
      std::vector<const dealii::DoFHandler<dim> *> handlers;
      for (unsigned int b = 0; b < 2; ++b)
        {
          create_body(b);
          handlers.push_back(&bodies[b]->dof_handler);
        }
      field.numbering   = FieldNumbering(handlers, comm);
      field.constraints = scene_constraints(field.numbering, constraints);
      if (nodal)
        spaces = make_nodal_spaces({bodies[0].get(), bodies[1].get()}, comm);
      create_coupling(basis, one_sided, friction);
    }

    dealii::types::boundary_id
    surface(const unsigned int b) const
    {
      return bodies[b]->boundary_id(given[b].surface, "");
    }

    CouplingPartition
    partition() const
    {
      return {field.numbering.owned(), owned_multiplier, comm};
    }

    const Coupling &
    coupling() const
    {
      return couplings[0];
    }

    /// B in the numbering's columns.
    SparseMatrix
    constraint() const
    {
      return hierarchical_constraint(couplings, partition());
    }

    /// Coefficients of @p function on the tied surface of body @p b, zero
    /// elsewhere, added to @p u; exact where the elements hold it and nothing
    /// is prescribed.
    void
    interpolate(const unsigned int b,
                const Field       &function,
                mortise::Vector   &u) const
    {
      for (const auto &[cell, f] : boundary_faces(*bodies[b], surface(b)))
        {
          const CellFace             face(cell, f);
          const auto                 dofs   = face_dofs(cell, f);
          const auto                 points = face_lattice(*face.basis);
          const unsigned int         n      = points.size();
          dealii::FullMatrix<double> inverse(n, n);
          std::vector<dealii::Tensor<1, dim>> values;
          for (unsigned int q = 0; q < n; ++q)
            {
              face.basis->evaluate(points[q][0], points[q][1], &inverse(q, 0));
              values.push_back(
                function(bodies[b]->mapping->transform_unit_to_real_cell(
                  cell, face.unit_point(points[q][0], points[q][1]))));
            }
          inverse.gauss_jordan();
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int k = 0; k < n; ++k)
              if (const auto i = field.numbering(b, dofs[c][k]);
                  field.numbering.owned().is_element(i) &&
                  !field.constraints.is_constrained(i))
                {
                  double sum = 0.;
                  for (unsigned int q = 0; q < n; ++q)
                    sum += inverse(k, q) * values[q][c];
                  u(i) = sum;
                }
        }
    }

    mortise::Vector
    displacement() const
    {
      return mortise::Vector(field.numbering.owned(), comm);
    }

    mortise::Vector
    multiplier() const
    {
      return mortise::Vector(owned_multiplier, comm);
    }

    const MPI_Comm                                 comm;
    const std::array<TiedBody, 2>                  given;
    Bodies                                         bodies;
    std::vector<dealii::AffineConstraints<double>> constraints;
    SceneField                                     field;
    NodalSpaces                                    spaces;    ///< or none
    std::vector<Coupling>                          couplings; ///< one
    std::vector<PartnerState>                      states;    ///< by slave face
    dealii::IndexSet                               owned_multiplier;

  private:
    void
    create_body(const unsigned int b)
    {
      const TiedBody &from = given[b];
      bodies.push_back(
        std::make_unique<Body>("body", b, LinearElastic{1. + b, 0.3}));
      Body &body = *bodies[b];
      body.create_mesh(from.mesh, comm, "", {from.surface});
      body.create_space(from.degree, from.degree_by_region, "");
      std::vector<DirichletCondition> conditions;
      for (const Held &dirichlet : from.dirichlet)
        conditions.push_back(
          {body.boundary_id(dirichlet.boundary, ""), dirichlet.components, {}});
      constraints.emplace_back();
      constraints[b].copy_from(body.conformity);
      add_dirichlet_constraints(body, conditions, constraints[b]);
    }

    void
    create_coupling(const MultiplierBasis basis,
                    const bool            one_sided,
                    const bool            friction)
    {
      const auto side = [&](const unsigned int b) {
        return extract_surface(*bodies[b],
                               boundary_faces(*bodies[b], surface(b)),
                               field.numbering,
                               field.constraints,
                               spaces);
      };
      couplings.emplace_back();
      Coupling &coupling = couplings[0];
      coupling.interface = std::make_unique<InterfaceHandler>(
        "glue", side(0), side(1), InterfaceOptions(), comm);
      if (one_sided)
        {
          coupling.law.law = Law::contact;
          if (!friction)
            coupling.law.constrained = ConstrainedDirections::normal;
        }
      coupling.frames = slave_frames(*bodies[0], coupling.interface->slave());
      coupling.local  = integrate_coupling(*coupling.interface, true, basis);
      states          = partner_states(couplings)[0];

      std::vector<bool> constrained;
      for (const auto dof : bodies[0]->dof_handler.locally_owned_dofs())
        constrained.push_back(constraints[0].is_constrained(dof) &&
                              !bodies[0]->conformity.is_constrained(dof));
      const BodySurface &slave = coupling.interface->slave();
      coupling.multipliers     = std::make_unique<MultiplierSpace>(*bodies[0],
                                                               coupling,
                                                               states,
                                                               constrained);
      const auto counts =
        dealii::Utilities::MPI::all_gather(comm,
                                           coupling.multipliers->n_owned());
      const unsigned int me = dealii::Utilities::MPI::this_mpi_process(comm);
      const auto         first =
        std::accumulate(counts.begin(), counts.begin() + me, 0u);
      owned_multiplier =
        dealii::IndexSet(std::accumulate(counts.begin(), counts.end(), 0u));
      owned_multiplier.add_range(first, first + counts[me]);
      owned_multiplier.compress();
      coupling.multipliers->number(slave, first);
    }
  };
} // namespace mortise::testing
