#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_system.h>

#include <mortise/base/compatibility.h>
#include <mortise/body/elements/fe_simplex_legendre.h>

#include <algorithm>
#include <type_traits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    FiniteElementData<3>
    simplex_element_data(const unsigned int degree)
    {
      AssertThrow(degree >= 1 && degree <= max_simplex_degree,
                  ExcMessage("FE_SimplexLegendre: the degree is " +
                             std::to_string(degree) + ", allowed is 1 to " +
                             std::to_string(max_simplex_degree)));
      return FiniteElementData<3>({1,
                                   n_line_modes(degree),
                                   n_face_modes(degree),
                                   n_interior_modes(degree)},
                                  ReferenceCells::Tetrahedron,
                                  1,
                                  degree,
                                  FiniteElementData<3>::H1);
    }
  } // namespace

  FE_SimplexLegendre::FE_SimplexLegendre(const unsigned int degree,
                                         const VertexOrder &order)
    : FE_Hierarchical(SimplexLegendrePolynomials(degree, order),
                      simplex_element_data(degree))
    , order(order)
  {
    this->generalized_support_points = simplex_interpolation_points(degree);
  }

  std::string
  FE_SimplexLegendre::get_name() const
  {
    std::string name =
      "FE_SimplexLegendre<3>(" + std::to_string(this->degree) + ", ";
    for (const unsigned int v : order)
      name += std::to_string(v);
    return name + ")";
  }

  std::array<unsigned int, 3>
  ascending_face_vertices(const VertexOrder &order, const unsigned int face)
  {
    AssertIndexRange(face, 4);
    const VertexOrder           ranks    = vertex_ranks(order);
    std::array<unsigned int, 3> vertices = {{tetrahedron_faces[face][0],
                                             tetrahedron_faces[face][1],
                                             tetrahedron_faces[face][2]}};
    std::sort(vertices.begin(),
              vertices.end(),
              [&](const unsigned int v, const unsigned int w) {
                return ranks[v] < ranks[w];
              });
    return vertices;
  }

  std::vector<unsigned int>
  trace_dof_indices(const FE_SimplexLegendre &element, const unsigned int face)
  {
    const auto vertices = ascending_face_vertices(element.order, face);
    std::vector<unsigned int> dofs(vertices.begin(), vertices.end());
    const unsigned int        n = n_line_modes(element.degree);
    for (const auto &[v, w] : {std::make_pair(vertices[0], vertices[1]),
                               std::make_pair(vertices[0], vertices[2]),
                               std::make_pair(vertices[1], vertices[2])})
      for (unsigned int l = 0; l < 6; ++l)
        if (std::minmax(tetrahedron_lines[l][0], tetrahedron_lines[l][1]) ==
            std::minmax(v, w))
          for (unsigned int i = 0; i < n; ++i)
            dofs.push_back(element.get_first_line_index() + l * n + i);
    for (unsigned int i = 0; i < n_face_modes(element.degree); ++i)
      dofs.push_back(element.get_first_quad_index(face) + i);
    return dofs;
  }

  namespace
  {
    /// For an FESystem that does not order triangles.
    class WithoutFaceTable : public FE_SimplexLegendre
    {
    public:
      WithoutFaceTable(const unsigned int degree, const VertexOrder &order)
        : FE_SimplexLegendre(degree, order)
      {
        for (auto &table :
             this->adjust_quad_dof_index_for_face_orientation_table)
          table = Table<2, int>();
      }
    };

    using SystemPart =
      std::conditional_t<compatibility::system_orders_triangles,
                         FE_SimplexLegendre,
                         WithoutFaceTable>;
  } // namespace

  std::unique_ptr<FiniteElement<3>>
  make_simplex_system(const FE_SimplexLegendre &element,
                      const unsigned int        n_components)
  {
    return std::make_unique<FESystem<3>>(SystemPart(element.degree,
                                                    element.order),
                                         n_components);
  }

  namespace
  {
    /// Barycentric coordinates of the node with the indices @p index, whose
    /// sum is @p degree: the weighted mean of the nodes that are left when one
    /// of the indices is taken away.
    std::vector<double>
    recursive_node(const std::vector<std::vector<double>> &lobatto,
                   const unsigned int                      degree,
                   const std::vector<unsigned int>        &index)
    {
      if (index.size() == 1)
        return {1.};
      std::vector<double> node(index.size(), 0.);
      double              sum = 0.;
      for (unsigned int i = 0; i < index.size(); ++i)
        if (index[i] < degree)
          {
            std::vector<unsigned int> rest(index);
            rest.erase(rest.begin() + i);
            const double weight = lobatto[degree][degree - index[i]];
            const auto face = recursive_node(lobatto, degree - index[i], rest);
            for (unsigned int j = 0; j < face.size(); ++j)
              node[j < i ? j : j + 1] += weight * face[j];
            sum += weight;
          }
      for (double &coordinate : node)
        coordinate /= sum;
      return node;
    }
  } // namespace

  std::vector<Point<3>>
  simplex_interpolation_points(const unsigned int degree)
  {
    std::vector<std::vector<double>> lobatto(degree + 1);
    for (unsigned int n = 1; n <= degree; ++n)
      {
        const QGaussLobatto<1> rule(n + 1);
        for (unsigned int q = 0; q <= n; ++q)
          lobatto[n].push_back(rule.point(q)[0]);
      }

    std::vector<Point<3>> points;
    for (unsigned int k = 0; k <= degree; ++k)
      for (unsigned int j = 0; j + k <= degree; ++j)
        for (unsigned int i = 0; i + j + k <= degree; ++i)
          {
            const auto node =
              recursive_node(lobatto, degree, {degree - i - j - k, i, j, k});
            points.emplace_back(node[1], node[2], node[3]);
          }
    return points;
  }
} // namespace mortise
