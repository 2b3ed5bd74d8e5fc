// What slave faces meet, partner_states().
#include <mortise/mortar/coupling.h>

#include <array>
#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    bool
    has_columns(const FaceTrace &trace, const unsigned int c)
    {
      const unsigned int n = trace.n_functions();
      return trace.begin[(c + 1) * n] > trace.begin[c * n];
    }

    /// Faces belong to one boundary each.
    bool
    have_same_slave(const Coupling &a, const Coupling &b)
    {
      const BodySurface &first  = a.interface->slave(),
                        &second = b.interface->slave();
      // cells of different bodies must not be compared
      return !first.faces.empty() &&
             first.faces.size() == second.faces.size() &&
             &first.cells[0]->get_dof_handler() ==
               &second.cells[0]->get_dof_handler() &&
             first.cells[0] == second.cells[0] &&
             first.face_numbers[0] == second.face_numbers[0];
    }

    /// Supports of one boundary, which are orthogonal, do not compete.
    bool
    have_directions(const Coupling &a, const Coupling &b)
    {
      return a.interface->slave().direction && b.interface->slave().direction;
    }

    /// Does interface @p a have more of slave face @p s than @p b? Of halves, the first by name
    /// counts as more.
    bool
    goes_in_front(const Coupling &a, const Coupling &b, const unsigned int s)
    {
      constexpr double rounding = 1e-6;
      const double     difference =
        a.interface->coverage()[s] - b.interface->coverage()[s];
      return std::fabs(difference) > rounding ?
               difference > 0. :
               a.interface->name() < b.interface->name();
    }

    /// Does something of the normal lie in the directions that are free?
    bool
    can_follow_normal(const BodySurface           &slave,
                      const unsigned int           s,
                      const std::array<bool, dim> &free)
    {
      constexpr double rounding = 1e-3;
      auto             normals  = slave.faces[s].vertex_normals;
      if (slave.direction)
        normals.fill(*slave.direction);
      for (const auto &normal : normals)
        for (unsigned int c = 0; c < dim; ++c)
          if (free[c] && std::fabs(normal[c]) > rounding)
            return true;
      return false;
    }
  } // namespace

  std::vector<std::vector<PartnerState>>
  partner_states(const std::vector<Coupling> &couplings)
  {
    std::vector<std::vector<PartnerState>> all;
    for (const Coupling &coupling : couplings)
      {
        std::vector<const Coupling *> sharing;
        for (const Coupling &other : couplings)
          if (&other != &coupling && have_same_slave(coupling, other) &&
              !have_directions(coupling, other))
            sharing.push_back(&other);
        all.emplace_back();
        for (unsigned int s = 0; s < coupling.local.size(); ++s)
          {
            const double covered = coupling.interface->coverage()[s];
            PartnerState state   = {face_coverage(covered, true),
                                    {},
                                    coupling.local[s].is_dual(),
                                    coupling.local[s].along_normals};
            for (const Coupling *other : sharing)
              if (goes_in_front(*other, coupling, s))
                state.cover = face_coverage(covered, false);
            const auto find_free = [&](const FaceTrace &trace) {
              for (unsigned int c = 0; c < dim; ++c)
                state.has_free_displacement[c] |= has_columns(trace, c);
            };
            find_free(coupling.interface->slave().traces[s]);
            for (const auto &partner : coupling.local[s].partners)
              find_free(coupling.interface->master_traces()[partner.master]);
            if (coupling.law.constrained == ConstrainedDirections::normal)
              state.has_free_displacement = {{can_follow_normal(
                coupling.interface->slave(), s, state.has_free_displacement)}};
            all.back().push_back(state);
          }
      }
    return all;
  }
} // namespace mortise
