// The rows of the constraint by component, MultiplierSpace::component_rows().
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/multiplier_space.h>
#include <mortise/mortar/slave_frames.h>

#include <algorithm>
#include <array>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = MultiplierSpace::Index;
    using ByDof = LinearAlgebra::distributed::Vector<double>;

    /// The rows of slave faces whose bodies slide: three for each node. Nodes
    /// that faces share are numbered with their dofs; those that hang, where
    /// degrees meet, or whose face has along_normals, by face.
    class RowsOfNodes
    {
    public:
      /// @p directed: has each component entries of its own?
      RowsOfNodes(const Body                                          &body,
                  const BodySurface                                   &slave,
                  const std::vector<MultiplierSpace::FaceMultipliers> &by_face,
                  const bool                                           directed)
        : numbers(body.dof_handler.locally_owned_dofs(),
                  body.relevant_dofs,
                  body.triangulation().get_communicator())
        , directed(directed)
      {
        for (unsigned int s = 0; s < slave.faces.size(); ++s)
          {
            dofs.push_back(face_dofs(slave.cells[s], slave.face_numbers[s]));
            shared.push_back(
              by_face[s].along_normals.empty() ?
                have_shared_nodes(slave.traces[s].basis(), dofs[s][0], body) :
                std::vector<bool>(dofs[s][0].size(), false));
            for (unsigned int k = 0; k < shared[s].size(); ++k)
              for (unsigned int c = 0; c < dim && shared[s][k]; ++c)
                numbers(dofs[s][c][k]) = 1. + c;
          }
        numbers.compress(VectorOperation::max);
      }

      unsigned int
      n_owned() const
      {
        unsigned int result =
          std::count_if(numbers.begin(), numbers.end(), [](const double value) {
            return value > 0.;
          });
        for (const auto &of_face : shared)
          result += dim * std::count(of_face.begin(), of_face.end(), false);
        return result;
      }

      /// From @p first on. Collective.
      void
      number(const Index first)
      {
        Index next = first;
        for (double &value : numbers)
          if (value > 0.)
            {
              add_owned(first, static_cast<unsigned int>(value) - 1);
              value = next++;
            }
        numbers.update_ghost_values();
        for (unsigned int s = 0; s < shared.size(); ++s)
          {
            rows.emplace_back();
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int k = 0; k < shared[s].size(); ++k)
                if (shared[s][k])
                  rows[s].push_back(static_cast<Index>(numbers(dofs[s][c][k])));
                else
                  {
                    rows[s].push_back(next++);
                    add_owned(first, c);
                  }
          }
      }

      /// By face: component c of node k at c n + k.
      std::vector<std::vector<Index>> rows;
      /// Components have the entries of the first.
      std::vector<CouplingMatrix::Row> owned;

    private:
      /// The next row is one of component @p c; those of an entity come by
      /// component.
      void
      add_owned(const Index first, const unsigned int c)
      {
        const unsigned int n = owned.size();
        if (c == 0 && (n == 0 || owned.back().component > 0))
          entity = n;
        if (c == 0)
          n_nodes = n + 1 - entity;
        owned.push_back(
          {first + (directed ? n : entity + (n - entity) % n_nodes), c});
      }

      std::vector<std::array<std::vector<Index>, dim>> dofs;   ///< by face
      std::vector<std::vector<bool>>                   shared; ///< likewise
      ByDof                                            numbers;
      const bool                                       directed;
      /// Of the entity that add_owned() is in: its first row, its nodes.
      unsigned int entity = 0, n_nodes = 0;
    };
  } // namespace

  namespace
  {
    /// The rows of @p rows by face. @p have_own_entries: each component?
    std::vector<MultiplierSpace::FaceMultipliers>
    by_face(const RowsOfNodes &rows, const bool have_own_entries)
    {
      std::vector<MultiplierSpace::FaceMultipliers> result;
      for (const std::vector<Index> &of_face : rows.rows)
        {
          MultiplierSpace::FaceMultipliers &face = result.emplace_back();
          const unsigned int                n    = of_face.size() / dim;
          face.begin                             = {0};
          face.frames.assign(n, Frame(unit_symmetric_tensor<dim>()));
          for (unsigned int r = 0; r < dim * n; ++r)
            {
              face.index.push_back(of_face[r]);
              face.weight.push_back(1.);
              face.is_represented.push_back(r >= n && !have_own_entries);
              face.begin.push_back(r + 1);
            }
        }
      return result;
    }
  } // namespace

  unsigned int
  MultiplierSpace::n_component_rows(const BodySurface &slave) const
  {
    const bool is_tie = n_directions == dim && !directed;
    if (is_tie && !turn)
      return n_owned();
    const unsigned int n =
      RowsOfNodes(body, slave, numbered.by_face, directed).n_owned();
    return is_tie ? n_owned() + n : n_directions == dim ? 2 * n : n;
  }

  void
  MultiplierSpace::add_turned_masters(const BodySurface &slave,
                                      const Index        first,
                                      ComponentRows     &rows) const
  {
    RowsOfNodes of_nodes(body, slave, numbered.by_face, false);
    of_nodes.number(first + n_owned());
    rows.rows.owned.insert(rows.rows.owned.end(),
                           of_nodes.owned.begin(),
                           of_nodes.owned.end());
    rows.across = by_face(of_nodes, false);
    for (unsigned int s = 0; s < numbered.by_face.size(); ++s)
      {
        const FaceMultipliers &own = numbered.by_face[s];
        const unsigned int     n   = own.n_nodes();
        for (unsigned int r = 0; r + 1 < own.begin.size(); ++r)
          for (unsigned int e = own.begin[r]; e < own.begin[r + 1]; ++e)
            for (unsigned int c = 0; c < dim; ++c)
              rows.frames.emplace_back(own.index[e],
                                       of_nodes.rows[s][c * n + r % n],
                                       own.weight[e] * (*turn)[r / n][c]);
      }
  }

  MultiplierSpace::ComponentRows
  MultiplierSpace::component_rows(const BodySurface &slave,
                                  const Index        first) const
  {
    ComponentRows result;
    if (n_directions == dim && !directed)
      {
        result.rows = make_rows(slave, first);
        for (unsigned int i = 0; i < n_owned(); ++i)
          result.frames.emplace_back(first_number + i, first + i, 1.);
        if (turn)
          add_turned_masters(slave, first, result);
        return result;
      }
    const bool  has_across = n_directions == dim;
    RowsOfNodes of_nodes(body, slave, numbered.by_face, directed),
      across(body, slave, numbered.by_face, false);
    of_nodes.number(first);
    result.rows.owned   = of_nodes.owned;
    result.rows.by_face = by_face(of_nodes, directed);
    if (has_across)
      {
        across.number(first + of_nodes.owned.size());
        result.rows.owned.insert(result.rows.owned.end(),
                                 across.owned.begin(),
                                 across.owned.end());
        result.across = by_face(across, false);
      }
    for (unsigned int s = 0; s < numbered.by_face.size(); ++s)
      {
        const FaceMultipliers                    &own = numbered.by_face[s];
        const unsigned int                        n   = own.n_nodes();
        std::map<std::pair<Index, Index>, double> of_face;
        const Tensor<1, dim>                      ones({1., 1., 1.});
        for (unsigned int r = 0; r + 1 < own.begin.size(); ++r)
          own.for_each_direction(
            r, [&](const unsigned int i, const Tensor<1, dim> &direction) {
              Tensor<1, dim> along = directed ? ones : direction, rest;
              if (has_across)
                {
                  const double part = normals[s][i] * direction;
                  along             = part * ones;
                  rest              = direction - part * normals[s][i];
                }
              for (unsigned int e = own.begin[r]; e < own.begin[r + 1]; ++e)
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    of_face[{own.index[e], of_nodes.rows[s][c * n + i]}] +=
                      own.weight[e] * along[c];
                    if (has_across)
                      of_face[{own.index[e], across.rows[s][c * n + i]}] +=
                        own.weight[e] * rest[c];
                  }
            });
        for (const auto &[place, weight] : of_face)
          result.frames.emplace_back(place.first, place.second, weight);
      }
    return result;
  }
} // namespace mortise
