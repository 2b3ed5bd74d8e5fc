#include <mortise/base/tensor_product.h>
#include <mortise/body/elements/simplex_basis.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/body/elements/trace_basis.h>
#include <mortise/mortar/nodal_block.h>

#include <map>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// F^T A with the F of triangles. Modes of higher degree than the nodes'
    /// are left out: those of a line come one after another, those of the
    /// inside sorted by degree.
    FullMatrix<double>
    transform_triangle_rows(const FullMatrix<double> &A, const BlockSide &side)
    {
      const unsigned int        q = side.nodal, p = side.modal;
      const FullMatrix<double> &modes = triangle_nodes_to_modes(q);
      std::vector<unsigned int> rows;
      for (unsigned int v = 0; v < 3; ++v)
        rows.push_back(v);
      for (unsigned int e = 0; e < 3; ++e)
        for (unsigned int k = 0; k < n_line_modes(q); ++k)
          rows.push_back(3 + e * n_line_modes(p) + k);
      for (unsigned int k = 0; k < n_face_modes(q); ++k)
        rows.push_back(3 + 3 * n_line_modes(p) + k);
      FullMatrix<double> result(modes.n(), A.n());
      for (unsigned int k = 0; k < modes.m(); ++k)
        for (unsigned int i = 0; i < modes.n(); ++i)
          if (modes(k, i) != 0.)
            for (unsigned int j = 0; j < A.n(); ++j)
              result(i, j) += modes(k, i) * A(rows[k], j);
      return result;
    }

    /// Linear functions are those of nodes.
    bool
    stays(const BlockSide &side)
    {
      return side.nodal == 0 || (side.nodal == 1 && side.modal == 1);
    }

    /// F^T A with the two-dimensional F of @p side.
    FullMatrix<double>
    transform_rows(const FullMatrix<double> &A, const BlockSide &side)
    {
      if (stays(side))
        return A;
      if (side.shape == FaceShape::triangle)
        return transform_triangle_rows(A, side);
      const unsigned int        q = side.nodal, n = q + 1, m = side.modal + 1;
      const FullMatrix<double> &modes = nodes_to_modes(q); // (mode, node)
      // first index, then second
      FullMatrix<double> half(n * n, A.n()), result(n * n, A.n());
      for (unsigned int l = 0; l < n; ++l)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = 0; k < n; ++k)
            if (modes(k, i) != 0.)
              for (unsigned int j = 0; j < A.n(); ++j)
                half(i + n * l, j) += modes(k, i) * A(k + m * l, j);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int l = 0; l < n; ++l)
          for (unsigned int k = 0; k < n; ++k)
            if (modes(k, l) != 0.)
              for (unsigned int j = 0; j < A.n(); ++j)
                result(i + n * l, j) += modes(k, l) * half(i + n * k, j);
      return result;
    }
  } // namespace

  FullMatrix<double>
  nodal_block(const FullMatrix<double> &modal,
              const BlockSide          &rows,
              const BlockSide          &columns)
  {
    const FullMatrix<double> half = transform_rows(modal, rows);
    if (stays(columns))
      return half;
    return transposed(transform_rows(transposed(half), columns));
  }

  namespace
  {
    FullMatrix<double>
    resolve_rows(const FullMatrix<double> &A, const FaceNodes &rows)
    {
      FullMatrix<double> result(rows.nodes.size(), A.n());
      for (unsigned int k = 0; k < A.m(); ++k)
        for (unsigned int e = rows.begin[k]; e < rows.begin[k + 1]; ++e)
          for (unsigned int j = 0; j < A.n(); ++j)
            result(rows.column[e], j) += rows.weight[e] * A(k, j);
      return result;
    }
  } // namespace

  const FaceNodalBasis &
  face_nodal_basis(const FaceShape shape, const unsigned int degree)
  {
    static std::map<std::pair<FaceShape, unsigned int>, FaceNodalBasis> known;
    FaceNodalBasis &result = known[{shape, degree}];
    if (result.values.m() == 0)
      {
        const unsigned int n = trace_basis(shape, degree).size();
        result.functions.copy_transposed(
          nodal_block(FullMatrix<double>(IdentityMatrix(n)),
                      {shape, degree, degree},
                      {shape, degree, 0}));
        result.values.reinit(n, n);
        result.values.invert(result.functions);
      }
    return result;
  }

  std::vector<Point<2>>
  face_nodes(const FaceShape shape, const unsigned int degree)
  {
    // the functions of vertices are those of the linear element
    const FullMatrix<double> &values = face_nodal_basis(shape, degree).values;
    const TraceBasis         &basis  = trace_basis(shape, degree);
    std::vector<Point<2>>     nodes(basis.size());
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (unsigned int v = 1; v < basis.n_vertices(); ++v)
        nodes[k] +=
          values(k, basis.vertex_function(v)) * Point<2>(v % 2, v / 2);
    return nodes;
  }

  FullMatrix<double>
  resolve_hanging(FullMatrix<double> A,
                  const FaceNodes   &rows,
                  const FaceNodes   &columns)
  {
    if (rows.hang())
      A = resolve_rows(A, rows);
    if (columns.hang())
      A = transposed(resolve_rows(transposed(A), columns));
    return A;
  }
} // namespace mortise
