// The part of nodal_conformity.h on tetrahedra.
#include <mortise/body/elements/simplex_elements.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/body/spaces/conformity_lines.h>
#include <mortise/body/spaces/nodal_conformity.h>

#include <array>
#include <cmath>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The nodes of one degree by ascending vertices.
    struct SimplexLattice
    {
      explicit SimplexLattice(const unsigned int degree)
        : sets(sets_of_functions(degree))
      {
        for (unsigned int i = sets.size(); i-- > 0;)
          first[sets[i]] = i;
      }

      /// Number of a node among those of its line, face or cell.
      unsigned int
      place(const unsigned int node) const
      {
        return node - first[sets[node]];
      }

      std::vector<VertexSet>           sets;    ///< by node
      std::array<unsigned int, 1 << 4> first{}; ///< by set
    };

    class SimplexNodalLines : public ConformityLines
    {
    public:
      using ConformityLines::ConformityLines;

    private:
      void
      constrain_hanging_line(const CellIterator &,
                             unsigned int,
                             unsigned int,
                             const CellIterator &,
                             unsigned int) override
      {
        Assert(false, ExcInternalError());
      }

      void
      constrain_hanging_face(const HangingFace &) override
      {
        Assert(false, ExcInternalError());
      }

      void
      constrain_mixed_degrees(const CellIterator &cell) override
      {
        const unsigned int p     = cell->get_fe().degree;
        const auto        &order = SimplexElements::base(cell->get_fe()).order;
        const auto         dofs  = ascending_dof_indices(p, order);
        std::vector<Index> local;
        degrees.get_master_dofs(cell, local);
        masters.clear();
        for (const unsigned int i : dofs)
          masters.push_back(local[i]);
        find_degrees(cell, order);
        degree_of_cell                = p;
        const SimplexLattice &lattice = lattice_of(p);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if ((degree_of_set[lattice.sets[i]] < p ||
               masters[i] != own[dofs[i]]) &&
              start_line(own[dofs[i]]))
            {
              sums.clear();
              add(i, p, 1.);
              entries().assign(sums.begin(), sums.end());
            }
      }

      /// By set of ascending vertices.
      void
      find_degrees(const CellIterator &cell, const VertexOrder &order)
      {
        VertexOrder ascending; // by local vertex
        for (unsigned int v = 0; v < 4; ++v)
          ascending[order[v]] = v;
        const auto bits = [&](const auto &vertices) {
          VertexSet set = 0;
          for (const unsigned int v : vertices)
            set |= 1u << ascending[v];
          return set;
        };
        degree_of_set.fill(cell->get_fe().degree);
        for (unsigned int l = 0; l < 6; ++l)
          degree_of_set[bits(tetrahedron_lines[l])] =
            degrees.line_degree(cell, l);
        for (unsigned int f = 0; f < 4; ++f)
          degree_of_set[bits(tetrahedron_faces[f])] =
            degrees.quad_degree(cell, f);
      }

      /// The value at node @p i of those of degree @p q, by what carries it, times @p weight.
      void
      add(const unsigned int i, const unsigned int q, const double weight)
      {
        const SimplexLattice &lattice = lattice_of(q);
        const VertexSet       set     = lattice.sets[i];
        const unsigned int    d       = degree_of_set[set];
        if (i < 4 || d == q)
          {
            sums[masters[lattice_of(degree_of_cell).first[set] +
                         lattice.place(i)]] += weight;
            return;
          }
        const FullMatrix<double> &values = nodal_values(q, d);
        for (unsigned int k = 0; k < values.n(); ++k)
          if ((lattice_of(d).sets[k] & ~set) == 0 &&
              std::fabs(values(i, k)) > 1e-15)
            add(k, d, weight * values(i, k));
      }

      const SimplexLattice &
      lattice_of(const unsigned int degree)
      {
        return lattices.try_emplace(degree, degree).first->second;
      }

      /// Of the polynomials of degree @p d at the nodes of degree @p q.
      const FullMatrix<double> &
      nodal_values(const unsigned int q, const unsigned int d)
      {
        auto &values = tables[{q, d}];
        if (values.m() == 0)
          values = simplex_nodal_values(d, simplex_nodes(q));
        return values;
      }

      std::map<unsigned int, SimplexLattice> lattices; ///< by degree
      std::map<std::pair<unsigned int, unsigned int>, FullMatrix<double>>
        tables; ///< see nodal_values()
      /// Of the cell at hand, by function with ascending vertices.
      std::vector<Index>               masters;
      unsigned int                     degree_of_cell = 1;
      std::array<unsigned int, 1 << 4> degree_of_set{};
      std::map<Index, double>          sums;
    };
  } // namespace

  void
  make_simplex_nodal_constraints(const DoFHandler<3>       &dof_handler,
                                 const EntityDegrees       &degrees,
                                 AffineConstraints<double> &constraints)
  {
    SimplexNodalLines(dof_handler, degrees).make(constraints);
  }
} // namespace mortise
