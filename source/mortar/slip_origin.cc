// See slip_origin.h.
#include <mortise/mortar/coupled_faces.h>
#include <mortise/mortar/slip_origin.h>

#include "constraint_columns.h"
#include "multiplier_sums.h"
#include "projection_on_faces.h"

namespace mortise
{
  using namespace dealii;

  SlipOrigin::SlipOrigin(const std::vector<Coupling> &couplings,
                         const IndexSet              &owned_displacement,
                         const Vector                &displacement,
                         const MPI_Comm               comm)
    : displacement(displacement)
    , comm(comm)
  {
    unsigned int n_rows = 0;
    for (const Coupling &coupling : couplings)
      if (coupling.has_following_friction())
        {
          std::vector<Face> &of_slave = faces[coupling.number];
          of_slave.resize(coupling.local.size());
          for (unsigned int s = 0; s < of_slave.size(); ++s)
            {
              of_slave[s].has_partner = !coupling.local[s].partners.empty();
              of_slave[s].first       = n_rows;
              n_rows += coupling.local[s].constraint.m();
            }
        }
    const IndexSet rows  = owned_range(n_rows, comm),
                   nodes = nodes_of(owned_displacement, dim);
    const auto   first   = n_rows > 0 ? rows.nth_index_in_set(0) : 0;
    RowAssembler assembler(rows, nodes);
    /// Calls visit(row expansion, column expansion, block) for all blocks.
    const auto for_each_block = [&](const bool values, const auto &visit) {
      for_each_face(
        couplings, [&](const Coupling &coupling, const unsigned int s) {
          if (!coupling.has_following_friction())
            return;
          const LocalCoupling &local = coupling.local[s];
          const unsigned int   n     = local.constraint.m();
          Face                &face  = faces.at(coupling.number)[s];
          ExpansionList        row;
          for (unsigned int i = 0; i < n; ++i)
            {
              row.add(first + face.first + i, 1.);
              row.close();
            }
          FullMatrix<double> inverse;
          if (values)
            {
              inverse = to_functions(*coupling.interface, coupling.local[s], s);
              face.opening.resize(n);
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < n; ++j)
                  face.opening[i] += inverse(i, j) * local.gap_moment[j];
            }
          const auto add = [&](const FaceTrace          &side,
                               const FullMatrix<double> &integrals,
                               const double              factor) {
            const NodalColumns columns(side);
            FullMatrix<double> block(n, integrals.n());
            if (values)
              {
                inverse.mmult(block, integrals);
                block *= factor;
                block = columns.in_columns(block);
              }
            visit(row(), columns.component(), block);
          };
          add(coupling.interface->slave().traces[s], local.constraint, 1.);
          for (const auto &partner : local.partners)
            add(coupling.interface->master_traces()[partner.master],
                partner.constraint,
                -1.);
        });
    };
    for_each_block(false,
                   [&](const Expansion          &row,
                       const Expansion          &column,
                       const FullMatrix<double> &block) {
                     assembler.record(row, block.m(), column, block.n());
                   });
    assembler.allocate();
    for_each_block(true,
                   [&](const Expansion          &row,
                       const Expansion          &column,
                       const FullMatrix<double> &block) {
                     assembler.add(row, column, block, 1., false);
                   });
    closing = assembler.create(comm, dim);
  }

  std::vector<SlipOrigin::Opening>
  SlipOrigin::openings(const std::vector<Coupling> &couplings,
                       const Vector                &displacement_now,
                       const IndexSet              &owned_multiplier) const
  {
    Vector moved = displacement_now;
    moved -= displacement;
    std::vector<double> closed(dim * closing.n_rows());
    closing.vmult(closed.data(), moved.begin());
    std::vector<Opening> result;
    for (const Coupling &coupling : couplings)
      {
        const unsigned int begin = result.size();
        result.resize(begin + coupling.contact_nodes.size());
        if (!coupling.has_following_friction())
          continue;
        const std::vector<Face> &of_slave = faces.at(coupling.number);
        auto sums = make_sums(2, coupling, owned_multiplier, comm);
        for_each_part(coupling,
                      [&](const unsigned int    s,
                          const unsigned int    i,
                          const Tensor<1, dim> &direction,
                          const auto            index,
                          const double          weight) {
                        const LocalCoupling &local = coupling.local[s];
                        const Face          &then  = of_slave[s];
                        Tensor<1, dim>       opening;
                        if (!then.has_partner)
                          opening = local.gap_moment[i];
                        else
                          for (unsigned int j = 0; j < then.opening.size(); ++j)
                            for (unsigned int c = 0; c < dim; ++c)
                              opening[c] +=
                                local.constraint(i, j) *
                                (then.opening[j][c] -
                                 closed[dim * (then.first + j) + c]);
                        sums[0](index) += weight * (opening * direction);
                        sums[1](index) += then.has_partner ? 1. : 0.;
                      });
        for (Vector &sum : sums)
          sum.compress(VectorOperation::add);
        for (unsigned int i = 0; i < coupling.contact_nodes.size(); ++i)
          {
            const ContactNode &node = coupling.contact_nodes[i];
            result[begin + i].mean  = node.mean(sums[0].begin());
            for (unsigned int r = 0; r < node.n_multipliers; ++r)
              if (sums[1].begin()[node.multipliers[r]] > 0.)
                result[begin + i].has_partner = true;
          }
      }
    return result;
  }
} // namespace mortise
