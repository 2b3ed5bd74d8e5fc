#include <mortise/mortar/coupling.h>
#include <mortise/mortar/nodal_block.h>
#include <mortise/mortar/row_assembler.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    Expansion
    component(const FaceTrace &trace, const unsigned int c)
    {
      return {trace.begin, trace.column, trace.weight, c * trace.n_functions()};
    }

    /// The columns of one side of the constraint: hierarchical functions, or
    /// nodal ones where the trace has nodes. Prescribed ones are among them
    /// where nodes hang.
    class ConstraintColumns
    {
    public:
      explicit ConstraintColumns(const FaceTrace &trace)
        : trace(trace)
        , begin(1)
      {
        if (trace.nodes.empty())
          return;
        const FaceNodes &face = trace.nodes[0];
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int k = 0; k < trace.n_functions(); ++k)
            {
              const unsigned int row = c * trace.n_functions() + k;
              if (face.hang())
                for (unsigned int e = face.begin[k]; e < face.begin[k + 1]; ++e)
                  add(face.nodes[face.column[e]], c, face.weight[e]);
              // what holds a mode holds the node in its place
              else if (trace.begin[row + 1] > trace.begin[row])
                add(face.nodes[k], c, 1.);
              begin.push_back(index.size());
            }
      }

      bool
      are_nodal() const
      {
        return !trace.nodes.empty();
      }

      Expansion
      component(const unsigned int c) const
      {
        if (trace.nodes.empty())
          return mortise::component(trace, c);
        return {begin, index, weight, c * trace.n_functions()};
      }

      /// @p local with its columns in these functions.
      FullMatrix<double>
      in_columns(const FullMatrix<double> &local) const
      {
        return trace.nodes.empty() ?
                 local :
                 nodal_block(local,
                             {trace.shape, trace.degree, 0},
                             {trace.shape, trace.degree, trace.degree});
      }

    private:
      void
      add(const Index node, const unsigned int c, const double factor)
      {
        index.push_back(dim * node + c);
        weight.push_back(factor);
      }

      const FaceTrace          &trace;
      std::vector<unsigned int> begin;
      std::vector<Index>        index;
      std::vector<double>       weight;
    };

    Expansion
    component(const MultiplierSpace::FaceRows &rows, const unsigned int c)
    {
      const unsigned int n = (rows.begin.size() - 1) / dim;
      return {rows.begin, rows.index, rows.weight, c * n};
    }

    /// The prescribed displacements of one side.
    class PrescribedTrace
    {
    public:
      explicit PrescribedTrace(const FaceTrace &trace)
        : n_functions(trace.n_functions())
        , begin(1)
      {
        for (const Index dof : trace.prescribed)
          {
            if (dof != numbers::invalid_dof_index)
              index.push_back(dof);
            begin.push_back(index.size());
          }
        weight.assign(index.size(), 1.);
      }

      bool
      are_nodal() const
      {
        return false;
      }

      Expansion
      component(const unsigned int c) const
      {
        return {begin, index, weight, c * n_functions};
      }

      const FullMatrix<double> &
      in_columns(const FullMatrix<double> &local) const
      {
        return local;
      }

    private:
      unsigned int              n_functions;
      std::vector<unsigned int> begin;
      std::vector<Index>        index;
      std::vector<double>       weight;
    };

    /// Calls visit(nodes) for the vertices, the edges and the inside of a face.
    template <typename Visit>
    void
    for_each_entity(const TraceBasis &basis, const Visit &visit)
    {
      std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>>
        entities;
      for (unsigned int k = 0; k < basis.size(); ++k)
        entities[{basis.functions[k].dimension, basis.functions[k].entity}]
          .push_back(k);
      for (const auto &entity : entities)
        visit(entity.second);
    }

    bool
    has_columns(const FaceTrace &trace, const unsigned int c)
    {
      const Expansion dofs = component(trace, c);
      return dofs.begin[dofs.offset + trace.n_functions()] >
             dofs.begin[dofs.offset];
    }

    /// Faces belong to one boundary each.
    bool
    have_same_slave(const Coupling &a, const Coupling &b)
    {
      const BodySurface &first  = a.interface->slave(),
                        &second = b.interface->slave();
      return !first.faces.empty() &&
             first.faces.size() == second.faces.size() &&
             first.cells[0] == second.cells[0] &&
             first.face_numbers[0] == second.face_numbers[0];
    }

    /// Does interface @p a have more of slave face @p s than @p b? Of halves, the first by name
    /// counts as more.
    bool
    goes_in_front(const Coupling &a, const Coupling &b, const unsigned int s)
    {
      constexpr double rounding = 1e-6;
      const double     difference =
        a.interface->coverage()[s] - b.interface->coverage()[s];
      return std::fabs(difference) > rounding ?
               difference > 0. :
               a.interface->name() < b.interface->name();
    }

    /// Calls visit(slave trace, rows, local) for each slave face with a
    /// partner.
    template <typename Visit>
    void
    for_each_face(const std::vector<Coupling> &couplings, const Visit &visit)
    {
      for (const Coupling &coupling : couplings)
        for (unsigned int s = 0; s < coupling.local.size(); ++s)
          if (!coupling.local[s].partners.empty())
            visit(coupling, s);
    }
  } // namespace

  std::vector<std::vector<PartnerState>>
  partner_states(const std::vector<Coupling> &couplings)
  {
    std::vector<std::vector<PartnerState>> all;
    for (const Coupling &coupling : couplings)
      {
        std::vector<const Coupling *> sharing;
        for (const Coupling &other : couplings)
          if (&other != &coupling && have_same_slave(coupling, other))
            sharing.push_back(&other);
        all.emplace_back();
        for (unsigned int s = 0; s < coupling.local.size(); ++s)
          {
            const double covered = coupling.interface->coverage()[s];
            PartnerState state   = {cover_of(covered, true), {}};
            for (const Coupling *other : sharing)
              if (goes_in_front(*other, coupling, s))
                state.cover = cover_of(covered, false);
            const auto find_free = [&](const FaceTrace &trace) {
              for (unsigned int c = 0; c < dim; ++c)
                state.can_follow[c] |= has_columns(trace, c);
            };
            find_free(coupling.interface->slave().traces[s]);
            for (const auto &partner : coupling.local[s].partners)
              find_free(coupling.interface->master_traces()[partner.master]);
            all.back().push_back(state);
          }
      }
    return all;
  }

  namespace
  {
    /// [D, -M] with the columns that @p Columns makes of a trace.
    template <typename Columns>
    void
    assemble_blocks(const std::vector<Coupling> &couplings,
                    const CouplingPartition     &partition,
                    SparseMatrix                &matrix)
    {
      RowAssembler assembler(partition.owned_multiplier,
                             partition.owned_displacement);
      // Calls visit(row expansion, its size, column expansion, its size, block,
      // factor) for all blocks.
      const auto for_each_block = [&](const bool values, const auto &visit) {
        for_each_face(
          couplings, [&](const Coupling &coupling, const unsigned int s) {
            const auto          &rows  = coupling.multipliers->rows()[s];
            const LocalCoupling &local = coupling.local[s];
            const FaceTrace     &slave = coupling.interface->slave().traces[s];
            const Columns        own(slave);
            if (local.is_dual() && own.are_nodal())
              for_each_entity(slave.basis(), [&](const auto &nodes) {
                FullMatrix<double> block(nodes.size(), nodes.size());
                for (unsigned int i = 0; i < nodes.size(); ++i)
                  block(i, i) = local.weights[nodes[i]];
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    const ExpansionPart row(component(rows, c), nodes),
                      column(own.component(c), nodes);
                    visit(row(), column(), block, 1.);
                  }
              });
            const auto all = [&](const FaceTrace          &side,
                                 const FullMatrix<double> &block,
                                 const double              factor) {
              const Columns            columns(side);
              const FullMatrix<double> in_columns =
                values ? columns.in_columns(block) : block;
              for (unsigned int c = 0; c < dim; ++c)
                visit(component(rows, c),
                      columns.component(c),
                      in_columns,
                      factor);
            };
            if (!(local.is_dual() && own.are_nodal()))
              all(slave, local.constraint, 1.);
            for (const auto &partner : local.partners)
              all(coupling.interface->master_traces()[partner.master],
                  partner.constraint,
                  -1.);
          });
      };
      for_each_block(false,
                     [&](const Expansion          &row,
                         const Expansion          &column,
                         const FullMatrix<double> &block,
                         const double) {
                       assembler.record(row, block.m(), column, block.n());
                     });
      assembler.allocate();
      for_each_block(true,
                     [&](const Expansion          &row,
                         const Expansion          &column,
                         const FullMatrix<double> &block,
                         const double              factor) {
                       assembler.add(row, column, block, factor, false);
                     });
      assembler.create(matrix, partition.comm);
    }
  } // namespace

  void
  assemble_constraint(const std::vector<Coupling> &couplings,
                      const CouplingPartition     &partition,
                      SparseMatrix                &coupling)
  {
    assemble_blocks<ConstraintColumns>(couplings, partition, coupling);
  }

  void
  assemble_prescribed_columns(const std::vector<Coupling> &couplings,
                              const CouplingPartition     &partition,
                              SparseMatrix                &coupling)
  {
    assemble_blocks<PrescribedTrace>(couplings, partition, coupling);
  }

  void
  assemble_jump_penalty(const std::vector<Coupling> &couplings,
                        const CouplingPartition     &partition,
                        SparseMatrix                &jump_penalty)
  {
    RowAssembler assembler(partition.owned_displacement,
                           partition.owned_displacement);
    const auto   for_each_block = [&](const auto &block) {
      for_each_face(
        couplings, [&](const Coupling &coupling, const unsigned int s) {
          const FaceTrace     &slave = coupling.interface->slave().traces[s];
          const LocalCoupling &local = coupling.local[s];
          for (unsigned int c = 0; c < dim; ++c)
            {
              block(component(slave, c),
                    component(slave, c),
                    local.mass,
                    local.penalty,
                    false);
              for (const auto &partner : local.partners)
                {
                  const Expansion master = component(
                    coupling.interface->master_traces()[partner.master], c);
                  block(component(slave, c),
                        master,
                        partner.mixed,
                        -local.penalty,
                        false);
                  block(master,
                        component(slave, c),
                        partner.mixed,
                        -local.penalty,
                        true);
                  block(master, master, partner.mass, local.penalty, false);
                }
            }
        });
    };
    for_each_block([&](const Expansion          &row,
                       const Expansion          &column,
                       const FullMatrix<double> &local,
                       const double,
                       const bool transposed) {
      assembler.record(row,
                       transposed ? local.n() : local.m(),
                       column,
                       transposed ? local.m() : local.n());
    });
    assembler.allocate();
    for_each_block([&](const Expansion          &row,
                       const Expansion          &column,
                       const FullMatrix<double> &local,
                       const double              factor,
                       const bool                transposed) {
      assembler.add(row, column, local, factor, transposed);
    });
    assembler.create(jump_penalty, partition.comm);
  }
} // namespace mortise
