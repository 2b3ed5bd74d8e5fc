// See normal_multipliers.h.
#include <mortise/mortar/coupling.h>
#include <mortise/mortar/normal_multipliers.h>

#include "multiplier_sums.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Where their entries are in sums.
    enum
    {
      area_sum,
      gap_sum,
      stiffness_sum,
      normal_sum,
      moment_sum    = normal_sum + dim,
      place_sum     = moment_sum + dim,
      n_normal_sums = place_sum + dim
    };
  } // namespace

  std::vector<NormalMultiplier>
  normal_multipliers(const Coupling &coupling,
                     const IndexSet &owned_multiplier,
                     const MPI_Comm  comm)
  {
    if (owned_multiplier.size() == 0)
      return {};
    auto sums = make_sums(n_normal_sums, coupling, owned_multiplier, comm);
    for_each_part(coupling,
                  [&](const unsigned int    s,
                      const unsigned int    i,
                      const Tensor<1, dim> &direction,
                      const auto            index,
                      const double          w) {
                    const LocalCoupling &local = coupling.local[s];
                    const double         own   = integral(coupling, s, i);
                    const double along = direction * coupling.frames[s][i][0];
                    sums[area_sum](index) += w * own * along;
                    sums[gap_sum](index) +=
                      w * (local.gap_moment[i] * direction);
                    sums[stiffness_sum](index) +=
                      w * own * along * local.penalty;
                    const auto about_origin =
                      cross_product_3d(local.position_moment[i], direction);
                    for (unsigned int c = 0; c < dim; ++c)
                      {
                        sums[normal_sum + c](index) += w * own * direction[c];
                        sums[moment_sum + c](index) += w * about_origin[c];
                        sums[place_sum + c](index) +=
                          w * along * local.position_moment[i][c];
                      }
                  });
    for (auto &sum : sums)
      sum.compress(VectorOperation::add);

    std::vector<NormalMultiplier> result(coupling.multipliers->n_owned());
    const auto                   &layout = *sums[area_sum].get_partitioner();
    const auto                    first  = coupling.multipliers->first();
    for (unsigned int k = 0; k < result.size(); ++k)
      {
        const auto i   = layout.global_to_local(first + k);
        result[k].area = sums[area_sum].local_element(i);
        result[k].gap  = sums[gap_sum].local_element(i);
        result[k].complementarity =
          sums[stiffness_sum].local_element(i) / result[k].area;
        for (unsigned int c = 0; c < dim; ++c)
          {
            result[k].normal[c] = sums[normal_sum + c].local_element(i);
            result[k].moment[c] = sums[moment_sum + c].local_element(i);
            result[k].position[c] =
              sums[place_sum + c].local_element(i) / result[k].area;
          }
      }
    return result;
  }
} // namespace mortise
