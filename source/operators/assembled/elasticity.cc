#include <deal.II/lac/full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/operators/cells/cell_kernel.h>
#include <mortise/operators/assembled/elasticity.h>
#include <mortise/operators/cells/element_schur.h>
#include <mortise/operators/assembled/matrix_scatter.h>
#include <mortise/operators/cells/pressure_kernel.h>
#include <mortise/operators/assembled/pressure_scatter.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    struct Kernel
    {
      Kernel(const Body &body, const FiniteElement<dim> &system)
        : body(body)
        , system(system)
        , stiffness(body, system)
        , matrix(system.n_dofs_per_cell())
      {}

      const Body                     &body;
      const FiniteElement<dim>       &system;
      CellKernel                      stiffness;
      FullMatrix<double>              matrix;
      std::unique_ptr<PressureKernel> pressure; ///< in mixed form
      PressureBlocks                  blocks;
    };

    /// Keep the columns of the constrained ones among the first @p n_b of @p matrix.
    void
    keep_columns(const FullMatrix<double>                   &matrix,
                 const unsigned int                          n_rows,
                 const std::vector<types::global_dof_index> &dofs,
                 const AffineConstraints<double>            &constraints,
                 PrescribedColumns::Cell                    &cell)
    {
      for (unsigned int j = 0; j < dofs.size(); ++j)
        if (constraints.is_constrained(dofs[j]))
          cell.columns.push_back(j);
      cell.block.reinit(n_rows, cell.columns.size());
      for (unsigned int i = 0; i < n_rows; ++i)
        for (unsigned int j = 0; j < cell.columns.size(); ++j)
          cell.block(i, j) = matrix(i, cell.columns[j]);
    }

    /// Eliminate the interior of the cell and add the rest. Its own rows keep a
    /// diagonal of the same size and couple with nothing. Leaves the dofs of
    /// its boundary in @p dofs.
    void
    add_condensed(Kernel                               &kernel,
                  std::vector<types::global_dof_index> &dofs,
                  CondensedInteriors                   &interiors,
                  MatrixScatter                        &scatter)
    {
      const unsigned int n_b = kernel.system.get_first_hex_index();
      if (n_b < dofs.size())
        {
          for (unsigned int i = n_b; i < dofs.size(); ++i)
            scatter.add_diagonal(dofs[i], kernel.matrix(i, i));
          if (!interiors.eliminate(kernel.matrix, n_b))
            throw std::runtime_error(
              "the stiffness of a cell's interior is not positive definite");
          dofs.resize(n_b);
        }
      scatter.add(kernel.matrix, dofs);
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

    /// [K G^T; G -C] of a cell: displacements of its boundary, all pressures,
    /// displacements of its interior.
    FullMatrix<double>
    mixed_cell(const Kernel &kernel)
    {
      const unsigned int n_b      = kernel.system.get_first_hex_index(),
                         n_u      = kernel.matrix.m(),
                         n_p      = kernel.pressure->mass().m();
      const FullMatrix<double> &G = kernel.pressure->divergence(),
                               &M = kernel.pressure->mass();
      const double c              = kernel.body.material.compressibility();
      const auto   index          = [&](const unsigned int i) {
        return i < n_b ? i : i + n_p;
      };
      FullMatrix<double> all(n_u + n_p);
      for (unsigned int i = 0; i < n_u; ++i)
        {
          for (unsigned int j = 0; j < n_u; ++j)
            all(index(i), index(j)) = kernel.matrix(i, j);
          for (unsigned int k = 0; k < n_p; ++k)
            all(index(i), n_b + k) = all(n_b + k, index(i)) = G(k, i);
        }
      for (unsigned int k = 0; k < n_p; ++k)
        for (unsigned int l = 0; l < n_p; ++l)
          all(n_b + k, n_b + l) = -c * M(k, l);
      return all;
    }

    /// The same in mixed form: with what is eliminated counted last, the cell
    /// has the displacements of its boundary, its pressures, and the rest. Returns
    /// its matrix and leaves the dofs of its boundary in @p dofs.
    FullMatrix<double>
    add_mixed(Kernel                                     &kernel,
              std::vector<types::global_dof_index>       &dofs,
              const std::vector<types::global_dof_index> &pressures,
              const std::vector<unsigned int>            &free,
              CondensedInteriors                         &interiors,
              MatrixScatter                              &scatter,
              PressureScatter                            &pressure_scatter)
    {
      const unsigned int n_b = kernel.system.get_first_hex_index(),
                         n_p = pressures.size();
      FullMatrix<double> all = mixed_cell(kernel);
      for (unsigned int i = n_b; i < dofs.size(); ++i)
        scatter.add_diagonal(dofs[i], kernel.matrix(i, i));
      if (n_b < dofs.size() && !interiors.eliminate(all, n_b + n_p))
        throw std::runtime_error(
          "the stiffness of a cell's interior is not positive definite");
      dofs.resize(n_b);
      scatter.add(all, dofs);

      PressureBlocks &blocks = kernel.blocks;
      blocks.divergence.reinit(n_p, n_b);
      blocks.compliance.reinit(n_p, n_p);
      for (unsigned int k = 0; k < n_p; ++k)
        {
          for (unsigned int i = 0; i < n_b; ++i)
            blocks.divergence(k, i) = all(n_b + k, i);
          for (unsigned int l = 0; l < n_p; ++l)
            blocks.compliance(k, l) = -all(n_b + k, n_b + l);
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
      return all;
    }
  } // namespace

  AssembledBody
  assemble_elasticity(const Body                      &body,
                      const FieldNumbering            &numbering,
                      const AffineConstraints<double> &constraints,
                      const LoadKinds                 &kinds,
                      SparseMatrix                    &stiffness,
                      PressureScatter                 *pressures)
  {
    std::map<unsigned int, std::unique_ptr<Kernel>> kernels;
    AssembledBody assembled{CondensedInteriors(kinds.body_force), {}};
    MatrixScatter scatter(constraints, stiffness);
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
          auto       dofs = scene_dofs(body.index, cell, numbering);
          const bool keep =
            kinds.prescribed &&
            std::any_of(dofs.begin(), dofs.end(), [&](const auto dof) {
              return constraints.is_constrained(dof);
            });
          auto *columns =
            keep ? &assembled.prescribed.cells[cell->active_cell_index()] :
                   nullptr;
          if (!body.pressure)
            {
              add_condensed(*kernel, dofs, assembled.interiors, scatter);
              if (keep)
                keep_columns(
                  kernel->matrix, dofs.size(), dofs, constraints, *columns);
              continue;
            }
          if (!kernel->pressure)
            kernel->pressure = std::make_unique<PressureKernel>(
              body, cell->get_fe(), body.pressure->cell(cell)->get_fe());
          kernel->pressure->compute(cell);
          const auto of_cell = pressures->dofs(body, cell);
          const auto matrix =
            add_mixed(*kernel,
                      dofs,
                      of_cell,
                      not_prescribed(constraints, dofs, cell->get_fe()),
                      assembled.interiors,
                      scatter,
                      *pressures);
          if (keep)
            keep_columns(matrix,
                         dofs.size() + of_cell.size(),
                         dofs,
                         constraints,
                         *columns);
        }
    throw_if_any(tangled, body.triangulation().get_communicator());
    return assembled;
  }
} // namespace mortise
