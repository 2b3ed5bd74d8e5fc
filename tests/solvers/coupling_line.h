// A matrix of a coupling without a mesh, entry by entry and by node: entities
// in a line. It takes a few milliseconds.
#pragma once

#include <mortise/mortar/coupling_matrix.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

/// Rows of @p n_entities entities in a line, up to three for each component;
/// those of an entity move the nodes beside it. At both ends one component
/// lacks rows or columns, so that diagonals differ; one entity further inside
/// has other entries in one component, in two others one does not move a node
/// that its neighbours move.
struct CouplingLine
{
  int n_entities;

  int
  n_nodes() const
  {
    return 3 * n_entities + 6;
  }

  bool
  is_row(const int entity, const int i, const int component) const
  {
    if (entity == 0 && component == 1)
      return false;
    if (entity == n_entities - 1 && component == 2)
      return i > 0;
    return i <= entity % 3;
  }

  bool
  is_column(const int entity, const int node, const int component) const
  {
    return !((node < 3 || node == 5) && component == 1) &&
           !(entity == 9 && node == 31 && component == 0) &&
           !(entity == 10 && node == 34 && component == 2);
  }

  double
  value(const int entity,
        const int i,
        const int node,
        const int component) const
  {
    return std::cos(3. * entity + i + 0.7 * node) +
           (node == 3 * entity + i ? 9. : 0.) +
           (entity == 7 && component == 1 ? 0.5 : 0.);
  }

  int
  n_rows(const int entity) const
  {
    int n = 0;
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i)
        n += is_row(entity, i, c);
    return n;
  }

  /// Displacements that a row has an entry for.
  int
  n_moved() const
  {
    std::set<int> columns;
    for (int e = 0; e < n_entities; ++e)
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i)
          for (int node = 3 * e; node < 3 * e + 8; ++node)
            if (is_row(e, i, c) && is_column(e, node, c))
              columns.insert(3 * node + c);
    return columns.size();
  }

  /// Entities and nodes are dealt out in their order: those from the first on
  /// in front of the second.
  static std::pair<int, int>
  part(const int n)
  {
    using namespace dealii::Utilities::MPI;
    const int rank = this_mpi_process(MPI_COMM_WORLD),
              size = n_mpi_processes(MPI_COMM_WORLD);
    return {n * rank / size, n * (rank + 1) / size};
  }

  dealii::IndexSet
  owned_rows() const
  {
    int n = 0;
    for (auto [e, end] = part(n_entities); e < end; ++e)
      n += n_rows(e);
    return mortise::owned_range(n, MPI_COMM_WORLD);
  }

  dealii::IndexSet
  owned_nodes(const int n_components) const
  {
    const auto [first, end] = part(n_nodes());
    return mortise::owned_range(n_components * (end - first), MPI_COMM_WORLD);
  }

  /// visit(row, entity, number of the row in it for its component, component)
  template <typename Visit>
  void
  for_each_row(const Visit &visit) const
  {
    const dealii::IndexSet rows = owned_rows();
    unsigned int           next = 0;
    for (auto [e, end] = part(n_entities); e < end; ++e)
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i)
          if (is_row(e, i, c))
            visit(rows.nth_index_in_set(next++), e, i, c);
  }

  mortise::SparseMatrix
  matrix() const
  {
    std::vector<mortise::SparseMatrix::Entry> entries;
    for_each_row([&](const auto row, const int e, const int i, const int c) {
      for (unsigned int node = 3 * e; node < 3U * e + 8; ++node)
        if (is_column(e, node, c))
          entries.push_back({row, 3 * node + c, value(e, i, node, c)});
    });
    return mortise::SparseMatrix(owned_rows(),
                                 owned_nodes(3),
                                 MPI_COMM_WORLD,
                                 entries);
  }

  bool
  is_free(const int node, const int component) const
  {
    return is_column(0, node, component);
  }

  /// Has row @p i of an entity the entries of the first component?
  bool
  is_shared(const int entity, const int i, const int component) const
  {
    if (component == 0 || !is_row(entity, i, 0) ||
        !is_row(entity, 0, component))
      return false;
    for (int node = 3 * entity; node < 3 * entity + 8; ++node)
      if ((is_free(node, component) && is_free(node, 0)) &&
          (is_column(entity, node, component) != is_column(entity, node, 0) ||
           value(entity, i, node, component) != value(entity, i, node, 0)))
        return false;
    return true;
  }

  /// The same by node, its rows combined by @p frames if there are some.
  mortise::CouplingMatrix
  by_node(mortise::SparseMatrix frames = {}) const
  {
    using namespace mortise;
    SparseMatrix::CompressedRows     scalar;
    std::vector<CouplingMatrix::Row> rows;
    unsigned int                     first = 0; // row of the entity
    for_each_row([&](const auto row, const int e, const int i, const int c) {
      if (c == 0 && i == 0)
        first = row;
      const bool shared = is_shared(e, i, c);
      rows.push_back({shared ? first + i : static_cast<unsigned int>(row),
                      static_cast<unsigned int>(c)});
      for (unsigned int node = 3 * e; node < 3U * e + 8 && !shared; ++node)
        if (is_column(e, node, c) || !is_free(node, c))
          {
            scalar.columns.push_back(node);
            scalar.values.push_back(value(e, i, node, c));
          }
      scalar.begin.push_back(scalar.columns.size());
    });
    CouplingMatrix            result(SparseMatrix(owned_rows(),
                                       owned_nodes(1),
                                       MPI_COMM_WORLD,
                                       std::move(scalar),
                                       3),
                          rows,
                          std::move(frames));
    std::vector<unsigned int> constrained;
    const auto [begin, end] = part(n_nodes());
    for (int node = begin; node < end; ++node)
      for (int c = 0; c < 3; ++c)
        if (!is_free(node, c))
          constrained.push_back(3 * (node - begin) + c);
    result.constrain(constrained);
    return result;
  }
};
