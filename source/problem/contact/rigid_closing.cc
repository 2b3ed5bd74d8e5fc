// See rigid_closing.h.
#include <deal.II/base/mpi.h>

#include <mortise/problem/contact/rigid_closing.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of loads, of gaps: what cancels to less is rounding.
    constexpr double rounding = 1e-10;

    /// Work of the loads on a rigid motion, and the sum of its parts' sizes.
    /// Collective.
    std::array<double, 2>
    work_on(const Discretisation &discretisation,
            const GlobalUnknowns &unknowns,
            const SceneLoad      &load,
            const DrivenMotion   &motion)
    {
      const BlockSystem    &system = discretisation.linear_system();
      std::array<double, 2> sums{};
      for (unsigned int i = 0; i < motion.x.displacement.locally_owned_size();
           ++i)
        {
          const double work =
            load.rhs.displacement.begin()[i] * motion.x.displacement.begin()[i];
          sums[0] += work;
          sums[1] += std::fabs(work);
        }
      Utilities::MPI::sum(ArrayView<const double>(sums),
                          system.communicator,
                          ArrayView<double>(sums));
      Vector opening = load.rhs.multiplier;
      system.constraint.vmult(opening, motion.x.displacement);
      unknowns.add_gaps(motion.unknowns, -1., opening);
      const double of_unknowns = unknowns.work(motion.unknowns, opening);
      return {{sums[0] + of_unknowns, sums[1] + std::fabs(of_unknowns)}};
    }
  } // namespace

  double
  work_of_loads(const Discretisation &discretisation,
                const GlobalUnknowns &unknowns,
                const SceneLoad      &load,
                const DrivenMotion   &motion)
  {
    return work_on(discretisation, unknowns, load, motion)[0];
  }

  DrivenMotion
  driven_motion(const Discretisation &discretisation,
                const GlobalUnknowns &unknowns,
                const SceneLoad      &load,
                const FreeMotions    &free)
  {
    DrivenMotion result{discretisation.linear_system().zero_vector(),
                        unknowns.zero()};
    for (unsigned int k = 0; k < free.motions.size(); ++k)
      {
        const DrivenMotion motion{discretisation.rigid_motion(free, k),
                                  unknowns.values_of(free, k)};
        const auto [work, size] =
          work_on(discretisation, unknowns, load, motion);
        if (!(std::fabs(work) > rounding * size))
          continue;
        add_scaled(result.x, work, motion.x);
        for (unsigned int j = 0; j < motion.unknowns.size(); ++j)
          result.unknowns[j] += work * motion.unknowns[j];
        result.size += std::fabs(work);
      }
    return result;
  }

  std::vector<bool>
  close_gaps_rigidly(const Discretisation &discretisation,
                     const GlobalUnknowns &unknowns,
                     SceneLoad            &load,
                     std::vector<Friction> laws,
                     SystemVector         &at)
  {
    const MPI_Comm comm    = discretisation.linear_system().communicator;
    const auto     gaps_of = [&](const SystemVector &x) {
      return discretisation.gaps(discretisation.weighted_gaps(load, x));
    };
    const auto largest = [&](const std::vector<double> &values) {
      double result = 0.;
      for (const double value : values)
        result = std::max(result, std::fabs(value));
      return Utilities::MPI::max(result, comm);
    };
    const auto active = [&] {
      std::vector<bool> result;
      for (const Friction &law : laws)
        result.push_back(law.status != NodeStatus::open);
      return result;
    };
    while (true)
      {
        const FreeMotions free =
          discretisation.interfaces().free_motions(laws,
                                                   unknowns.have_forces());
        const DrivenMotion motion =
          driven_motion(discretisation, unknowns, load, free);
        if (motion.is_zero())
          return active();
        const std::vector<double> gaps = gaps_of(at);
        const auto                move = [&](const double length) {
          add_scaled(at, length, motion.x);
          unknowns.add_gaps(motion.unknowns, length, load.rhs.multiplier);
        };
        move(1.);
        std::vector<double> closing = gaps_of(at);
        move(-1.);
        for (unsigned int i = 0; i < closing.size(); ++i)
          closing[i] = gaps[i] - closing[i];
        const double negligible = rounding * largest(closing);
        const auto   closes     = [&](const unsigned int i) {
          return laws[i].status == NodeStatus::open && closing[i] > negligible;
        };
        double length = std::numeric_limits<double>::max();
        for (unsigned int i = 0; i < gaps.size(); ++i)
          if (closes(i))
            length = std::min(length, std::max(0., gaps[i]) / closing[i]);
        length = Utilities::MPI::min(length, comm);
        if (length == std::numeric_limits<double>::max())
          return active();
        const double closed =
          rounding * (largest(gaps) + length * largest(closing));
        for (unsigned int i = 0; i < gaps.size(); ++i)
          if (closes(i) && gaps[i] - length * closing[i] <= closed)
            laws[i] = Friction();
        move(length);
      }
  }
} // namespace mortise
