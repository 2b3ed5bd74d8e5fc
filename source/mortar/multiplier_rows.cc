// The multipliers as values at the nodes of slave faces,
// MultiplierSpace::number().
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/body/elements/cell_face.h>
#include <mortise/mortar/multiplier_space.h>
#include <mortise/mortar/nodal_block.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shared_entries.h"
#include "signed_multipliers.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index        = MultiplierSpace::Index;
    using Dofs         = std::vector<Index>;
    using ByDof        = LinearAlgebra::distributed::Vector<double>;
    using Combinations = std::vector<Combination>;

    /// The functions of each edge, then those inside.
    std::vector<std::vector<unsigned int>>
    edges_and_inside(const TraceBasis &basis)
    {
      std::vector<std::vector<unsigned int>> entities(basis.n_edges() + 1);
      for (unsigned int k = 0; k < basis.size(); ++k)
        if (const auto &f = basis.functions[k]; f.dimension > 0)
          entities[f.dimension == 1 ? f.entity : basis.n_edges()].push_back(k);
      return entities;
    }

    /// Which multipliers are coefficients of hierarchical functions, above 0.5.
    /// All others are values at nodes: those of vertices, where both are the
    /// same, and those of edges and insides that have one for each of their
    /// nodes, on all faces around them, and on which nothing hangs.
    class HierarchicalMultipliers
    {
    public:
      HierarchicalMultipliers(const AffineConstraints<double> &reduction,
                              const ByDof                     &layout)
        : reduction(reduction)
        , flags(layout)
      {
        flags = 0.;
      }

      /// @p together: have all directions the same functions? Where
      /// @p one_sided, values at the nodes of a face have the sign of
      /// the pressure only where multipliers are dual and none is missing
      /// inside.
      void
      add(const TraceBasis        &basis,
          const std::vector<Dofs> &by_direction,
          const bool               together,
          const bool               one_sided,
          const bool               is_dual)
      {
        const auto entities      = edges_and_inside(basis);
        const auto is_incomplete = [&](const auto &entity, const Dofs &dofs) {
          return std::any_of(entity.begin(), entity.end(), [&](const auto k) {
            return reduction.is_constrained(dofs[k]);
          });
        };
        for (const Dofs &dofs : by_direction)
          {
            const auto lacks_some = [&](const auto &entity) {
              return together ?
                       std::any_of(by_direction.begin(),
                                   by_direction.end(),
                                   [&](const Dofs &other) {
                                     return is_incomplete(entity, other);
                                   }) :
                       is_incomplete(entity, dofs);
            };
            const bool all =
              one_sided && (!is_dual || lacks_some(entities.back()));
            for (const auto &entity : entities)
              if (all || lacks_some(entity))
                for (const unsigned int k : entity)
                  mark(dofs[k]);
            for (unsigned int v = 0; v < basis.n_vertices(); ++v)
              if (const auto dof = dofs[basis.vertex_function(v)];
                  reduction.is_constrained(dof))
                mark(dof);
          }
      }

      /// Behind the last add(). Collective.
      void
      exchange()
      {
        flags.compress(VectorOperation::add);
        flags.update_ghost_values();
      }

      /// Is one of those of this edge or inside hierarchical, or none?
      bool
      operator()(const std::vector<unsigned int> &entity,
                 const Dofs                      &dofs) const
      {
        return std::any_of(entity.begin(), entity.end(), [&](const auto k) {
          return reduction.is_constrained(dofs[k]) || flags(dofs[k]) > 0.5;
        });
      }

      /// Is there a hierarchical multiplier at @p dof?
      bool
      is_one(const Index dof) const
      {
        return !reduction.is_constrained(dof) && flags(dof) > 0.5;
      }

    private:
      void
      mark(const Index dof)
      {
        if (!reduction.is_constrained(dof))
          flags(dof) += 1.;
        else
          for (const auto &entry : *reduction.get_constraint_entries(dof))
            flags(entry.first) += 1.;
      }

      const AffineConstraints<double> &reduction;
      ByDof                            flags;
    };

    /// The values at the nodes of a face in multipliers.
    Combinations
    values_at_nodes(const TraceBasis                &basis,
                    const Dofs                      &dofs,
                    const AffineConstraints<double> &reduction,
                    const HierarchicalMultipliers   &hierarchical)
    {
      const FaceNodalBasis &nodal = face_nodal_basis(basis.shape, basis.degree);
      const auto coefficient      = [&](const unsigned int k) -> Combination {
        if (!reduction.is_constrained(dofs[k]))
          return {{dofs[k], 1.}};
        return *reduction.get_constraint_entries(dofs[k]);
      };
      // coefficients of the hierarchical functions and values at nodes
      Combinations coefficients(basis.size()), values(basis.size());
      for (unsigned int v = 0; v < basis.n_vertices(); ++v)
        {
          const unsigned int k = basis.vertex_function(v);
          coefficients[k] = values[k] = coefficient(k);
        }
      const auto add_products = [&](const FullMatrix<double>        &matrix,
                                    const std::vector<unsigned int> &rows,
                                    const unsigned int  up_to_dimension,
                                    const Combinations &from,
                                    Combinations       &to) {
        constexpr double rounding = 1e-14;
        for (const unsigned int i : rows)
          for (unsigned int k = 0; k < basis.size(); ++k)
            if (basis.functions[k].dimension <= up_to_dimension &&
                std::fabs(matrix(i, k)) > rounding)
              add(to[i], matrix(i, k), from[k]);
      };
      for (const auto &entity : edges_and_inside(basis))
        {
          if (entity.empty())
            continue;
          const unsigned int d = basis.functions[entity[0]].dimension;
          if (hierarchical(entity, dofs))
            {
              for (const unsigned int k : entity)
                coefficients[k] = coefficient(k);
              add_products(nodal.values, entity, d, coefficients, values);
            }
          else
            {
              for (const unsigned int k : entity)
                values[k] = {{dofs[k], 1.}};
              add_products(nodal.functions, entity, d, values, coefficients);
            }
        }
      return values;
    }

    /// Multipliers by their dofs, in which the values at the nodes of a face
    /// are expanded.
    class RowsInDofs
    {
    public:
      /// @p with_signs: null where multipliers need none.
      RowsInDofs(const ByDof                     &ones,
                 const AffineConstraints<double> &reduction,
                 const HierarchicalMultipliers   &hierarchical,
                 const SignedMultipliers         *with_signs)
        : ones(ones)
        , reduction(reduction)
        , hierarchical(hierarchical)
        , with_signs(with_signs)
      {}

      /// @p dofs: by direction.
      MultiplierSpace::FaceMultipliers
      operator()(const TraceBasis &basis, const std::vector<Dofs> &dofs) const
      {
        MultiplierSpace::FaceMultipliers rows;
        rows.begin = {0};
        for (unsigned int c = 0; c < dofs.size(); ++c)
          {
            const auto values =
              with_signs ?
                with_signs->values_at_nodes(basis, dofs[c]) :
                values_at_nodes(basis, dofs[c], reduction, hierarchical);
            rows.reproduce_constants[c] = true;
            for (unsigned int k = 0; k < values.size(); ++k)
              {
                double sum = 0.;
                for (const auto &[dof, weight] : values[k])
                  {
                    rows.index.push_back(dof);
                    rows.weight.push_back(weight);
                    sum += weight * ones(dof);
                  }
                rows.begin.push_back(rows.index.size());
                if (basis.functions[k].dimension == 0)
                  rows.reproduce_constants[c] &= std::fabs(sum - 1.) < 1e-10;
              }
            for (auto &[dof, of_values] : coefficients(basis, dofs[c]))
              rows.coefficients.push_back({dof, c, std::move(of_values)});
          }
        return rows;
      }

    private:
      /// Multipliers that are no value at a node, and what gives them from all
      /// of these.
      std::vector<std::pair<Index, std::vector<double>>>
      coefficients(const TraceBasis &basis, const Dofs &dofs) const
      {
        if (with_signs)
          return with_signs->from_values(basis, dofs);
        std::vector<std::pair<Index, std::vector<double>>> result;
        const FullMatrix<double>                          &functions =
          face_nodal_basis(basis.shape, basis.degree).functions;
        for (unsigned int k = 0; k < basis.size(); ++k)
          if (hierarchical.is_one(dofs[k]))
            result.emplace_back(dofs[k],
                                std::vector<double>(&functions(k, 0),
                                                    &functions(k, 0) +
                                                      basis.size()));
        return result;
      }

      const ByDof                     &ones;
      const AffineConstraints<double> &reduction;
      const HierarchicalMultipliers   &hierarchical;
      const SignedMultipliers         *with_signs;
    };

    /// Dofs become multipliers. @p numbers: by dof, from one on, less than zero where another
    /// multiplier has the same entries.
    void
    to_numbers(const ByDof &numbers, MultiplierSpace::FaceMultipliers &rows)
    {
      const auto number = [&](const Index dof) {
        return static_cast<Index>(std::fabs(numbers(dof))) - 1;
      };
      for (Index &index : rows.index)
        {
          rows.is_represented.push_back(numbers(index) < 0.);
          index = number(index);
        }
      for (auto &coefficient : rows.coefficients)
        coefficient.index = number(coefficient.index);
    }
  } // namespace

  MultiplierSpace::Rows
  MultiplierSpace::make_rows(const BodySurface &slave, const Index first) const
  {
    ByDof numbers(body.dof_handler.locally_owned_dofs(),
                  reduction.get_local_lines(),
                  body.triangulation().get_communicator());
    auto  ones = numbers; // coefficients of the constant one
    for (unsigned int i = 0; i < owned_dofs.size(); ++i)
      ones(owned_dofs[i]) = at_vertices[i] ? 1. : 0.;
    ones.update_ghost_values();
    HierarchicalMultipliers hierarchical(reduction, numbers);
    SharedEntries           shared(owned_dofs, nodes_and_components, numbers);
    std::vector<std::array<Dofs, dim>> dofs;
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      {
        dofs.push_back(face_dofs(slave.cells[s], slave.face_numbers[s]));
        hierarchical.add(slave.traces[s].basis(),
                         {dofs[s].begin(), dofs[s].begin() + n_directions},
                         together[s],
                         one_sided,
                         has_dual[s]);
      }
    hierarchical.exchange();
    const SignedMultipliers::Choice has_coefficients =
      [&](const auto &functions, const auto &of_face) {
        return hierarchical(functions, of_face);
      };
    SignedMultipliers with_signs(reduction, has_coefficients);
    if (one_sided)
      {
        for (const auto &[cell, f] : slave.known)
          for (unsigned int c = 0; c < n_directions; ++c)
            with_signs.add_face(*CellFace(cell, f).basis,
                                face_dofs(cell, f)[c]);
        ones = 1.;
        ones.update_ghost_values();
      }
    const RowsInDofs rows_in_dofs(ones,
                                  reduction,
                                  hierarchical,
                                  one_sided ? &with_signs : nullptr);

    Rows result;
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      {
        result.by_face.push_back(
          rows_in_dofs(slave.traces[s].basis(),
                       {dofs[s].begin(), dofs[s].begin() + n_directions}));
        FaceMultipliers &rows = result.by_face.back();
        rows.frames           = frames[s];
        if (n_directions == dim)
          shared.compare(rows);
        else
          {
            rows.reproduce_constants.fill(rows.reproduce_constants[0]);
            rows.along_normals = along_normals[s];
          }
      }
    shared.exchange();
    result.owned = shared.rows(first);

    for (unsigned int i = 0; i < owned_dofs.size(); ++i)
      numbers(owned_dofs[i]) =
        (result.owned[i].entries == first + i ? 1. : -1.) * (1. + first + i);
    numbers.update_ghost_values();
    for (FaceMultipliers &rows : result.by_face)
      to_numbers(numbers, rows);
    return result;
  }

  void
  MultiplierSpace::number(const BodySurface &slave,
                          const Index        first,
                          const unsigned int first_owned)
  {
    numbered     = make_rows(slave, first);
    first_number = first;
    owned_range  = {first_owned, n_owned()};
  }
} // namespace mortise
