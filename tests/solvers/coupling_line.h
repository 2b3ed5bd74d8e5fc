// A matrix of a coupling without a mesh: entities in a line. It never needs
// more than a few milliseconds.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>

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
};
