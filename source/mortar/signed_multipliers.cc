// See signed_multipliers.h.
#include "signed_multipliers.h"

#include <deal.II/lac/full_matrix.h>

#include <mortise/mortar/nodal_block.h>

#include <cmath>
#include <utility>

#include "bernstein.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Combinations = std::vector<Combination>;

    /// How far a node is from the first to the second end of edge @p e.
    double
    along_edge(const TraceBasis  &basis,
               const unsigned int e,
               const Point<2>    &node)
    {
      const auto         ends = basis.edge_vertices(e);
      const Point<2>     from(ends[0] % 2, ends[0] / 2);
      const Tensor<1, 2> edge = Point<2>(ends[1] % 2, ends[1] / 2) - from;
      return (node - from) * edge / edge.norm_square();
    }

    /// Those of the modes of edge @p e from 2 on, in this order.
    std::vector<unsigned int>
    functions_of_edge(const TraceBasis &basis, const unsigned int e)
    {
      std::vector<unsigned int> result;
      for (unsigned int mode = 2; mode <= basis.degree; ++mode)
        for (unsigned int k = 0; k < basis.size(); ++k)
          if (const auto &f = basis.functions[k];
              f.dimension == 1 && f.entity == e && f.degree == mode)
            result.push_back(k);
      return result;
    }

    std::vector<unsigned int>
    functions_inside(const TraceBasis &basis)
    {
      std::vector<unsigned int> result;
      for (unsigned int k = 0; k < basis.size(); ++k)
        if (basis.functions[k].dimension == 2)
          result.push_back(k);
      return result;
    }
  } // namespace

  SignedMultipliers::SignedMultipliers(
    const AffineConstraints<double> &reduction,
    const Choice                    &has_coefficients)
    : reduction(reduction)
    , has_coefficients(has_coefficients)
  {}

  /// The one that takes the place of @p dof, which is itself unless degrees
  /// meet; none where it is dropped or hangs.
  std::optional<SignedMultipliers::Index>
  SignedMultipliers::multiplier_at(const Index dof) const
  {
    if (!reduction.is_constrained(dof))
      return dof;
    const auto &entries = *reduction.get_constraint_entries(dof);
    if (entries.size() == 1 && entries[0].second == 1.)
      return entries[0].first;
    return {};
  }

  std::optional<SignedMultipliers::Edge>
  SignedMultipliers::own_edge(const TraceBasis  &basis,
                              const Dofs        &dofs,
                              const unsigned int e) const
  {
    const auto functions = functions_of_edge(basis, e);
    if (!has_coefficients(functions, dofs))
      return {};
    Edge edge;
    for (const unsigned int k : functions)
      if (const auto multiplier = multiplier_at(dofs[k]))
        edge.multipliers.push_back(*multiplier);
      else if (!reduction.get_constraint_entries(dofs[k])->empty())
        return {};
    const auto ends = basis.edge_vertices(e);
    for (unsigned int i = 0; i < 2; ++i)
      edge.ends[i] = dofs[basis.vertex_function(ends[i])];
    return edge;
  }

  void
  SignedMultipliers::add_face(const TraceBasis &basis, const Dofs &dofs)
  {
    for (unsigned int e = 0; e < basis.n_edges(); ++e)
      if (const auto edge = own_edge(basis, dofs, e))
        for (unsigned int k = 0; k < edge->multipliers.size(); ++k)
          modes.emplace(edge->multipliers[k], std::make_pair(*edge, k));
  }

  /// What the coefficient of a hierarchical function is.
  Combination
  SignedMultipliers::expand(const Index dof) const
  {
    Combination result;
    if (reduction.is_constrained(dof))
      for (const auto &[other, weight] : *reduction.get_constraint_entries(dof))
        add(result, weight, expand(other));
    else if (const auto found = modes.find(dof); found != modes.end())
      {
        const auto &[edge, multi_index] = found->second;
        const Combinations of_edge      = coefficients(edge);
        for (unsigned int j = 0; j < of_edge.size(); ++j)
          add(result,
              line_transform(of_edge.size() - 1).to_modes(multi_index + 2, j),
              of_edge[j]);
      }
    else
      result = {{dof, 1.}};
    return result;
  }

  std::vector<Combination>
  SignedMultipliers::coefficients(const Edge &edge) const
  {
    Combinations result = {expand(edge.ends[0])};
    for (const Index multiplier : edge.multipliers)
      result.push_back({{multiplier, 1.}});
    result.push_back(expand(edge.ends[1]));
    return result;
  }

  std::vector<Combination>
  SignedMultipliers::coefficients(const TraceBasis  &basis,
                                  const Dofs        &dofs,
                                  const unsigned int e) const
  {
    if (const auto edge = own_edge(basis, dofs, e))
      return coefficients(*edge);
    Combinations hierarchical;
    for (const unsigned int v : basis.edge_vertices(e))
      hierarchical.push_back(expand(dofs[basis.vertex_function(v)]));
    for (const unsigned int k : functions_of_edge(basis, e))
      hierarchical.push_back(expand(dofs[k]));
    while (hierarchical.size() > 2 && hierarchical.back().empty())
      hierarchical.pop_back();
    const unsigned int n = hierarchical.size();
    Combinations       result(n);
    for (unsigned int j = 0; j < n; ++j)
      {
        for (unsigned int m = 0; m < n; ++m)
          add(result[j],
              line_transform(n - 1).to_bernstein(j, m),
              hierarchical[m]);
        // a subdivision has no negative weights but by rounding
        const auto is_rounding = [](const auto &entry) {
          return std::fabs(entry.second) < 1e-11;
        };
        result[j].erase(std::remove_if(result[j].begin(),
                                       result[j].end(),
                                       is_rounding),
                        result[j].end());
      }
    return result;
  }

  SignedMultipliers::Coefficients
  SignedMultipliers::coefficients(const TraceBasis &basis,
                                  const Dofs       &dofs) const
  {
    const bool   is_triangle = basis.shape == FaceShape::triangle;
    Coefficients result{{{1, 1}}, {}, {}};
    const auto   raise = [&](const unsigned int a, const unsigned int degree) {
      for (unsigned int b = 0; b < 2; ++b)
        if (is_triangle || a == b)
          result.degree[b] = std::max(result.degree[b], degree);
    };
    std::vector<Combinations> edges;
    for (unsigned int e = 0; e < basis.n_edges(); ++e)
      {
        edges.push_back(coefficients(basis, dofs, e));
        raise(e / 2, edges[e].size() - 1);
      }
    std::vector<unsigned int> inside; // functions
    for (const unsigned int k : functions_inside(basis))
      if (multiplier_at(dofs[k]))
        {
          const auto &f = basis.functions[k];
          inside.push_back(k);
          raise(0, is_triangle ? f.degree : f.modes[0]);
          raise(1, is_triangle ? f.degree : f.modes[1]);
        }

    const BernsteinLattice lattice(basis.shape, result.degree);
    result.all.resize(lattice.multi_indices.size());
    for (unsigned int e = 0; e < basis.n_edges(); ++e)
      {
        const unsigned int degree = result.degree[is_triangle ? 0 : e / 2];
        elevate(edges[e], degree);
        for (unsigned int k = 0; k <= degree; ++k)
          result.all[lattice.on_edge(basis, e, k)] = edges[e][k];
      }
    auto next = inside.begin();
    for (unsigned int i = 0; i < lattice.multi_indices.size(); ++i)
      if (const auto &multi_index = lattice.multi_indices[i];
          lattice.is_inside(multi_index))
        {
          const auto has_place = [&](const unsigned int k) {
            const auto &modes = basis.functions[k].modes;
            return modes[0] == multi_index[0] + 1 &&
                   modes[1] == multi_index[1] + 1;
          };
          const auto found =
            is_triangle ? next :
                          std::find_if(inside.begin(), inside.end(), has_place);
          if (found == inside.end())
            result.all[i] = lattice.mean_of_ruled(multi_index, result.all);
          else
            {
              result.inside.emplace_back(i, *multiplier_at(dofs[*found]));
              result.all[i] = {{result.inside.back().second, 1.}};
              next += is_triangle ? 1 : 0;
            }
        }
    return result;
  }

  std::vector<Combination>
  SignedMultipliers::values_at_nodes(const TraceBasis &basis,
                                     const Dofs       &dofs) const
  {
    constexpr double rounding = 1e-14;
    Combinations     result(basis.size());
    const auto       nodes = face_nodes(basis.shape, basis.degree);
    for (unsigned int v = 0; v < basis.n_vertices(); ++v)
      result[basis.vertex_function(v)] = expand(dofs[basis.vertex_function(v)]);
    for (unsigned int e = 0; e < basis.n_edges(); ++e)
      {
        const auto edge = functions_of_edge(basis, e);
        if (edge.empty())
          continue;
        if (!has_coefficients(edge, dofs))
          {
            for (const unsigned int k : edge)
              result[k] = {{dofs[k], 1.}};
            continue;
          }
        const Combinations all = coefficients(basis, dofs, e);
        for (const unsigned int k : edge)
          {
            const double t = along_edge(basis, e, nodes[k]);
            for (unsigned int j = 0; j < all.size(); ++j)
              add(result[k],
                  binomial_term(all.size() - 1, j, t, 1. - t),
                  all[j]);
          }
      }
    const auto inside = functions_inside(basis);
    if (inside.empty())
      return result;
    if (!has_coefficients(inside, dofs))
      {
        for (const unsigned int k : inside)
          result[k] = {{dofs[k], 1.}};
        return result;
      }
    const Coefficients       of_face = coefficients(basis, dofs);
    const FullMatrix<double> values =
      BernsteinLattice(basis.shape, of_face.degree).at_nodes(basis);
    for (const unsigned int k : inside)
      for (unsigned int i = 0; i < values.n(); ++i)
        if (values(k, i) > rounding)
          add(result[k], values(k, i), of_face.all[i]);
    return result;
  }

  std::vector<std::pair<SignedMultipliers::Index, std::vector<double>>>
  SignedMultipliers::from_values(const TraceBasis &basis,
                                 const Dofs       &dofs) const
  {
    std::vector<std::pair<Index, std::vector<double>>> result;
    const FullMatrix<double>                          &functions =
      face_nodal_basis(basis.shape, basis.degree).functions;
    for (unsigned int e = 0; e < basis.n_edges(); ++e)
      if (const auto edge = own_edge(basis, dofs, e))
        {
          std::vector<unsigned int> rows;
          for (const unsigned int v : basis.edge_vertices(e))
            rows.push_back(basis.vertex_function(v));
          for (const unsigned int k : functions_of_edge(basis, e))
            rows.push_back(k);
          const unsigned int n = edge->multipliers.size() + 2;
          for (unsigned int j = 1; j + 1 < n; ++j)
            {
              std::vector<double> weights(basis.size());
              for (unsigned int m = 0; m < n; ++m)
                for (unsigned int k = 0; k < basis.size(); ++k)
                  weights[k] += line_transform(n - 1).to_bernstein(j, m) *
                                functions(rows[m], k);
              result.emplace_back(edge->multipliers[j - 1], weights);
            }
        }
    const auto inside = functions_inside(basis);
    if (inside.empty() || !has_coefficients(inside, dofs))
      return result;
    const Coefficients of_face = coefficients(basis, dofs);
    if (of_face.inside.empty())
      return result;
    const FullMatrix<double> values =
      BernsteinLattice(basis.shape, of_face.degree).at_nodes(basis);
    FullMatrix<double> coefficients(values.n(), values.m());
    coefficients.left_invert(values);
    for (const auto &[multi_index, multiplier] : of_face.inside)
      result.emplace_back(multiplier,
                          std::vector<double>(&coefficients(multi_index, 0),
                                              &coefficients(multi_index, 0) +
                                                basis.size()));
    return result;
  }
} // namespace mortise
