#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/body/elements/simplex_nodes.h>

#include <array>
#include <map>
#include <memory>
#include <mutex>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr VertexSet whole_cell = 15;

    VertexSet
    line_set(const unsigned int l)
    {
      return 1u << tetrahedron_lines[l][0] | 1u << tetrahedron_lines[l][1];
    }

    VertexSet
    face_set(const unsigned int f)
    {
      return 1u << tetrahedron_faces[f][0] | 1u << tetrahedron_faces[f][1] |
             1u << tetrahedron_faces[f][2];
    }

  } // namespace

  std::vector<VertexSet>
  sets_of_functions(const unsigned int degree)
  {
    std::vector<VertexSet> sets;
    for (unsigned int v = 0; v < 4; ++v)
      sets.push_back(1u << v);
    for (unsigned int l = 0; l < 6; ++l)
      sets.insert(sets.end(), n_line_modes(degree), line_set(l));
    for (unsigned int f = 0; f < 4; ++f)
      sets.insert(sets.end(), n_face_modes(degree), face_set(f));
    sets.insert(sets.end(), n_interior_modes(degree), whole_cell);
    return sets;
  }

  namespace
  {
    struct SimplexTables
    {
      explicit SimplexTables(const unsigned int degree)
        : polynomials(degree, VertexOrder{{0, 1, 2, 3}})
      {
        const std::vector<VertexSet> sets = sets_of_functions(degree);
        find_nodes(degree, sets);
        const unsigned int n = nodes.size();
        to_nodes.reinit(n, n);
        for (unsigned int i = 0; i < n; ++i)
          {
            const std::vector<double> values = values_at(polynomials, nodes[i]);
            for (unsigned int k = 0; k < n; ++k)
              // exactly so, that nothing leaks from one entity to another
              if ((sets[k] & ~sets[i]) == 0)
                to_nodes(i, k) = i < 4 ? 1. : values[k];
          }
        to_modes = to_nodes;
        to_modes.gauss_jordan();
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int i = 0; i < n; ++i)
            if ((sets[i] & ~sets[k]) != 0)
              to_modes(k, i) = 0.;
            else if (k < 4)
              to_modes(k, i) = 1.;

        // the face of the vertices 0, 1, 2 in the order of a trace
        const auto trace = trace_dof_indices(FE_SimplexLegendre(degree), 0);
        face_to_modes.reinit(trace.size(), trace.size());
        face_to_modes.extract_submatrix_from(to_modes, trace, trace);
      }

      /// Those of one entity in the order of their indices.
      void
      find_nodes(const unsigned int degree, const std::vector<VertexSet> &sets)
      {
        std::map<VertexSet, std::vector<Point<3>>> by_set;
        const auto points = simplex_interpolation_points(degree);
        auto       point  = points.begin();
        for (unsigned int k = 0; k <= degree; ++k)
          for (unsigned int j = 0; j + k <= degree; ++j)
            for (unsigned int i = 0; i + j + k <= degree; ++i, ++point)
              by_set[(i + j + k < degree) | (i > 0) << 1 | (j > 0) << 2 |
                     (k > 0) << 3]
                .push_back(*point);
        std::map<VertexSet, unsigned int> used;
        for (const VertexSet set : sets)
          nodes.push_back(by_set[set][used[set]++]);
      }

      const SimplexLegendrePolynomials polynomials;
      std::vector<Point<3>>            nodes;
      FullMatrix<double>               to_nodes, to_modes, face_to_modes;
    };

    const SimplexTables &
    simplex_tables(const unsigned int degree)
    {
      static std::array<std::once_flag, max_simplex_degree> made;
      static std::array<std::unique_ptr<SimplexTables>, max_simplex_degree> all;
      AssertIndexRange(degree - 1, max_simplex_degree);
      std::call_once(made[degree - 1], [&] {
        all[degree - 1] = std::make_unique<SimplexTables>(degree);
      });
      return *all[degree - 1];
    }
  } // namespace

  const std::vector<Point<3>> &
  simplex_nodes(const unsigned int degree)
  {
    return simplex_tables(degree).nodes;
  }

  const FullMatrix<double> &
  simplex_modes_to_nodes(const unsigned int degree)
  {
    return simplex_tables(degree).to_nodes;
  }

  const FullMatrix<double> &
  simplex_nodes_to_modes(const unsigned int degree)
  {
    return simplex_tables(degree).to_modes;
  }

  const FullMatrix<double> &
  triangle_nodes_to_modes(const unsigned int degree)
  {
    return simplex_tables(degree).face_to_modes;
  }

  std::vector<unsigned int>
  ascending_dof_indices(const unsigned int degree, const VertexOrder &order)
  {
    const std::vector<VertexSet>      sets = sets_of_functions(degree);
    std::map<VertexSet, unsigned int> first; // function of the element
    for (unsigned int k = sets.size(); k-- > 0;)
      first[sets[k]] = k;
    std::map<VertexSet, unsigned int> used;
    std::vector<unsigned int>         result;
    for (const VertexSet ascending : sets)
      {
        VertexSet local = 0;
        for (unsigned int v = 0; v < 4; ++v)
          if (ascending & 1u << v)
            local |= 1u << order[v];
        result.push_back(first[local] + used[local]++);
      }
    return result;
  }

  FullMatrix<double>
  simplex_nodal_values(const unsigned int           degree,
                       const std::vector<Point<3>> &points)
  {
    const SimplexTables &tables = simplex_tables(degree);
    const unsigned int   n      = tables.nodes.size();
    FullMatrix<double>   modal(points.size(), n), result(points.size(), n);
    for (unsigned int q = 0; q < points.size(); ++q)
      for (unsigned int k = 0; k < n; ++k)
        modal(q, k) = tables.polynomials.compute_value(k, points[q]);
    modal.mmult(result, tables.to_modes);
    return result;
  }

  FullMatrix<double>
  simplex_nodal_gradients(const unsigned int           degree,
                          const std::vector<Point<3>> &points)
  {
    const SimplexTables      &tables = simplex_tables(degree);
    const unsigned int        n = tables.nodes.size(), n_points = points.size();
    FullMatrix<double>        modal(3 * n_points, n), result(3 * n_points, n);
    std::vector<Tensor<1, 3>> gradients;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        values_at(tables.polynomials, points[q], &gradients);
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int k = 0; k < n; ++k)
            modal(d * n_points + q, k) = gradients[k][d];
      }
    modal.mmult(result, tables.to_modes);
    return result;
  }
} // namespace mortise
