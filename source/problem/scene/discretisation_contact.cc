// Contact of a Discretisation.
#include <mortise/mortar/force_stiffness.h>
#include <mortise/problem/scene/discretisation.h>

#include <utility>

namespace mortise
{
  using namespace dealii;

  void
  Discretisation::select(const std::vector<bool>    &active,
                         SparseMatrix              &&turn,
                         SparseMatrix              &&inverse,
                         std::optional<SparseMatrix> turn_of_forces,
                         const std::vector<double>  &compliance)
  {
    const auto turned = [&](const SparseMatrix &Q) {
      const CouplingMatrix &B = system.constraint;
      return B.with_frames(B.has_frames() ? Q.times(B.frames()) :
                                            SparseMatrix(Q));
    };
    MultiplierDirections directions;
    directions.constraint = turned(turn);
    if (turn_of_forces)
      directions.forces = turned(*turn_of_forces);
    directions.turn           = std::move(turn);
    directions.inverse        = std::move(inverse);
    directions.turn_of_forces = std::move(turn_of_forces);

    const SparseMatrix              &springs = system.spring_compliance;
    std::vector<SparseMatrix::Entry> entries;
    for (unsigned int i = 0; i < springs.n_rows() && springs.m() > 0; ++i)
      {
        const auto row = springs.row(i);
        for (unsigned int k = 0; k < row.length; ++k)
          entries.push_back({springs.global_row(i),
                             springs.global_column(row.columns[k]),
                             row.values[k]});
      }
    for (unsigned int i = 0; i < compliance.size(); ++i)
      if (compliance[i] > 0.)
        {
          const auto index = system.owned_multiplier.nth_index_in_set(i);
          entries.push_back({index, index, compliance[i]});
        }
    if (Utilities::MPI::max(entries.empty() ? 0 : 1, run.comm) == 1)
      directions.compliance = SparseMatrix(system.owned_multiplier,
                                           system.owned_multiplier,
                                           run.comm,
                                           entries);
    system.directions = std::move(directions);
    system.active     = active;
  }

  void
  Discretisation::update_penalties(const std::vector<NodeStatus> &statuses)
  {
    pairing->select(statuses);
    system.bulk->update_penalties(pairing->all());
  }

  void
  Discretisation::pair(const std::vector<BodySolution> &displaced,
                       const double                     least_search)
  {
    set_pairing(
      std::make_unique<Pairing>(quiet, spaces, &displaced, least_search));
    paired_at =
      system.bulk->values_at_nodes([&](const auto body, const auto dof) {
        return displaced[body].displacement(dof);
      });
  }

  void
  Discretisation::add_force_stiffness(const Vector &multiplier)
  {
    bool is_symmetric = true;
    for (const Coupling &coupling : pairing->all())
      is_symmetric = is_symmetric && !coupling.has_following_friction();
    system.bulk->add_to_stiffness(force_stiffness(pairing->all(),
                                                  multiplier,
                                                  system.owned_displacement,
                                                  run.comm),
                                  is_symmetric);
  }

  void
  Discretisation::add_mesh_gaps(Vector &rhs) const
  {
    Vector closed; // by the displacements of the pairing
    if (paired_at.size() > 0)
      {
        closed = rhs;
        system.constraint.vmult_free(closed, paired_at);
      }
    for (const Coupling &coupling : pairing->all())
      if (coupling.law.has_mesh_gap)
        {
          if (!coupling.law.is_one_sided())
            add_distances(coupling, rhs);
          for (const ContactNode &node : coupling.contact_nodes)
            for (unsigned int r = 0; r < node.n_multipliers; ++r)
              rhs.begin()[node.multipliers[r]] +=
                node.areas[r] * node.gap() * node.kinematic_normal()[r];
          const MultiplierRange &own = coupling.multipliers->range();
          if (closed.size() > 0 && coupling.is_displaced)
            for (unsigned int m = own.first; m < own.end(); ++m)
              rhs.begin()[m] += closed.begin()[m];
        }
  }

  Vector
  Discretisation::weighted_gaps(const SceneLoad    &load,
                                const SystemVector &x) const
  {
    if (system.owned_multiplier.size() == 0)
      return {}; // every displacement of both sides is prescribed
    Vector result(system.owned_multiplier, run.comm), moved(result);
    system.constraint.vmult(moved, x.displacement);
    result = load.rhs.multiplier;
    result -= moved;
    return result;
  }

  std::vector<double>
  Discretisation::gaps(const Vector &weighted) const
  {
    std::vector<double> result;
    for (const ContactNode *node : pairing->contact_nodes())
      result.push_back(node->kinematic_normal() * node->mean(weighted.begin()));
    return result;
  }

  SystemVector
  Discretisation::rigid_motion(const FreeMotions &free,
                               const unsigned int k) const
  {
    const auto moved = linear_displacements(
      spaces.bodies,
      [&](const unsigned int body, const unsigned int c, const Point<dim> &x) {
        const Motion  row    = row_of(free.of_body[body], c, x);
        const Motion &motion = free.motions[k][body];
        return std::inner_product(row.begin(), row.end(), motion.begin(), 0.);
      });
    return mortise::system_vector(spaces.fields, system, {}, moved);
  }
} // namespace mortise
