#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_tools.h>

#include <deal.II/grid/grid_tools.h>

#include <mortise/base/compatibility.h>
#include <mortise/body/elements/conforming_nodes.h>

#include <algorithm>
#include <array>
#include <optional>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Cell = Triangulation<3>::cell_iterator;

    /// By level and index.
    using NodesOfCells = std::map<std::pair<int, int>, std::vector<Point<3>>>;

    std::pair<int, int>
    key(const Cell &cell)
    {
      return {cell->level(), cell->index()};
    }

    /// Of the unit cell, as the bits of the number of a vertex are.
    Point<3>
    unit_vertex(const unsigned int v)
    {
      return GeometryInfo<3>::unit_cell_vertex(v);
    }

    /// Local number of a vertex of the triangulation.
    unsigned int
    local_vertex(const Cell &cell, const unsigned int index)
    {
      for (const unsigned int v : cell->vertex_indices())
        if (cell->vertex_index(v) == index)
          return v;
      Assert(false, ExcInternalError());
      return 0;
    }

    /// Where points of a face or an edge of @p cell, at local vertex @p v and in directions @p along, are in @p other,
    /// which has it, too.
    class SharedEntity
    {
    public:
      SharedEntity(const Cell                      &cell,
                   const unsigned int               v,
                   const std::vector<unsigned int> &along,
                   const Cell                      &other)
        : along(along)
      {
        unsigned int first = v;
        for (const unsigned int a : along)
          first &= ~(1u << a);
        origin = in_other(cell, first, other);
        for (const unsigned int a : along)
          directions.push_back(in_other(cell, first | (1u << a), other) -
                               origin);
      }

      Point<3>
      operator()(const Point<3> &x) const
      {
        Point<3> result = origin;
        for (unsigned int k = 0; k < along.size(); ++k)
          result += x[along[k]] * directions[k];
        return result;
      }

    private:
      static Point<3>
      in_other(const Cell &cell, const unsigned int v, const Cell &other)
      {
        return unit_vertex(local_vertex(other, cell->vertex_index(v)));
      }

      std::vector<unsigned int> along;
      Point<3>                  origin;
      std::vector<Tensor<1, 3>> directions;
    };

    class Conformity
    {
    public:
      Conformity(const HexahedralMapping &mapping,
                 const unsigned int       degree,
                 const Triangulation<3>  &triangulation)
        : mapping(mapping)
        , n(degree + 1)
        , triangulation(triangulation)
        , line(QGaussLobatto<1>(n).get_points())
        , to_lexicographic(
            FETools::hierarchic_to_lexicographic_numbering<3>(degree))
        , polynomials(Polynomials::generate_complete_Lagrange_basis(line))
      {}

      NodesOfCells
      run()
      {
        const unsigned int n_levels =
          Utilities::MPI::max(triangulation.n_levels(),
                              triangulation.get_communicator());
        for (unsigned int level = 0; level + 1 < n_levels; ++level)
          {
            find_larger(level);
            if (level + 1 < triangulation.n_levels())
              for (const auto &cell :
                   triangulation.active_cell_iterators_on_level(level + 1))
                if (cell->is_locally_owned())
                  conform(cell);
            exchange(level + 1);
          }
        return changed;
      }

    private:
      /// By i + n (j + n k).
      using Corrections = std::vector<std::optional<Tensor<1, 3>>>;

      std::vector<Point<3>>
      nodes(const Cell &cell) const
      {
        const auto found = changed.find(key(cell));
        return found == changed.end() ? mapping.nodes(cell) : found->second;
      }

      /// Active cells of @p level with edges of which there are halves.
      void
      find_larger(const unsigned int level)
      {
        larger.clear();
        if (level >= triangulation.n_levels())
          return;
        for (const auto &cell :
             triangulation.active_cell_iterators_on_level(level))
          if (!cell->is_artificial())
            for (const unsigned int e : cell->line_indices())
              if (cell->line(e)->has_children())
                larger.emplace(cell->line(e)->index(), cell);
      }

      Point<3>
      value(const std::vector<Point<3>> &of_cell, const Point<3> &x) const
      {
        std::array<std::vector<double>, 3> values;
        for (unsigned int d = 0; d < 3; ++d)
          for (const auto &polynomial : polynomials)
            values[d].push_back(polynomial.value(x[d]));
        Point<3> result;
        for (unsigned int i = 0; i < of_cell.size(); ++i)
          {
            const unsigned int l = to_lexicographic[i];
            const double       w =
              values[0][l % n] * values[1][l / n % n] * values[2][l / (n * n)];
            for (unsigned int c = 0; c < 3; ++c)
              result[c] += w * of_cell[i][c];
          }
        return result;
      }

      /// Let @p cell, child @p c of @p parent, follow @p other where the entity in directions @p along at vertex
      /// c of the parent is.
      void
      follow(const Cell                      &parent,
             const unsigned int               c,
             const std::vector<unsigned int> &along,
             const Cell                      &other,
             const std::vector<Point<3>>     &own,
             Corrections                     &corrections) const
      {
        const SharedEntity          shared(parent, c, along, other);
        const std::vector<Point<3>> of_other = nodes(other);
        for (unsigned int i = 0; i < own.size(); ++i)
          {
            const unsigned int                l = to_lexicographic[i];
            const std::array<unsigned int, 3> index{
              {l % n, l / n % n, l / (n * n)}};
            Point<3> x;
            bool     is_on = true;
            for (unsigned int d = 0; d < 3; ++d)
              {
                const unsigned int bit = (c >> d) & 1u;
                x[d]                   = (line[index[d]][0] + bit) / 2.;
                if (std::find(along.begin(), along.end(), d) == along.end() &&
                    index[d] != bit * (n - 1))
                  is_on = false;
              }
            if (is_on)
              corrections[l] = value(of_other, shared(x)) - own[i];
          }
      }

      void
      conform(const Cell &cell)
      {
        const Cell   parent = cell->parent();
        unsigned int c      = 0;
        while (parent->child(c) != cell)
          ++c;
        Corrections           corrections(n * n * n);
        bool                  any = false;
        std::vector<Point<3>> own = mapping.nodes(cell);
        for (unsigned int a = 0; a < 3; ++a)
          for (const unsigned int e : parent->line_indices())
            if (const auto other = larger.find(parent->line(e)->index());
                other != larger.end() && is_at(e, c, a))
              {
                follow(parent, c, {a}, other->second, own, corrections);
                any = true;
              }
        for (unsigned int d = 0; d < 3; ++d)
          {
            const unsigned int f = 2 * d + ((c >> d) & 1u);
            if (parent->at_boundary(f) || !parent->neighbor(f)->is_active())
              continue;
            follow(parent,
                   c,
                   {(d + 1) % 3, (d + 2) % 3},
                   parent->neighbor(f),
                   own,
                   corrections);
            any = true;
          }
        if (!any)
          return;
        go_on(corrections);
        for (unsigned int i = 0; i < own.size(); ++i)
          own[i] += *corrections[to_lexicographic[i]];
        changed[key(cell)] = own;
      }

      /// Does line @p e of a cell go along direction @p a from vertex @p c or to it?
      static bool
      is_at(const unsigned int e, const unsigned int c, const unsigned int a)
      {
        const unsigned int v0 = GeometryInfo<3>::line_to_cell_vertices(e, 0),
                           v1 = GeometryInfo<3>::line_to_cell_vertices(e, 1);
        return (v0 ^ v1) == (1u << a) && (v0 == c || v1 == c);
      }

      /// From vertices to edges, faces and the inside.
      void
      go_on(Corrections &corrections) const
      {
        const auto at = [&](const std::array<unsigned int, 3> &i)
          -> std::optional<Tensor<1, 3>> & {
          return corrections[i[0] + n * (i[1] + n * i[2])];
        };
        for (unsigned int n_inside = 0; n_inside <= 3; ++n_inside)
          for (unsigned int l = 0; l < corrections.size(); ++l)
            {
              const std::array<unsigned int, 3> i{
                {l % n, l / n % n, l / (n * n)}};
              std::vector<unsigned int> inside;
              for (unsigned int d = 0; d < 3; ++d)
                if (i[d] > 0 && i[d] + 1 < n)
                  inside.push_back(d);
              if (inside.size() != n_inside || corrections[l])
                continue;
              // sum over the ends of all subsets of directions, with signs
              Tensor<1, 3> sum;
              for (unsigned int subset = 1; subset < (1u << n_inside); ++subset)
                {
                  std::vector<unsigned int> directions;
                  for (unsigned int k = 0; k < n_inside; ++k)
                    if (subset & (1u << k))
                      directions.push_back(inside[k]);
                  const double sign = directions.size() % 2 == 1 ? 1. : -1.;
                  for (unsigned int ends = 0; ends < (1u << directions.size());
                       ++ends)
                    {
                      auto   j      = i;
                      double weight = sign;
                      for (unsigned int k = 0; k < directions.size(); ++k)
                        {
                          const unsigned int d   = directions[k];
                          const bool         end = ends & (1u << k);
                          weight *= end ? line[i[d]][0] : 1. - line[i[d]][0];
                          j[d] = end ? n - 1 : 0;
                        }
                      sum += weight * *at(j);
                    }
                }
              corrections[l] = sum;
            }
      }

      /// Tell other ranks of the cells of @p level.
      void
      exchange(const unsigned int level)
      {
        if (Utilities::MPI::n_mpi_processes(triangulation.get_communicator()) ==
            1)
          return;
        using Numbers = std::vector<double>;
        GridTools::exchange_cell_data_to_ghosts<Numbers, Triangulation<3>>(
          triangulation,
          [&](const Triangulation<3>::active_cell_iterator &cell)
            -> compatibility::optional<Numbers> {
            const auto found = changed.find(key(cell));
            if (static_cast<unsigned int>(cell->level()) != level ||
                found == changed.end())
              return {};
            Numbers numbers;
            for (const Point<3> &x : found->second)
              numbers.insert(numbers.end(), x.begin_raw(), x.end_raw());
            return numbers;
          },
          [&](const Triangulation<3>::active_cell_iterator &cell,
              const Numbers                                &numbers) {
            auto &of_cell = changed[key(cell)];
            of_cell.clear();
            for (unsigned int i = 0; i < numbers.size(); i += 3)
              of_cell.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
          });
      }

      const HexahedralMapping                           &mapping;
      const unsigned int                                 n; ///< nodes of a line
      const Triangulation<3>                            &triangulation;
      const std::vector<Point<1>>                        line;
      const std::vector<unsigned int>                    to_lexicographic;
      const std::vector<Polynomials::Polynomial<double>> polynomials;
      std::map<unsigned int, Cell>                       larger; ///< by line
      NodesOfCells                                       changed;
    };
  } // namespace

  ConformingNodes::ConformingNodes(const HexahedralMapping &mapping,
                                   const unsigned int       degree,
                                   const Triangulation<3>  &triangulation)
    : mapping(mapping)
    , triangulation(triangulation)
    , changed(Conformity(mapping, degree, triangulation).run())
  {}

  std::vector<Point<3>>
  ConformingNodes::nodes(const Triangulation<3>::cell_iterator &cell) const
  {
    const auto found = changed.find(key(cell));
    return found == changed.end() ? mapping.nodes(cell) : found->second;
  }

  double
  ConformingNodes::largest_shift() const
  {
    double result = 0.;
    for (const auto &[number, moved] : changed)
      {
        const Cell cell(&triangulation, number.first, number.second);
        const auto given = mapping.nodes(cell);
        for (unsigned int i = 0; i < given.size(); ++i)
          result = std::max(result,
                            (moved[i] - given[i]).norm() /
                              cell->minimum_vertex_distance());
      }
    return Utilities::MPI::max(result, triangulation.get_communicator());
  }
} // namespace mortise
