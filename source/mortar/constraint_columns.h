// The columns of the constraint on one side of an interface, as its assembly
// takes them.
#pragma once

#include <mortise/mortar/coupled_faces.h>
#include <mortise/mortar/nodal_block.h>


namespace mortise
{
  /// Nodes, where some of the face hang those that they hang on: the matrix
  /// also has the columns of components that are prescribed.
  class NodalColumns
  {
  public:
    explicit NodalColumns(const FaceTrace &trace)
      : trace(trace)
    {
      const FaceNodes   &face = trace.nodes[0];
      const unsigned int n    = trace.n_functions();
      for (unsigned int k = 0; k < n; ++k)
        {
          if (face.hang())
            for (unsigned int e = face.begin[k]; e < face.begin[k + 1]; ++e)
              nodes.add(face.nodes[face.column[e]], face.weight[e]);
          else
            nodes.add(face.nodes[k], 1.);
          nodes.close();
        }
    }

    /// The functions of a component in them.
    Expansion
    component() const
    {
      return nodes();
    }

    /// A local matrix for these functions.
    dealii::FullMatrix<double>
    in_columns(const dealii::FullMatrix<double> &local) const
    {
      return nodal_block(local,
                         {trace.shape, trace.degree, 0},
                         {trace.shape, trace.degree, trace.degree});
    }

  private:
    const FaceTrace &trace;
    ExpansionList    nodes;
  };
} // namespace mortise
