// The penalties of the interfaces on one level, make_jump_penalties().
#include <mortise/mortar/nodal_block.h>
#include <mortise/operators/levels/multigrid_level.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// With this factor gamma is 0.7 E p^2 / h on all levels below the finest,
    /// as large as entries of the diagonal of K: iterations for p = 2, 4, 6, 8
    /// on the thick sphere are 9, 10, 15, 16 with half of it, 8, 9, 15, 17 with
    /// it or twice as much.
    constexpr double jump_penalty = 0.4;

    /// Those that have a penalty across the normals as well as along them, or
    /// along them on top of that.
    struct Couplings
    {
      bool                          along_normals;
      std::vector<const Coupling *> all;

      double
      penalty(const Coupling    &coupling,
              const unsigned int s,
              const double       of_tie) const
      {
        const LocalCoupling &local = coupling.local[s];
        // the square of the fraction, since what is tied at points alone hardly
        // holds coarse functions: doc/measurements/active_sets.md
        const InterfaceStiffness result =
          coupling.law.penalty({of_tie * std::pow(local.active_fraction, 2),
                                of_tie * std::pow(local.sticking_fraction, 2)},
                               local.springs);
        return along_normals ? result.normal - result.tangential :
                               result.tangential;
      }
    };

    /// Calls visit(row trace, column trace, block, factor) for the blocks of
    /// the penalty.
    template <typename Visit>
    void
    for_each_block(const Couplings &couplings, const Visit &visit)
    {
      for (const Coupling *const one : couplings.all)
        for (unsigned int s = 0; s < one->local.size(); ++s)
          if (const LocalCoupling &local = one->local[s];
              !local.partners.empty())
            {
              const Coupling  &coupling = *one;
              const FaceTrace &slave    = coupling.interface->slave().traces[s];
              const double     gamma =
                couplings.penalty(coupling,
                                  s,
                                  jump_penalty * local.penalty * slave.degree *
                                    slave.degree);
              visit(slave, slave, local.mass, gamma);
              for (const auto &partner : local.partners)
                {
                  const FaceTrace &master =
                    coupling.interface->master_traces()[partner.master];
                  visit(slave, master, partner.mixed, -gamma);
                  visit(master, master, partner.mass, gamma);
                }
            }
    }
    using Indices = std::vector<unsigned int>;
    using Layout  = Utilities::MPI::Partitioner;

    void
    make_unique(Indices &list)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }

    /// First components at the nodes of a face.
    Indices
    indices_on(const Layout      &layout,
               const FaceTrace   &trace,
               const unsigned int number)
    {
      Indices indices;
      for (const auto node : trace.nodes[number].nodes)
        indices.push_back(layout.global_to_local(dim * node));
      return indices;
    }

    /// By node: with which others the interfaces couple it.
    std::vector<Indices>
    coupled_indices(const Layout      &layout,
                    const unsigned int number,
                    const Couplings   &couplings)
    {
      std::vector<Indices> columns(
        (layout.locally_owned_size() + layout.n_ghost_indices()) / dim);
      const auto record = [&](const Indices &rows, const Indices &more) {
        for (const unsigned int row : rows)
          {
            auto &list = columns[row / dim];
            list.insert(list.end(), more.begin(), more.end());
            if (list.size() > 4096)
              make_unique(list);
          }
      };
      for_each_block(couplings,
                     [&](const FaceTrace &row,
                         const FaceTrace &column,
                         const auto &,
                         const double) {
                       const Indices rows = indices_on(layout, row, number),
                                     more = indices_on(layout, column, number);
                       record(rows, more);
                       if (&row != &column)
                         record(more, rows);
                     });
      for (Indices &list : columns)
        make_unique(list);
      return columns;
    }

    /// Adds to the entries of a penalty.
    class PenaltyEntries
    {
    public:
      /// Nodes with the same @p columns become a group.
      PenaltyEntries(std::vector<Indices> columns, JumpPenalty &penalty)
        : penalty(penalty)
        , index_of_node(columns.size())
      {
        std::map<Indices, unsigned int> group_of_columns;
        for (unsigned int node = 0; node < columns.size(); ++node)
          if (auto &list = columns[node]; !list.empty())
            {
              const auto [found, is_new] =
                group_of_columns.emplace(list, penalty.groups.size());
              if (is_new)
                penalty.groups.push_back({{}, list, {}});
              auto &group         = penalty.groups[found->second];
              index_of_node[node] = {found->second, group.rows.size()};
              group.rows.push_back(dim * node);
              list = Indices();
            }
        for (auto &group : penalty.groups)
          group.values.resize(group.rows.size() * group.columns.size());
      }

      void
      add(const unsigned int row, const unsigned int column, const double value)
      {
        const auto [g, r] = index_of_node[row / dim];
        auto &group       = penalty.groups[g];
        group.values[r * group.columns.size() +
                     (std::lower_bound(
                        group.columns.begin(), group.columns.end(), column) -
                      group.columns.begin())] += value;
      }

    private:
      JumpPenalty &penalty;
      /// Group and row in it.
      std::vector<std::pair<unsigned int, unsigned int>> index_of_node;
    };

    JumpPenalty
    make_penalty(const Layout      &layout,
                 const unsigned int number,
                 const Couplings   &couplings)
    {
      JumpPenalty    penalty;
      PenaltyEntries entries(coupled_indices(layout, number, couplings),
                             penalty);
      for_each_block(
        couplings,
        [&](const FaceTrace          &row,
            const FaceTrace          &column,
            const FullMatrix<double> &modal,
            const double              factor) {
          const FaceNodes &on_rows       = row.nodes[number],
                          &on_columns    = column.nodes[number];
          const FullMatrix<double> nodal = resolve_hanging(
            nodal_block(modal,
                        {row.shape, row.degree, on_rows.degree},
                        {column.shape, column.degree, on_columns.degree}),
            on_rows,
            on_columns);
          const Indices rows = indices_on(layout, row, number),
                        more = indices_on(layout, column, number);
          for (unsigned int i = 0; i < rows.size(); ++i)
            for (unsigned int j = 0; j < more.size(); ++j)
              {
                entries.add(rows[i], more[j], factor * nodal(i, j));
                if (&row != &column)
                  entries.add(more[j], rows[i], factor * nodal(i, j));
              }
        });
      return penalty;
    }

    /// Calls visit(trace, face, sign) for the pairs of @p coupling, for the slave
    /// with sign 1 and for the master with -1.
    template <typename Visit>
    void
    for_each_side(const Coupling &coupling, const Visit &visit)
    {
      const InterfaceHandler &interface = *coupling.interface;
      for (unsigned int s = 0; s < coupling.local.size(); ++s)
        for (const auto &partner : coupling.local[s].partners)
          {
            visit(interface.slave().traces[s], interface.slave().faces[s], 1.);
            visit(interface.master_traces()[partner.master],
                  interface.master_faces()[partner.master],
                  -1.);
          }
    }

    /// Parts of @p couplings in which no node belongs to two: around an edge of a
    /// body each interface has a normal of its own.
    std::vector<Couplings>
    split_by_normals(const unsigned int number, const Couplings &couplings)
    {
      std::vector<Couplings>                         parts;
      std::vector<std::set<types::global_dof_index>> taken;
      for (const Coupling *coupling : couplings.all)
        {
          std::set<types::global_dof_index> nodes;
          for_each_side(*coupling,
                        [&](const FaceTrace &trace, const auto &, double) {
                          const auto &of_face = trace.nodes[number].nodes;
                          nodes.insert(of_face.begin(), of_face.end());
                        });
          const auto is_taken = [&](const auto &by) {
            return std::any_of(nodes.begin(),
                               nodes.end(),
                               [&](const auto node) {
                                 return by.count(node) > 0;
                               });
          };
          const unsigned int part =
            std::find_if_not(taken.begin(), taken.end(), is_taken) -
            taken.begin();
          if (part == parts.size())
            {
              parts.push_back({couplings.along_normals, {}});
              taken.emplace_back();
            }
          parts[part].all.push_back(coupling);
          taken[part].insert(nodes.begin(), nodes.end());
        }
      return parts;
    }

    /// Directions at the nodes of a face, @p sign times its outward normals.
    void
    add_normals(const Layout                &layout,
                const FaceTrace             &trace,
                const FaceNodes             &on_face,
                const SurfaceFace           &face,
                const double                 sign,
                std::vector<Tensor<1, dim>> &normals)
    {
      const auto points = face_nodes(trace.shape, on_face.degree);
      const auto add    = [&](const types::global_dof_index node,
                           const unsigned int            k,
                           const double                  weight) {
        normals[layout.global_to_local(dim * node) / dim] +=
          sign * weight * averaged_normal(face, points[k]);
      };
      for (unsigned int k = 0; k < points.size(); ++k)
        if (!on_face.hang())
          add(on_face.nodes[k], k, 1.);
        else
          for (unsigned int e = on_face.begin[k]; e < on_face.begin[k + 1]; ++e)
            add(on_face.nodes[on_face.column[e]], k, on_face.weight[e]);
    }

    /// By node that the interfaces couple, of one length.
    std::vector<Tensor<1, dim>>
    nodal_normals(const Layout      &layout,
                  const unsigned int number,
                  const Couplings   &couplings)
    {
      std::vector<Tensor<1, dim>> normals(
        (layout.locally_owned_size() + layout.n_ghost_indices()) / dim);
      for (const Coupling *coupling : couplings.all)
        for_each_side(*coupling,
                      [&](const FaceTrace   &trace,
                          const SurfaceFace &face,
                          const double       sign) {
                        add_normals(layout,
                                    trace,
                                    trace.nodes[number],
                                    face,
                                    sign,
                                    normals);
                      });
      for (auto &normal : normals)
        if (const double length = normal.norm(); length > 0.)
          normal /= length;
      return normals;
    }
    /// By node of a coupling whose master is turned: the direction of component
    /// @p d of the slave, and that which Q turns to it; none on the axis.
    std::vector<Tensor<1, dim>>
    turned_directions(const Layout      &layout,
                      const unsigned int number,
                      const Coupling    &coupling,
                      const unsigned int d)
    {
      std::vector<Tensor<1, dim>> directions(
        (layout.locally_owned_size() + layout.n_ghost_indices()) / dim);
      std::vector<bool> of_slave(directions.size(), false), of_master(of_slave);
      Tensor<1, dim>    on_slave;
      const Tensor<1, dim> on_master = coupling.placement.rotation[d];
      on_slave[d]                    = 1.;
      for_each_side(
        coupling, [&](const FaceTrace &trace, const auto &, const double sign) {
          for (const unsigned int index : indices_on(layout, trace, number))
            {
              directions[index / dim] = sign > 0. ? on_slave : on_master;
              (sign > 0. ? of_slave : of_master)[index / dim] = true;
            }
        });
      for (unsigned int i = 0; i < directions.size(); ++i)
        if (of_slave[i] && of_master[i])
          directions[i] = Tensor<1, dim>();
      return directions;
    }
  } // namespace

  std::shared_ptr<const JumpPenalties>
  make_jump_penalties(const MultigridLevel        &level,
                      const unsigned int           number,
                      const std::vector<Coupling> &couplings)
  {
    JumpPenalties penalties{interface_layout(level, number, couplings), {}};
    const Layout &layout = *penalties.layout;
    for (const bool along_normals : {false, true})
      {
        Couplings of_kind{along_normals, {}};
        for (const Coupling &coupling : couplings)
          if (coupling.is_turned)
            {
              for (unsigned int d = 0; d < dim && !along_normals; ++d)
                {
                  penalties.parts.push_back(
                    make_penalty(layout, number, {false, {&coupling}}));
                  penalties.parts.back().normals =
                    turned_directions(layout, number, coupling, d);
                }
            }
          else if (along_normals ?
                     coupling.law.is_compliant() ||
                       coupling.law.has_friction() ||
                       coupling.law.constrained ==
                         ConstrainedDirections::normal :
                     coupling.law.constrained == ConstrainedDirections::all)
            of_kind.all.push_back(&coupling);
        if (!along_normals && !of_kind.all.empty())
          penalties.parts.push_back(make_penalty(layout, number, of_kind));
        if (along_normals)
          for (const Couplings &part : split_by_normals(number, of_kind))
            {
              penalties.parts.push_back(make_penalty(layout, number, part));
              penalties.parts.back().normals =
                nodal_normals(layout, number, part);
            }
      }
    return std::make_shared<const JumpPenalties>(std::move(penalties));
  }
} // namespace mortise
