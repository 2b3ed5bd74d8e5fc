#include <deal.II/lac/full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/operators/cell_kernel.h>
#include <mortise/operators/elasticity.h>
#include <mortise/operators/element_schur.h>
#include <mortise/operators/load_kernel.h>
#include <mortise/operators/matrix_scatter.h>
#include <mortise/operators/pressure_kernel.h>
#include <mortise/operators/pressure_scatter.h>

#include <map>
#include <memory>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::vector<types::global_dof_index>
    scene_dofs(const Body               &body,
               const Body::CellIterator &cell,
               const FieldNumbering     &numbering)
    {
      std::vector<types::global_dof_index> dofs(
        cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      for (auto &dof : dofs)
        dof = numbering(body.index, dof);
      return dofs;
    }

    struct Kernel
    {
      Kernel(const Body &body, const FiniteElement<dim> &system)
        : body(body)
        , system(system)
        , loads(body, system)
        , stiffness(body, system)
        , matrix(system.n_dofs_per_cell())
      {}

      const Body                     &body;
      const FiniteElement<dim>       &system;
      LoadKernel                      loads;
      dealii::Vector<double>          load;
      CellKernel                      stiffness;
      FullMatrix<double>              matrix;
      std::unique_ptr<PressureKernel> pressure; ///< in mixed form
      PressureBlocks                  blocks;
    };

    /// Eliminate the interior of the cell and add the rest. Its own rows keep a
    /// diagonal of the same size and couple with nothing.
    void
    add_condensed(Kernel                              &kernel,
                  std::vector<types::global_dof_index> dofs,
                  CondensedInteriors                  &interiors,
                  MatrixScatter                       &scatter)
    {
      const unsigned int n_b = kernel.system.get_first_hex_index();
      if (n_b < dofs.size())
        {
          for (unsigned int i = n_b; i < dofs.size(); ++i)
            scatter.add_diagonal(dofs[i], kernel.matrix(i, i));
          if (!interiors.eliminate(kernel.matrix, kernel.load, n_b))
            throw std::runtime_error(
              "the stiffness of a cell's interior is not positive definite");
          dofs.resize(n_b);
        }
      scatter.add(kernel.matrix, kernel.load, dofs);
    }

    /// Which displacements of the boundary of a cell are not prescribed.
    std::vector<unsigned int>
    not_prescribed(const AffineConstraints<double>            &constraints,
                   const std::vector<types::global_dof_index> &dofs,
                   const FiniteElement<dim>                   &system)
    {
      std::vector<unsigned int> free;
      for (unsigned int i = 0; i < system.get_first_hex_index(); ++i)
        if (const auto *entries = constraints.get_constraint_entries(dofs[i]);
            entries == nullptr || !entries->empty())
          free.push_back(i);
      return free;
    }

    /// [K G^T; G -C] and the load of a cell: displacements of its boundary, all
    /// pressures, displacements of its interior.
    std::pair<FullMatrix<double>, dealii::Vector<double>>
    mixed_cell(const Kernel &kernel)
    {
      const unsigned int n_b      = kernel.system.get_first_hex_index(),
                         n_u      = kernel.matrix.m(),
                         n_p      = kernel.pressure->mass().m();
      const FullMatrix<double> &G = kernel.pressure->divergence(),
                               &M = kernel.pressure->mass();
      const double c              = kernel.body.material.compressibility();
      const auto   place          = [&](const unsigned int i) {
        return i < n_b ? i : i + n_p;
      };
      FullMatrix<double>     all(n_u + n_p);
      dealii::Vector<double> load(n_u + n_p);
      for (unsigned int i = 0; i < n_u; ++i)
        {
          load(place(i)) = kernel.load(i);
          for (unsigned int j = 0; j < n_u; ++j)
            all(place(i), place(j)) = kernel.matrix(i, j);
          for (unsigned int k = 0; k < n_p; ++k)
            all(place(i), n_b + k) = all(n_b + k, place(i)) = G(k, i);
        }
      for (unsigned int k = 0; k < n_p; ++k)
        for (unsigned int l = 0; l < n_p; ++l)
          all(n_b + k, n_b + l) = -c * M(k, l);
      return {std::move(all), std::move(load)};
    }

    /// The same in mixed form: with what is eliminated counted last, the cell
    /// has the displacements of its boundary, its pressures, and the rest.
    void
    add_mixed(Kernel                                     &kernel,
              std::vector<types::global_dof_index>        dofs,
              const std::vector<types::global_dof_index> &pressures,
              const std::vector<unsigned int>            &free,
              CondensedInteriors                         &interiors,
              MatrixScatter                              &scatter,
              PressureScatter                            &pressure_scatter)
    {
      const unsigned int n_b = kernel.system.get_first_hex_index(),
                         n_p = pressures.size();
      auto [all, load]       = mixed_cell(kernel);
      for (unsigned int i = n_b; i < dofs.size(); ++i)
        scatter.add_diagonal(dofs[i], kernel.matrix(i, i));
      if (n_b < dofs.size() && !interiors.eliminate(all, load, n_b + n_p))
        throw std::runtime_error(
          "the stiffness of a cell's interior is not positive definite");
      dofs.resize(n_b);
      scatter.add(all, load, dofs);

      PressureBlocks &blocks = kernel.blocks;
      blocks.divergence.reinit(n_p, n_b);
      blocks.compliance.reinit(n_p, n_p);
      blocks.load.reinit(n_p);
      for (unsigned int k = 0; k < n_p; ++k)
        {
          for (unsigned int i = 0; i < n_b; ++i)
            blocks.divergence(k, i) = all(n_b + k, i);
          for (unsigned int l = 0; l < n_p; ++l)
            blocks.compliance(k, l) = -all(n_b + k, n_b + l);
          blocks.load(k) = load(n_b + k);
        }
      blocks.norm = kernel.pressure->mass();
      blocks.norm *= kernel.body.material.pressure_norm();
      if (free.size() < n_b)
        {
          blocks.norm *= regular_part;
          blocks.norm.add(1.,
                          element_schur(all, blocks.divergence, free),
                          1.,
                          blocks.compliance);
        }
      pressure_scatter.add(blocks, pressures, dofs);
    }
  } // namespace

  CondensedInteriors
  assemble_elasticity(const Body                      &body,
                      const Loads                     &loads,
                      const FieldNumbering            &numbering,
                      const AffineConstraints<double> &constraints,
                      SparseMatrix                    &stiffness,
                      Vector                          &load,
                      PressureScatter                 *pressures)
  {
    std::map<unsigned int, std::unique_ptr<Kernel>> kernels;
    CondensedInteriors                              interiors;
    MatrixScatter scatter(constraints, stiffness, load);
    std::string   tangled;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          auto &kernel = kernels[cell->active_fe_index()];
          if (!kernel)
            kernel = std::make_unique<Kernel>(body, cell->get_fe());

          if (!kernel->stiffness.compute(cell, kernel->matrix))
            {
              tangled = tangled_message(body, cell);
              break;
            }
          kernel->load    = kernel->loads.compute(cell, loads);
          const auto dofs = scene_dofs(body, cell, numbering);
          if (!body.pressure)
            add_condensed(*kernel, dofs, interiors, scatter);
          else
            {
              if (!kernel->pressure)
                kernel->pressure = std::make_unique<PressureKernel>(
                  body, cell->get_fe(), body.pressure->cell(cell)->get_fe());
              kernel->pressure->compute(cell);
              add_mixed(*kernel,
                        dofs,
                        pressures->dofs(body, cell),
                        not_prescribed(constraints, dofs, cell->get_fe()),
                        interiors,
                        scatter,
                        *pressures);
            }
        }
    throw_if_any(tangled, body.triangulation().get_communicator());
    return interiors;
  }
} // namespace mortise
