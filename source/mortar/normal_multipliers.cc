// See normal_multipliers.h.
#include <mortise/mortar/normal_multipliers.h>

#include "multiplier_sums.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Below that weights are rounding.
    constexpr double no_sign_below = -1e-12;

    /// Where their entries are in sums.
    enum
    {
      area,
      gap,
      without_sign,
      normal,
      moment = normal + dim,
      n_sums = moment + dim
    };
  } // namespace

  std::vector<NormalMultiplier>
  normal_multipliers(const Coupling &coupling,
                     const IndexSet &owned_multiplier,
                     const MPI_Comm  comm)
  {
    auto sums = make_sums(n_sums, coupling, owned_multiplier, comm);
    for_each_entry(coupling,
                   [&](const unsigned int    s,
                       const unsigned int    i,
                       const Tensor<1, dim> &direction,
                       const auto            index,
                       const double          w) {
                     const LocalCoupling &local = coupling.local[s];
                     const FaceTrace     &trace =
                       coupling.interface->slave().traces[s];
                     const double own =
                       on_constants(local.constraint, i, trace.basis());
                     sums[area](index) += w * own;
                     sums[gap](index) += w * (local.gap_moment[i] * direction);
                     if (w < no_sign_below || !(own > 0.))
                       sums[without_sign](index) += 1.;
                     const auto about_origin =
                       cross_product_3d(local.position_moment[i], direction);
                     for (unsigned int c = 0; c < dim; ++c)
                       {
                         sums[normal + c](index) += w * own * direction[c];
                         sums[moment + c](index) += w * about_origin[c];
                       }
                   });
    // vertices' coefficients are values; those of edges and insides are not
    const BodySurface &slave = coupling.interface->slave();
    for (unsigned int s = 0; s < slave.traces.size(); ++s)
      {
        const auto &rows = coupling.multipliers->rows()[s];
        for (const auto &[row, index] : rows.hierarchical)
          if (const unsigned int k = row % rows.n_nodes();
              slave.traces[s].basis().functions[k].dimension > 0)
            sums[without_sign](index) += 1.;
      }
    for (auto &sum : sums)
      sum.compress(VectorOperation::add);

    std::vector<NormalMultiplier> result(coupling.multipliers->n_owned());
    const auto                   &layout = *sums[area].get_partitioner();
    const auto                    first  = coupling.multipliers->first();
    for (unsigned int k = 0; k < result.size(); ++k)
      {
        const auto i       = layout.global_to_local(first + k);
        result[k].area     = sums[area].local_element(i);
        result[k].gap      = sums[gap].local_element(i);
        result[k].has_sign = sums[without_sign].local_element(i) == 0.;
        for (unsigned int c = 0; c < dim; ++c)
          {
            result[k].normal[c] = sums[normal + c].local_element(i);
            result[k].moment[c] = sums[moment + c].local_element(i);
          }
      }
    return result;
  }
} // namespace mortise
