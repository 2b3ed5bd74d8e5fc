// See rigid_closing.h.
#include <deal.II/base/mpi.h>

#include <mortise/problem/contact/rigid_closing.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of loads, of gaps: what cancels to less is rounding.
    constexpr double rounding = 1e-10;

    /// The free motion that the loads drive, each motion by the force along it;
    /// zero where they drive none. Collective.
    SystemVector
    driven_motion(const Discretisation &discretisation,
                  const Preloads       &preloads,
                  const SceneLoad      &load,
                  const FreeMotions    &free)
    {
      const BlockSystem &system = discretisation.linear_system();
      SystemVector       result = system.zero_vector();
      for (unsigned int k = 0; k < free.motions.size(); ++k)
        {
          const SystemVector motion = discretisation.rigid_motion(free, k);
          double sums[2] = {0., 0.}; // of work, and of its parts' sizes
          for (unsigned int i = 0; i < motion.displacement.locally_owned_size();
               ++i)
            {
              const double work = load.rhs.displacement.begin()[i] *
                                  motion.displacement.begin()[i];
              sums[0] += work;
              sums[1] += std::fabs(work);
            }
          Utilities::MPI::sum(ArrayView<const double>(sums),
                              system.communicator,
                              ArrayView<double>(sums));
          Vector opening = load.rhs.multiplier;
          system.apply_constraint(opening, motion.displacement);
          const double of_preloads = preloads.work(opening);
          sums[0] += of_preloads;
          sums[1] += std::fabs(of_preloads);
          if (std::fabs(sums[0]) > rounding * sums[1])
            add_scaled(result, sums[0], motion);
        }
      return result;
    }
  } // namespace

  std::vector<bool>
  close_gaps_rigidly(const Discretisation &discretisation,
                     const Preloads       &preloads,
                     const SceneLoad      &load,
                     const SystemVector   &x,
                     std::vector<bool>     active)
  {
    const MPI_Comm    comm      = discretisation.linear_system().communicator;
    std::vector<bool> may_close = discretisation.one_sided();
    SystemVector      at        = x;
    while (true)
      {
        const FreeMotions free =
          discretisation.interfaces().free_motions(active,
                                                   preloads.have_forces());
        const SystemVector motion =
          driven_motion(discretisation, preloads, load, free);
        if (motion.displacement.linfty_norm() == 0.)
          return active;
        const Vector gaps = discretisation.gaps(load, at);
        SystemVector unit = at;
        add_scaled(unit, 1., motion);
        Vector closing = gaps;
        closing -= discretisation.gaps(load, unit);
        const double negligible = rounding * closing.linfty_norm();
        const auto   closes     = [&](const unsigned int i) {
          return may_close[i] && !active[i] && closing.begin()[i] > negligible;
        };
        double length = std::numeric_limits<double>::max();
        for (unsigned int i = 0; i < active.size(); ++i)
          if (closes(i))
            length =
              std::min(length,
                       std::max(0., gaps.begin()[i]) / closing.begin()[i]);
        length = Utilities::MPI::min(length, comm);
        if (length == std::numeric_limits<double>::max())
          return active;
        const double closed =
          rounding * (gaps.linfty_norm() + length * closing.linfty_norm());
        for (unsigned int i = 0; i < active.size(); ++i)
          if (closes(i) &&
              gaps.begin()[i] - length * closing.begin()[i] <= closed)
            active[i] = true;
        add_scaled(at, length, motion);
      }
  }
} // namespace mortise
