#include <deal.II/base/exceptions.h>

#include <mortise/body/elements/simplex_basis.h>
#include <mortise/body/elements/trace_basis.h>

namespace mortise
{
  namespace
  {
    constexpr unsigned int triangle_edges[3][2] = {{0, 1}, {0, 2}, {1, 2}};

    std::vector<TraceBasis::Function>
    quadrilateral_functions(const unsigned int degree)
    {
      std::vector<TraceBasis::Function> functions;
      for (unsigned int j = 0; j <= degree; ++j)
        for (unsigned int i = 0; i <= degree; ++i)
          if (i < 2 && j < 2)
            functions.push_back({0, i + 2 * j, 1, {{i, j}}});
          else if (j < 2)
            functions.push_back({1, j, i, {{i, j}}});
          else if (i < 2)
            functions.push_back({1, 2 + i, j, {{i, j}}});
          else
            functions.push_back({2, 0, std::max(i, j), {{i, j}}});
      return functions;
    }

    std::vector<TraceBasis::Function>
    triangle_functions(const unsigned int degree)
    {
      std::vector<TraceBasis::Function> functions;
      for (unsigned int v = 0; v < 3; ++v)
        functions.push_back({0, v, 1, {}});
      for (unsigned int e = 0; e < 3; ++e)
        for (unsigned int k = 2; k <= degree; ++k)
          functions.push_back({1, e, k, {}});
      // sorted by degree
      for (unsigned int k = 3; k <= degree; ++k)
        for (unsigned int i = n_face_modes(k - 1); i < n_face_modes(k); ++i)
          functions.push_back({2, 0, k, {}});
      return functions;
    }
  } // namespace

  TraceBasis::TraceBasis(const FaceShape shape, const unsigned int degree)
    : shape(shape)
    , degree(degree)
    , functions(shape == FaceShape::triangle ? triangle_functions(degree) :
                                               quadrilateral_functions(degree))
    , polynomials(shape == FaceShape::triangle ?
                    std::make_shared<SimplexLegendrePolynomials>(
                      degree,
                      VertexOrder{{0, 1, 2, 3}}) :
                    nullptr)
  {}

  void
  TraceBasis::evaluate(const double xi_1,
                       const double xi_2,
                       double      *values) const
  {
    if (shape == FaceShape::triangle)
      return polynomials->evaluate_trace({{1. - xi_1 - xi_2, xi_1, xi_2}},
                                         values);
    double x[max_lobatto_degree + 1], y[max_lobatto_degree + 1];
    evaluate_lobatto(degree, xi_1, x);
    evaluate_lobatto(degree, xi_2, y);
    for (unsigned int j = 0; j <= degree; ++j)
      for (unsigned int i = 0; i <= degree; ++i)
        *values++ = x[i] * y[j];
  }

  std::array<unsigned int, 2>
  TraceBasis::edge_vertices(const unsigned int e) const
  {
    AssertIndexRange(e, n_edges());
    if (shape == FaceShape::triangle)
      return {{triangle_edges[e][0], triangle_edges[e][1]}};
    return e < 2 ? std::array<unsigned int, 2>{{2 * e, 2 * e + 1}} :
                   std::array<unsigned int, 2>{{e - 2, e}};
  }

  std::array<double, 2>
  TraceBasis::edge_point(const unsigned int e, const double t) const
  {
    if (shape == FaceShape::triangle)
      return e == 0 ? std::array<double, 2>{{t, 0.}} :
             e == 1 ? std::array<double, 2>{{0., t}} :
                      std::array<double, 2>{{1. - t, t}};
    const double side = e % 2;
    return e < 2 ? std::array<double, 2>{{t, side}} :
                   std::array<double, 2>{{side, t}};
  }

  const TraceBasis &
  trace_basis(const FaceShape shape, const unsigned int degree)
  {
    static const auto bases = [] {
      std::array<std::vector<TraceBasis>, 2> all;
      for (unsigned int p = 1; p <= max_lobatto_degree; ++p)
        {
          all[0].emplace_back(FaceShape::triangle, p);
          all[1].emplace_back(FaceShape::quadrilateral, p);
        }
      return all;
    }();
    AssertIndexRange(degree - 1, max_lobatto_degree);
    return bases[shape == FaceShape::triangle ? 0 : 1][degree - 1];
  }
} // namespace mortise
