// A matrix of a coupling without a mesh, entry by entry and by node: entities
// in a line. It never needs more than a few milliseconds.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <mortise/mortar/coupling_matrix.h>

#include <cmath>
#include <set>

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

  /// Entities are dealt out in their order.
  Epetra_CrsMatrix
  matrix() const
  {
    const Epetra_MpiComm comm(MPI_COMM_WORLD);
    const Epetra_Map     entities(n_entities, 0, comm);
    int                  n = 0;
    for (int e = 0; e < entities.NumMyElements(); ++e)
      n += n_rows(entities.GID(e));
    const Epetra_Map rows(-1, n, 0, comm), nodes(n_nodes(), 0, comm),
      columns(-1, 3 * nodes.NumMyElements(), 0, comm);
    Epetra_CrsMatrix result(Copy, rows, 0);
    int              row = rows.MinMyGID();
    for (int k = 0; k < entities.NumMyElements(); ++k)
      for (int c = 0; c < 3; ++c)
        for (int e = entities.GID(k), i = 0; i < 3; ++i)
          if (is_row(e, i, c))
            {
              for (int node = 3 * e; node < 3 * e + 8; ++node)
                if (is_column(e, node, c))
                  {
                    const double entry  = value(e, i, node, c);
                    const int    column = 3 * node + c;
                    result.InsertGlobalValues(row, 1, &entry, &column);
                  }
              ++row;
            }
    result.FillComplete(columns, rows);
    return result;
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

  /// The same by node.
  mortise::CouplingMatrix
  by_node() const
  {
    using mortise::CouplingMatrix;
    const Epetra_CrsMatrix           B = matrix();
    const Epetra_Map                 nodes(n_nodes(), 0, B.Comm());
    Epetra_CrsMatrix                 scalar(Copy, B.RowMap(), 0);
    std::vector<CouplingMatrix::Row> rows;
    const Epetra_Map                 entities(n_entities, 0, B.Comm());
    int                              row = B.RowMap().MinMyGID();
    for (int k = 0; k < entities.NumMyElements(); ++k)
      for (int c = 0, e = entities.GID(k), first = row; c < 3; ++c)
        for (int i = 0; i < 3; ++i)
          if (is_row(e, i, c))
            {
              const bool shared = is_shared(e, i, c);
              rows.push_back({static_cast<unsigned>(shared ? first + i : row),
                              static_cast<unsigned>(c)});
              for (int node = 3 * e; node < 3 * e + 8 && !shared; ++node)
                if (is_column(e, node, c) || !is_free(node, c))
                  {
                    const double entry = value(e, i, node, c);
                    scalar.InsertGlobalValues(row, 1, &entry, &node);
                  }
              ++row;
            }
    scalar.FillComplete(nodes, B.RowMap());
    mortise::SparseMatrix entries, frames;
    entries.reinit(scalar);
    CouplingMatrix result(std::move(entries), rows, std::move(frames));
    std::vector<unsigned int> constrained;
    for (int k = 0; k < nodes.NumMyElements(); ++k)
      for (int c = 0; c < 3; ++c)
        if (!is_free(nodes.GID(k), c))
          constrained.push_back(3 * k + c);
    result.constrain(constrained);
    return result;
  }
};
