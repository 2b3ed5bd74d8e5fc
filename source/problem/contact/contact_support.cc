// What holds the bodies in a ContactStep: contact, and friction.
#include <mortise/base/error.h>
#include <mortise/problem/contact/contact_step.h>
#include <mortise/problem/contact/rigid_closing.h>

#include <cmath>
#include <string>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::vector<Friction>
    laws_of(const std::vector<bool> &closed, const NodeStatus of_closed)
    {
      std::vector<Friction> result(closed.size());
      for (unsigned int i = 0; i < closed.size(); ++i)
        result[i].status = closed[i] ? of_closed : NodeStatus::open;
      return result;
    }
  } // namespace

  std::string
  ContactStep::free_motions(const std::vector<Friction> &laws) const
  {
    try
      {
        discretisation.interfaces().check_no_free_motion(
          laws, unknowns.have_forces());
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  void
  ContactStep::catch_bodies(const SystemVector &x, ActiveSet &next)
  {
    if (free_motions(friction.laws(next.active())).empty())
      return;
    SystemVector            at     = x;
    SceneLoad               there  = *load;
    const std::vector<bool> caught = close_gaps_rigidly(
      discretisation, unknowns, there, friction.laws(next.active()), at);
    if (!friction.empty())
      {
        std::vector<bool> touches;
        for (unsigned int i = 0; i < caught.size(); ++i)
          touches.push_back(caught[i] && !next.active()[i]);
        friction.set_origin(discretisation.weighted_gaps(there, at), touches);
      }
    next.start_from(caught);
    if (const std::string free = free_motions(friction.laws(next.active()));
        !free.empty())
      throw InputError(
        "Contact is lost: the contact that remains active does not hold the bodies. " +
        free);
  }

  void
  ContactStep::check_hold(const std::vector<bool> &next)
  {
    /// Of work, that rounding and linear solves leave.
    constexpr double rounding = 1e-8;

    const std::vector<Friction> laws   = friction.laws_without_resistance(next);
    const std::optional<double> before = std::exchange(used_strength, {});
    lost.clear();
    const std::string motions = free_motions(laws);
    if (motions.empty())
      return;
    const DrivenMotion motion = driven_motion(
      discretisation,
      unknowns,
      *load,
      discretisation.interfaces().free_motions(laws, unknowns.have_forces()));
    const double driving =
      work_of_loads(discretisation, unknowns, *load, motion);
    if (!(driving > 0.))
      return;
    Vector moved(load->rhs.multiplier);
    discretisation.linear_system().constraint.vmult(moved,
                                                    motion.x.displacement);
    unknowns.add_gaps(motion.unknowns, -1., moved);
    used_strength = friction.resistance(moved) / driving;
    lost          = *used_strength < 1. - rounding ?
                      "Friction does not hold the bodies: they slip. " + motions :
                      "";
    // pressures that change still may raise the resistance
    if (before && 1. - *used_strength >
                    rounding + 2. * std::fabs(*used_strength - *before))
      throw InputError(lost);
  }

  void
  ContactStep::hold_bodies(const std::vector<bool>     &next,
                           const std::vector<Friction> &before)
  {
    const auto is_free = [&] {
      return !free_motions(friction.laws(next)).empty();
    };
    // would the bodies be held if all that is closed stuck?
    if (!is_free() || !free_motions(laws_of(next, NodeStatus::stick)).empty())
      return;
    while (is_free() && friction.keep_one(before))
      {
      }
    if (is_free())
      friction.take(before);
    if (is_free())
      friction.stick();
  }

  void
  ContactStep::report_held() const
  {
    const std::string free = free_motions(
      laws_of(std::vector<bool>(set.active().size(), true), NodeStatus::slip));
    if (!free.empty())
      run.log.line("  friction alone prevents rigid motions. " + free);
  }
} // namespace mortise
