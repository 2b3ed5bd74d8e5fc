// The penalty that preconditioners see, assemble_jump_penalty().
#include <mortise/mortar/coupling.h>
#include <mortise/mortar/row_assembler.h>

#include "coupled_faces.h"

namespace mortise
{
  using namespace dealii;

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
          const auto           add_component = [&](const unsigned int a,
                                         const unsigned int b,
                                         const double       factor) {
            block(component(slave, a),
                  component(slave, b),
                  local.mass,
                  factor,
                  false);
            for (const auto &partner : local.partners)
              {
                const FaceTrace &master =
                  coupling.interface->master_traces()[partner.master];
                block(component(slave, a),
                      component(master, b),
                      partner.mixed,
                      -factor,
                      false);
                block(component(master, a),
                      component(slave, b),
                      partner.mixed,
                      -factor,
                      true);
                block(component(master, a),
                      component(master, b),
                      partner.mass,
                      factor,
                      false);
              }
          };
          const Tensor<1, dim> &n =
            coupling.interface->slave().faces[s].frame.normal;
          const Stiffness penalty = penalty_of(coupling, s, local.penalty);
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              if (const double factor =
                    (penalty.normal - penalty.tangential) * n[a] * n[b] +
                    (a == b ? penalty.tangential : 0.);
                  factor != 0.)
                add_component(a, b, factor);
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
