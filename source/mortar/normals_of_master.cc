// The normals of masters at the nodes of slave faces, normals_of_master().
#include <mortise/mortar/local_coupling.h>
#include <mortise/mortar/nodal_block.h>

#include "multiplier_sums.h"
#include "projection_on_faces.h"

namespace mortise
{
  using namespace dealii;

  std::vector<std::vector<Tensor<1, dim>>>
  normals_of_master(const InterfaceHandler           &interface,
                    const std::vector<LocalCoupling> &couplings)
  {
    std::vector<std::vector<Tensor<1, dim>>> result(couplings.size());
    for (unsigned int s = 0; s < couplings.size(); ++s)
      {
        const LocalCoupling &local = couplings[s];
        if (local.partners.empty())
          continue;
        const FaceTrace   &trace = interface.slave().traces[s];
        const TraceBasis  &basis = trace.basis();
        const unsigned int n     = local.constraint.m();
        FullMatrix<double> values(n, n); // at nodes, from the integrals
        face_nodal_basis(trace.shape, trace.degree)
          .values.mmult(values, to_functions(interface, local, s));
        for (unsigned int k = 0; k < n; ++k)
          {
            Tensor<1, dim> sum;
            for (unsigned int i = 0; i < n; ++i)
              sum += values(k, i) * on_constants(local.directed, i, basis);
            result[s].push_back(sum / sum.norm());
          }
      }
    return result;
  }
} // namespace mortise
