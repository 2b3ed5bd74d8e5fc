#include <deal.II/base/quadrature_lib.h>

#include <mortise/body/elements/legendre_basis.h>
#include <mortise/body/spaces/conformity_lines.h>
#include <mortise/body/spaces/nodal_conformity.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Coordinates = std::vector<double>;

    /// Ends first, as in evaluate_lobatto().
    Coordinates
    lobatto_points(const unsigned int degree)
    {
      const QGaussLobatto<1> points(degree + 1);
      Coordinates            result;
      for (unsigned int k = 0; k <= degree; ++k)
        result.push_back(points.point(lobatto_to_lexicographic(degree, k))[0]);
      return result;
    }

    /// Values at @p x of the Lagrange polynomials on @p points.
    Coordinates
    lagrange_at(const Coordinates &points, const double x)
    {
      Coordinates values(points.size(), 1.);
      for (unsigned int k = 0; k < points.size(); ++k)
        for (unsigned int j = 0; j < points.size(); ++j)
          if (j != k)
            values[k] *= (x - points[j]) / (points[k] - points[j]);
      return values;
    }

    double
    lebesgue_constant(const Coordinates &points)
    {
      double largest = 0.;
      for (unsigned int i = 0; i <= 100; ++i)
        {
          double sum = 0.;
          for (const double value : lagrange_at(points, i / 100.))
            sum += std::fabs(value);
          largest = std::max(largest, sum);
        }
      return largest;
    }

    /// Polynomials of one degree by values at nodes of a higher one.
    struct CarryingNodes
    {
      /// By node k - 2 inside the line, in the order of evaluate_lobatto(): its
      /// place among all, those that carry first.
      std::vector<unsigned int> place;
      /// Ends and the nodes that carry, by place.
      Coordinates points;

      CarryingNodes() = default;
      CarryingNodes(const unsigned int lattice, const unsigned int degree)
      {
        const Coordinates all  = lobatto_points(lattice);
        double            best = std::numeric_limits<double>::infinity();
        std::vector<bool> carries(lattice - 1, false);
        std::fill_n(carries.begin(), degree - 1, true);
        do
          {
            Coordinates chosen = {0., 1.};
            for (unsigned int k = 0; k < carries.size(); ++k)
              if (carries[k])
                chosen.push_back(all[k + 2]);
            const double constant = lebesgue_constant(chosen);
            if (constant > 0.999 * best) // the first of equals
              continue;
            best              = constant;
            points            = chosen;
            unsigned int next = 0, rest = degree - 1;
            place.clear();
            for (const bool carry : carries)
              place.push_back(carry ? next++ : rest++);
          }
        while (std::prev_permutation(carries.begin(), carries.end()));
      }
    };

    const CarryingNodes &
    carrying_nodes(const unsigned int lattice, const unsigned int degree)
    {
      static const auto all = [] {
        std::array<std::array<CarryingNodes, max_lobatto_degree + 1>,
                   max_lobatto_degree + 1>
          table;
        for (unsigned int s = 1; s <= max_lobatto_degree; ++s)
          for (unsigned int p = 1; p <= s; ++p)
            table[s][p] = CarryingNodes(s, p);
        return table;
      }();
      return all[lattice][degree];
    }

    class NodalLines : public ConformityLines
    {
    public:
      NodalLines(const DoFHandler<3> &dof_handler, const EntityDegrees &degrees)
        : ConformityLines(dof_handler, degrees)
      {
        for (unsigned int p = 0; p <= max_lobatto_degree; ++p)
          points.push_back(p == 0 ? Coordinates() : lobatto_points(p));
      }

    private:
      void
      constrain_hanging_line(const CellIterator &cell,
                             const unsigned int  l,
                             const unsigned int  half,
                             const CellIterator &coarse,
                             const unsigned int  coarse_line) override
      {
        degrees.get_master_dofs(coarse, masters);
        const unsigned int p = cell->get_fe().degree;
        for (unsigned int i = 0; i <= p; ++i)
          if (i != half && start_line(own[on_line(cell, l, i)]))
            {
              add_on_line(coarse, coarse_line, (half + points[p][i]) / 2., 1.);
              combine();
            }
      }

      void
      constrain_hanging_face(const HangingFace &at) override
      {
        degrees.get_master_dofs(at.coarse, masters);
        const unsigned int p = at.cell->get_fe().degree;
        for (unsigned int j = 0; j <= p; ++j)
          for (unsigned int i = 0; i <= p; ++i)
            if (!(i == at.half[0] && j == at.half[1]) &&
                start_line(own[on_face(at.cell, at.face, i, j)]))
              {
                const double x = (at.half[0] + points[p][i]) / 2.,
                             y = (at.half[1] + points[p][j]) / 2.;
                add_on_face(at.coarse,
                            at.coarse_face,
                            at.transposed ? y : x,
                            at.transposed ? x : y);
                combine();
              }
      }

      void
      constrain_mixed_degrees(const CellIterator &cell) override
      {
        degrees.get_master_dofs(cell, masters);
        const unsigned int p      = cell->get_fe().degree;
        const auto         starts = [&](const unsigned int i) {
          return masters[i] != own[i] && start_line(own[i]);
        };
        for (const unsigned int v : cell->vertex_indices())
          if (starts(v))
            entries().emplace_back(masters[v], 1.);
        for (const unsigned int l : cell->line_indices())
          for (unsigned int i = 2; i <= p; ++i)
            if (starts(on_line(cell, l, i)))
              {
                add_on_line(cell, l, points[p][i], 1.);
                combine();
              }
        for (const unsigned int f : cell->face_indices())
          for (unsigned int j = 2; j <= p; ++j)
            for (unsigned int i = 2; i <= p; ++i)
              if (starts(on_face(cell, f, i, j)))
                {
                  add_on_face(cell, f, points[p][i], points[p][j]);
                  combine();
                }
      }

      /// Local index of node @p i, ends first, of line @p l.
      unsigned int
      on_line(const CellIterator &cell,
              const unsigned int  l,
              const unsigned int  i) const
      {
        if (i < 2)
          return line_dof(cell, l, i);
        const auto &place =
          carrying_nodes(cell->get_fe().degree, degrees.line_degree(cell, l))
            .place;
        return line_dof(cell, l, 2 + place[i - 2]);
      }

      /// The same on face @p f along the directions of face_dof_indices().
      unsigned int
      on_face(const CellIterator &cell,
              const unsigned int  f,
              const unsigned int  i,
              const unsigned int  j) const
      {
        if (i < 2)
          return on_line(cell, GeometryInfo<3>::face_to_cell_lines(f, i), j);
        if (j < 2)
          return on_line(cell,
                         GeometryInfo<3>::face_to_cell_lines(f, 2 + j),
                         i);
        const auto &place =
          carrying_nodes(cell->get_fe().degree, degrees.quad_degree(cell, f))
            .place;
        return face_dof(cell, f, 2 + place[i - 2], 2 + place[j - 2]);
      }

      /// The value at @p x of line @p l of @p cell, whose masters are in masters, to the entries
      /// of the line that was started last.
      void
      add_on_line(const CellIterator &cell,
                  const unsigned int  l,
                  const double        x,
                  const double        weight)
      {
        const auto values =
          lagrange_at(carrying_nodes(degrees.line_lattice(cell, l),
                                     degrees.line_degree(cell, l))
                        .points,
                      x);
        for (unsigned int k = 0; k < values.size(); ++k)
          add(masters[line_dof(cell, l, k)], weight * values[k]);
      }

      void
      add_on_face(const CellIterator &cell,
                  const unsigned int  f,
                  const double        x,
                  const double        y)
      {
        const Coordinates &at = carrying_nodes(degrees.quad_lattice(cell, f),
                                               degrees.quad_degree(cell, f))
                                  .points;
        const auto along_x = lagrange_at(at, x), along_y = lagrange_at(at, y);
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int k = 0; k < at.size(); ++k)
            add_on_line(cell,
                        GeometryInfo<3>::face_to_cell_lines(f, i),
                        at[k],
                        along_x[i] * along_y[k]);
        for (unsigned int k = 2; k < at.size(); ++k)
          {
            for (unsigned int j = 0; j < 2; ++j)
              add_on_line(cell,
                          GeometryInfo<3>::face_to_cell_lines(f, 2 + j),
                          at[k],
                          along_x[k] * along_y[j]);
            for (unsigned int m = 2; m < at.size(); ++m)
              add(masters[face_dof(cell, f, k, m)], along_x[k] * along_y[m]);
          }
      }

      void
      add(const Index master, const double weight)
      {
        // what should be zero is so, but for nodes of a child that are on one
        // of its parent's by rounding
        if (std::fabs(weight) > 1e-15)
          entries().emplace_back(master, weight);
      }

      /// Each index once.
      void
      combine()
      {
        std::map<Index, double> sums;
        for (const auto &[index, weight] : entries())
          sums[index] += weight;
        entries().assign(sums.begin(), sums.end());
      }

      std::vector<Coordinates> points; ///< by degree
      std::vector<Index>       masters;
    };
  } // namespace

  void
  get_nodes(const EntityDegrees::CellIterator    &cell,
            const EntityDegrees                  &degrees,
            std::vector<types::global_dof_index> &nodes)
  {
    const FiniteElement<3> &fe = cell->get_fe();
    const unsigned int      p  = fe.degree;
    nodes.resize(fe.n_dofs_per_cell());
    cell->get_dof_indices(nodes);
    if (degrees.one_degree())
      return;
    std::vector<types::global_dof_index> own;
    for (const unsigned int l : cell->line_indices())
      if (const unsigned int degree = degrees.line_degree(cell, l); degree < p)
        {
          const auto first =
            nodes.begin() + fe.get_first_line_index() + l * (p - 1);
          const auto &place = carrying_nodes(p, degree).place;
          own.assign(first, first + p - 1);
          for (unsigned int i = 0; i < p - 1; ++i)
            first[i] = own[place[i]];
        }
    for (const unsigned int f : cell->face_indices())
      if (const unsigned int degree = degrees.quad_degree(cell, f); degree < p)
        {
          const auto  first = nodes.begin() + fe.get_first_quad_index(f);
          const auto &place = carrying_nodes(p, degree).place;
          own.assign(first, first + (p - 1) * (p - 1));
          for (unsigned int j = 0; j < p - 1; ++j)
            for (unsigned int i = 0; i < p - 1; ++i)
              first[i + (p - 1) * j] = own[place[i] + (p - 1) * place[j]];
        }
  }

  void
  make_nodal_constraints(const DoFHandler<3>       &dof_handler,
                         const EntityDegrees       &degrees,
                         AffineConstraints<double> &constraints)
  {
    NodalLines(dof_handler, degrees).make(constraints);
  }
} // namespace mortise
