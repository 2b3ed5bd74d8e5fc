// The multipliers as values at the nodes of slave faces,
// MultiplierSpace::number().
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/multiplier_space.h>
#include <mortise/mortar/nodal_block.h>

#include <algorithm>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index        = MultiplierSpace::Index;
    using Dofs         = std::vector<Index>;
    using ByDof        = LinearAlgebra::distributed::Vector<double>;
    using Combination  = std::vector<std::pair<Index, double>>; ///< of dofs
    using Combinations = std::vector<Combination>;

    /// to += factor * other
    void
    add(Combination &to, const double factor, const Combination &other)
    {
      for (const auto &[dof, weight] : other)
        {
          const auto found =
            std::find_if(to.begin(), to.end(), [dof = dof](const auto &entry) {
              return entry.first == dof;
            });
          if (found == to.end())
            to.emplace_back(dof, factor * weight);
          else
            found->second += factor * weight;
        }
    }

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

      void
      add(const TraceBasis &basis, const Dofs &dofs)
      {
        for (const auto &entity : edges_and_inside(basis))
          if (std::any_of(entity.begin(), entity.end(), [&](const auto k) {
                return reduction.is_constrained(dofs[k]);
              }))
            for (const unsigned int k : entity)
              mark(dofs[k]);
        for (unsigned int v = 0; v < basis.n_vertices(); ++v)
          if (const auto dof = dofs[basis.vertex_function(v)];
              reduction.is_constrained(dof))
            mark(dof);
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
  } // namespace

  std::vector<MultiplierSpace::FaceRows>
  MultiplierSpace::make_rows(const BodySurface &slave, const Index first) const
  {
    ByDof numbers(body.dof_handler.locally_owned_dofs(),
                  reduction.get_local_lines(),
                  body.triangulation().get_communicator());
    auto  ones = numbers; // coefficients of the constant one
    for (unsigned int i = 0; i < owned_dofs.size(); ++i)
      {
        numbers(owned_dofs[i]) = first + i;
        ones(owned_dofs[i])    = at_vertices[i] ? 1. : 0.;
      }
    HierarchicalMultipliers hierarchical(reduction, numbers);
    numbers.update_ghost_values();
    ones.update_ghost_values();
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      {
        const auto dofs = face_dofs(slave.cells[s], slave.face_numbers[s]);
        for (unsigned int c = 0; c < n_directions; ++c)
          hierarchical.add(slave.traces[s].basis(), dofs[c]);
      }
    hierarchical.exchange();

    std::vector<FaceRows> result;
    for (unsigned int s = 0; s < slave.faces.size(); ++s)
      {
        FaceRows          rows;
        const TraceBasis &basis = slave.traces[s].basis();
        const auto dofs = face_dofs(slave.cells[s], slave.face_numbers[s]);
        rows.begin      = {0};
        if (n_directions != dim)
          rows.normals = normals[s];
        for (unsigned int c = 0; c < n_directions; ++c)
          {
            rows.hold_constants[c] = true;
            const auto values =
              values_at_nodes(basis, dofs[c], reduction, hierarchical);
            for (unsigned int k = 0; k < values.size(); ++k)
              {
                double sum = 0.;
                for (const auto &[dof, weight] : values[k])
                  {
                    rows.index.push_back(static_cast<Index>(numbers(dof)));
                    rows.weight.push_back(weight);
                    sum += weight * ones(dof);
                  }
                rows.begin.push_back(rows.index.size());
                if (hierarchical.is_one(dofs[c][k]))
                  rows.hierarchical.emplace_back(c * values.size() + k,
                                                 static_cast<Index>(
                                                   numbers(dofs[c][k])));
                if (basis.functions[k].dimension == 0)
                  rows.hold_constants[c] &= std::fabs(sum - 1.) < 1e-10;
              }
          }
        result.push_back(std::move(rows));
      }
    return result;
  }

  void
  MultiplierSpace::number(const BodySurface &slave, const Index first)
  {
    face_rows    = make_rows(slave, first);
    first_number = first;
  }
} // namespace mortise
