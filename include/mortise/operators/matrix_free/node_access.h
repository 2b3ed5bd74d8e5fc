// Values at the nodes of several cells at once, from vectors and to them. Only
// sources of kernels include it.
//
// The three components of a node are one load, which is masked since the fourth
// number may lie beyond the vector; a transposition in registers makes vectors
// of lanes of them. Number by number it takes four times as many operations.
#pragma once

#include <mortise/operators/matrix_free/tensor_kernel.h>

#if __has_builtin(__builtin_shufflevector)
#  if defined(__AVX512F__) && defined(__AVX512VL__)
#    include <mortise/operators/matrix_free/node_shuffles_512.h>
#    define MORTISE_NODES_BY_SHUFFLES
#  elif defined(__AVX2__) && !defined(__AVX512F__)
#    include <mortise/operators/matrix_free/node_shuffles_256.h>
#    define MORTISE_NODES_BY_SHUFFLES
#  endif
#endif

namespace mortise
{
  /// The components at the nodes of a batch of cells, node after node.
  /// @p nodes: for each node the index of its first component by lane.
  template <int n_nodes, int n_components = 3, typename Number>
  inline void
  gather(const Number                   *source,
         const unsigned int             *nodes,
         typename Batch<Number>::Vector *values)
  {
    constexpr unsigned int width = Batch<Number>::size;
    for (int i = 0; i < n_nodes; ++i)
      {
#ifdef MORTISE_NODES_BY_SHUFFLES
        if constexpr (n_components == 3)
          {
            typename Batch<Number>::Vector components[3];
            gather_node(source, nodes + i * width, components);
            for (int c = 0; c < n_components; ++c)
              values[c * n_nodes + i] = components[c];
            continue;
          }
#endif
        for (unsigned int l = 0; l < width; ++l)
          {
            const Number *from = source + nodes[i * width + l];
            for (int c = 0; c < n_components; ++c)
              values[c * n_nodes + i][l] = from[c];
          }
      }
  }

  template <int n_nodes, int n_components = 3, typename Number>
  inline void
  scatter_add(const typename Batch<Number>::Vector *values,
              const unsigned int                   *nodes,
              Number                               *target)
  {
    constexpr unsigned int width = Batch<Number>::size;
    for (int i = 0; i < n_nodes; ++i)
      {
#ifdef MORTISE_NODES_BY_SHUFFLES
        if constexpr (n_components == 3)
          {
            scatter_node({values[i],
                          values[n_nodes + i],
                          values[2 * n_nodes + i]},
                         nodes + i * width,
                         target);
            continue;
          }
#endif
        for (unsigned int l = 0; l < width; ++l)
          {
            Number *to = target + nodes[i * width + l];
            for (int c = 0; c < n_components; ++c)
              to[c] += values[c * n_nodes + i][l];
          }
      }
  }
} // namespace mortise
