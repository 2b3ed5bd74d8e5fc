// The columns of the constraint on one side of an interface, as its assembly
// takes them: by_node, whether they are nodes or displacements; component(c),
// the functions of the face in them; in_columns(), a local matrix for these
// functions.
#pragma once

#include <mortise/mortar/nodal_block.h>

#include "coupled_faces.h"

namespace mortise
{
  /// The columns of one side of the constraint: hierarchical functions.
  struct HierarchicalColumns
  {
    static constexpr bool by_node = false;

    const FaceTrace &trace;

    Expansion
    component(const unsigned int c) const
    {
      return mortise::component(trace, c);
    }

    const dealii::FullMatrix<double> &
    in_columns(const dealii::FullMatrix<double> &local) const
    {
      return local;
    }
  };

  /// Nodes, some component of which may be free; where some of the face hang,
  /// those that they hang on.
  class NodalColumns
  {
  public:
    static constexpr bool by_node = true;

    explicit NodalColumns(const FaceTrace &trace)
      : trace(trace)
      , begin(1)
    {
      const FaceNodes   &face = trace.nodes[0];
      const unsigned int n    = trace.n_functions();
      for (unsigned int k = 0; k < n; ++k)
        {
          if (face.hang())
            for (unsigned int e = face.begin[k]; e < face.begin[k + 1]; ++e)
              add(face.nodes[face.column[e]], face.weight[e]);
          else
            {
              // what holds a mode holds the node in its place
              bool is_free = false;
              for (unsigned int row = k; row < dim * n; row += n)
                is_free |= trace.begin[row + 1] > trace.begin[row];
              if (is_free)
                add(face.nodes[k], 1.);
            }
          begin.push_back(index.size());
        }
    }

    Expansion
    component(const unsigned int) const
    {
      return {begin, index, weight, 0};
    }

    dealii::FullMatrix<double>
    in_columns(const dealii::FullMatrix<double> &local) const
    {
      return nodal_block(local,
                         {trace.shape, trace.degree, 0},
                         {trace.shape, trace.degree, trace.degree});
    }

  private:
    void
    add(const dealii::types::global_dof_index node, const double factor)
    {
      index.push_back(node);
      weight.push_back(factor);
    }

    const FaceTrace                             &trace;
    std::vector<unsigned int>                    begin;
    std::vector<dealii::types::global_dof_index> index;
    std::vector<double>                          weight;
  };

  /// The prescribed displacements of one side.
  class PrescribedTrace
  {
  public:
    static constexpr bool by_node = false;

    explicit PrescribedTrace(const FaceTrace &trace)
      : n_functions(trace.n_functions())
      , begin(1)
    {
      for (const dealii::types::global_dof_index dof : trace.prescribed)
        {
          if (dof != dealii::numbers::invalid_dof_index)
            index.push_back(dof);
          begin.push_back(index.size());
        }
      weight.assign(index.size(), 1.);
    }

    Expansion
    component(const unsigned int c) const
    {
      return {begin, index, weight, c * n_functions};
    }

    const dealii::FullMatrix<double> &
    in_columns(const dealii::FullMatrix<double> &local) const
    {
      return local;
    }

  private:
    unsigned int                                 n_functions;
    std::vector<unsigned int>                    begin;
    std::vector<dealii::types::global_dof_index> index;
    std::vector<double>                          weight;
  };
} // namespace mortise
