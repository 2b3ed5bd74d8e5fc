// Which nodes of contact stick and which slip, and how the linear system of an
// iterate follows from that.
#pragma once

#include <mortise/contact/contact_records.h>
#include <mortise/contact/friction.h>
#include <mortise/mortar/slip_origin.h>
#include <mortise/problem/contact/global_unknowns.h>
#include <mortise/problem/scene/discretisation.h>
#include <mortise/problem/scene/scene_data.h>

#include <array>
#include <cstdint>
#include <vector>

namespace mortise
{
  /// Vectors are by owned node of contact, see Pairing::contact_nodes(); those
  /// without friction stick once they are closed.
  class FrictionSet
  {
  public:
    /// References must live on. Collective.
    FrictionSet(const RunContext &run, Discretisation &discretisation);

    /// Does no interface have friction? Then nothing below does anything.
    bool
    empty() const
    {
      return !discretisation.interfaces().have_friction() ||
             discretisation.linear_system().owned_multiplier.size() == 0;
    }

    /// Take the bounds of the time of @p data, and begin with the laws of the
    /// last step.
    void
    begin(const SceneData &data);

    /// All closed nodes stick.
    void
    stick();

    /// Of closed nodes, by which open ones begin when they close.
    std::vector<Friction>
    laws() const
    {
      std::vector<Friction> result;
      for (const Node &node : nodes)
        result.push_back(node.law);
      return result;
    }

    /// The inverse of laws().
    void
    take(const std::vector<Friction> &laws);

    struct Change
    {
      std::uint64_t slip = 0, stick = 0;
      /// The largest violation of the law at nodes that slip, beside the
      /// largest pressure.
      double error = 0.;

      bool
      any() const
      {
        return slip + stick > 0;
      }
    };

    /// The laws that follow from the iterate with the multipliers @p lambda and
    /// these Discretisation::weighted_gaps(). @p closed: the next active set.
    /// @p accuracy: beside the largest pressure. Collective.
    Change
    advance(const std::vector<bool> &closed,
            const Vector            &lambda,
            const Vector            &weighted_gaps,
            double                   accuracy);

    /// Let nodes beside those that begin to slip, but stuck with the laws()
    /// of @p before, slip as well, see extend_slip(); after advance() with the
    /// same arguments. Returns how many. Collective.
    std::uint64_t
    extend(const NodePositions         &positions,
           const std::vector<bool>     &closed,
           const std::vector<Friction> &before,
           const Vector                &lambda,
           const Vector                &weighted_gaps);

    /// Of those that slip now, but stuck with the laws() of @p before, let the
    /// one that exceeds its bound least stick for once more. False if there is
    /// none. Collective.
    bool
    keep_one(const std::vector<Friction> &before);

    /// Work of friction, at most, on a motion with the constraint residual
    /// @p motion. Collective.
    double
    resistance(const Vector &motion) const;

    /// laws() with the status of those that are not @p closed.
    std::vector<Friction>
    laws(const std::vector<bool> &closed) const;

    /// The same as if nodes that slip held nothing across their directions, of
    /// which a coarse solution does not tell how they differ.
    std::vector<Friction>
    laws_without_resistance(const std::vector<bool> &closed) const;

    /// Set the linear system; returns whether its directions changed, so that
    /// LinearSolver::update_directions() must follow. Collective.
    bool
    select(const std::vector<bool> &closed);

    /// Change @p rhs of a load to that of the selected system.
    void
    apply(SystemVector &rhs) const;

    /// Add to @p lambda, a solution of that, the tractions that it contains.
    void
    complete(Vector &lambda) const;

    /// Slip counts from the state with these weighted gaps on; of the nodes
    /// @p which, or of all if it is empty, except those that were open then.
    void
    set_origin(const Vector            &weighted_gaps,
               const std::vector<bool> &which = {});

    /// Slip counts from where sides were apart by @p openings, by node and
    /// multiplier, the present ones of earlier pairs. @p weighted_gaps: the present
    /// ones. A node that had a partner has friction, even if it was open.
    void
    set_origin(const Vector                           &weighted_gaps,
               const std::vector<SlipOrigin::Opening> &openings);

    /// The step has converged.
    void
    accept(const std::vector<bool> &closed,
           const Vector            &lambda,
           const Vector            &weighted_gaps);

    /// What the next step, or another discretisation, needs to know.
    std::vector<ContactRecord>
    records(const std::vector<bool> &closed) const;

    /// Set what @p records have of the last step to what an iterate has.
    void
    set_iterate(const Vector               &lambda,
                const Vector               &weighted_gaps,
                std::vector<ContactRecord> &records) const;

    /// The inverse of records(); set_origin() must follow.
    void
    restore(const std::vector<ContactRecord> &records);

    /// Begin the first step with the laws that follow from those of another
    /// discretisation; after begin().
    void
    guess(const std::vector<ContactRecord> &records);

    /// Sum of the slips of all steps, in the space of the multipliers.
    const std::vector<dealii::Tensor<1, dim>> &
    slips() const
    {
      return total_slip;
    }

    /// By Coupling::number, the energy that nodes have dissipated which are
    /// none any more.
    const std::vector<double> &
    dissipated_apart() const
    {
      return apart;
    }

    /// Set that from the energy @p all of all nodes ever; after restore().
    /// Collective.
    void
    set_dissipated(const std::vector<double> &all);

    /// Energy that all steps have dissipated.
    const std::vector<double> &
    dissipated() const
    {
      return dissipation;
    }

  private:
    struct Node
    {
      const ContactNode     *contact;
      bool                   has_friction;
      FrictionBound          bound;
      Friction               law;
      dealii::Tensor<1, dim> origin; ///< where slip counts from, a length
      /// Of the last step, by multiplier.
      dealii::Tensor<1, dim> traction, increment;
      /// Has the node been closed since then? If not, it has no friction.
      bool   touched = true;
      double excess  = 0.; ///< of the last traction over the bound
    };

    FrictionPoint
    point(const Node   &node,
          const Vector &lambda,
          const Vector &weighted_gaps) const;
    /// Slip since the last step.
    dealii::Tensor<1, dim>
    slip(const Node &node, const Vector &weighted_gaps) const;
    /// Anderson's acceleration of the bounds, which followed from a system with
    /// the laws of @p before. Source: Walker, Ni (2011). Collective.
    void
    accelerate(const std::vector<Friction> &before);

    const RunContext &run;
    Discretisation   &discretisation;
    /// Does the bound follow the pressure within a linear system, and not from
    /// one to the next?
    const bool                          within_system;
    std::vector<Node>                   nodes;
    std::vector<dealii::Tensor<1, dim>> total_slip;
    std::vector<double>                 dissipation, apart;
    /// Of the selected system: tractions of nodes that slip, by multiplier.
    Vector given;
    /// For accelerate(): bounds of linear systems with the same nodes that
    /// slip, and those that followed from them; the newest last.
    std::vector<std::array<std::vector<double>, 2>> bounds;
    bool turned = false; ///< does the selected system have directions?
  };
} // namespace mortise
