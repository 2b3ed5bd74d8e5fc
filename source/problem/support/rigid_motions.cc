#include <mortise/base/error.h>
#include <mortise/body/pieces.h>
#include <mortise/problem/support/rigid_motions.h>
#include <mortise/problem/support/side_faces.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::string
    direction_name(const std::array<double, 3> &direction)
    {
      const double norm = std::hypot(direction[0], direction[1], direction[2]);
      std::string  text;
      for (unsigned int c = 0; c < dim; ++c)
        {
          if (std::fabs(direction[c]) > 0.999 * norm)
            return std::string(1, "xyz"[c]);
          char number[32];
          std::snprintf(number,
                        sizeof(number),
                        "%s%.3g",
                        c ? ", " : "",
                        direction[c] / norm + 0.);
          text += number;
        }
      return "(" + text + ")";
    }

    /// The free motions as words; the basis of the null space is brought to
    /// echelon form, pure translations first, so that the axes come out where
    /// they can.
    std::string
    describe(std::vector<Motion> motions)
    {
      // reduce from the last column (rotations) so that translations are left
      // without rotation
      std::vector<Motion> reduced;
      for (int column = 5; column >= 0 && !motions.empty(); --column)
        {
          std::size_t pivot = 0;
          for (std::size_t m = 1; m < motions.size(); ++m)
            if (std::fabs(motions[m][column]) >
                std::fabs(motions[pivot][column]))
              pivot = m;
          if (std::fabs(motions[pivot][column]) < 1e-6)
            continue;
          Motion row = motions[pivot];
          motions.erase(motions.begin() + pivot);
          const double scale = row[column];
          for (double &entry : row)
            entry /= scale;
          const auto eliminate = [&](std::vector<Motion> &others) {
            for (Motion &other : others)
              {
                const double factor = other[column];
                for (unsigned int i = 0; i < 6; ++i)
                  other[i] -= factor * row[i];
              }
          };
          eliminate(motions);
          eliminate(reduced);
          reduced.push_back(row);
        }
      std::string text;
      for (auto motion = reduced.rbegin(); motion != reduced.rend(); ++motion)
        {
          const auto &m        = *motion;
          const bool  rotation = std::hypot(m[3], m[4], m[5]) > 1e-6;
          text +=
            (text.empty() ? "" : ", ") +
            std::string(rotation ? "rotation about " : "translation along ") +
            direction_name(rotation ?
                             std::array<double, 3>{{m[3], m[4], m[5]}} :
                             std::array<double, 3>{{m[0], m[1], m[2]}});
        }
      return text;
    }

    /// By piece of @p body: how many of its faces are on sides of interfaces. Collective.
    std::vector<unsigned int>
    faces_in_interfaces(const Bodies                           &bodies,
                        const Body                             &body,
                        const Pieces                           &pieces,
                        const std::vector<InterfaceParameters> &interfaces)
    {
      std::vector<unsigned int> n(pieces.n, 0);
      for (const InterfaceParameters &interface : interfaces)
        for (const SideParameters *side : {&interface.slave, &interface.master})
          if (side->body == body.index)
            for (const BoundaryFace &face :
                 side_faces(bodies, *side, "Interface " + interface.name))
              ++n[pieces.of_cell[face.cell->active_cell_index()]];
      Utilities::MPI::sum(n, body.triangulation().get_communicator(), n);
      return n;
    }

    /// In words, where prescribed displacements alone hold the part.
    /// Collective.
    std::string
    free_motions_of_part(const Body                            &body,
                         const std::vector<DirichletCondition> &dirichlet,
                         const std::vector<RigidPart>          &parts,
                         const Extent                          &where,
                         const PartOfBody                      &part)
    {
      Resistance resistance(1);
      resistance.add(0, support_of(body, dirichlet, parts, where, part));
      std::vector<Motion> motions;
      for (const auto &vector : resistance.free_motions())
        {
          motions.emplace_back();
          std::copy_n(vector.begin(), 6, motions.back().begin());
        }
      return describe(motions);
    }

    /// Supports of the bodies.
    class Supports
    {
    public:
      Supports(const Bodies                                       &bodies,
               const std::vector<std::vector<DirichletCondition>> &dirichlet,
               const std::vector<RigidPart>                       &parts,
               const std::vector<TieSupport>                      &ties)
        : ties(ties)
        , supported(bodies.size(), false)
      {
        const MPI_Comm comm =
          bodies.front()->triangulation().get_communicator();
        for (const auto &body : bodies)
          {
            where.push_back(extent(*body));
            of_body.push_back(
              support_of(*body, dirichlet[body->index], parts, where.back()));
          }
        for (const TieSupport &tie : ties)
          {
            of_tie.push_back(resistance_of(
              tie,
              where[tie.slave],
              where[tie.master == TieSupport::ground ? tie.slave : tie.master],
              comm));
            n_multipliers.push_back(
              Utilities::MPI::sum(tie.multipliers.size(), comm));
          }
        find_held();
        if (std::find(supported.begin(), supported.end(), false) !=
            supported.end())
          find_free();
      }

      /// All of them.
      FreeMotions
      free_motions() const
      {
        FreeMotions result{where, {}};
        for (const auto &vector : free)
          {
            result.motions.emplace_back(place.size(), Motion{});
            for (unsigned int b = 0; b < place.size(); ++b)
              if (place[b] >= 0)
                std::copy_n(vector.begin() + 6 * place[b],
                            6,
                            result.motions.back()[b].begin());
          }
        return result;
      }

      /// Of body @p b: what moves.
      std::string
      free_motions(const unsigned int b) const
      {
        std::vector<Motion> motions;
        for (const auto &vector : free)
          if (place[b] >= 0)
            {
              motions.emplace_back();
              std::copy_n(vector.begin() + 6 * place[b],
                          6,
                          motions.back().begin());
            }
        return describe(motions);
      }

      /// The interfaces of body @p b, and how much they are.
      std::string
      ties_of(const unsigned int b) const
      {
        std::string text;
        for (unsigned int t = 0; t < ties.size(); ++t)
          if (ties[t].slave == b || ties[t].master == b)
            {
              char covered[32];
              std::snprintf(covered,
                            sizeof(covered),
                            "%.3g",
                            100. * ties[t].coverage);
              text +=
                (text.empty() ? " (tied by " : ", ") + ties[t].name + ": " +
                std::to_string(n_multipliers[t]) + " multipliers, " + covered +
                " % of the slave surface covered" +
                (ties[t].released ? ", whose Preload is all along its normal" :
                                    "");
            }
        return text.empty() ? "" : text + ")";
      }

    private:
      /// Those that cannot move where their prescribed displacements and
      /// bodies that cannot move hold them.
      void
      find_held()
      {
        for (bool again = true; again;)
          {
            again = false;
            for (unsigned int b = 0; b < supported.size(); ++b)
              {
                if (supported[b])
                  continue;
                Resistance resistance(1);
                resistance.add(0, of_body[b]);
                for (unsigned int t = 0; t < ties.size(); ++t)
                  {
                    const unsigned int sides[] = {ties[t].slave,
                                                  ties[t].master};
                    for (unsigned int i = 0; i < 2; ++i)
                      if (sides[i] == b &&
                          (sides[1 - i] == TieSupport::ground ||
                           supported[sides[1 - i]]))
                        resistance.add(i == 0 ? 0 : -1,
                                       i == 1 ? 0 : -1,
                                       of_tie[t]);
                  }
                again = supported[b] = resistance.free_motions().empty();
                if (again)
                  break;
              }
          }
      }

      /// Motions of the other bodies that nothing prevents.
      void
      find_free()
      {
        place.assign(supported.size(), -1);
        int n = 0;
        for (unsigned int b = 0; b < supported.size(); ++b)
          if (!supported[b])
            place[b] = n++;
        Resistance resistance(n);
        for (unsigned int b = 0; b < supported.size(); ++b)
          if (!supported[b])
            resistance.add(place[b], of_body[b]);
        for (unsigned int t = 0; t < ties.size(); ++t)
          resistance.add(place[ties[t].slave],
                         ties[t].master == TieSupport::ground ?
                           -1 :
                           place[ties[t].master],
                         of_tie[t]);
        free = resistance.free_motions();
      }

      const std::vector<TieSupport>   &ties;
      std::vector<Extent>              where;
      std::vector<Support>             of_body;
      std::vector<TieResistance>       of_tie;
      std::vector<std::size_t>         n_multipliers; ///< by tie, of all ranks
      std::vector<bool>                supported;
      std::vector<int>                 place; ///< by body, in vectors of free
      std::vector<std::vector<double>> free;
    };
  } // namespace

  void
  check_pieces(const Bodies                                       &bodies,
               const std::vector<std::vector<DirichletCondition>> &dirichlet,
               const std::vector<RigidPart>                       &parts,
               const std::vector<InterfaceParameters>             &interfaces)
  {
    constexpr unsigned int max_named = 3;
    std::string            message;
    unsigned int           n_free = 0;
    for (const auto &body : bodies)
      {
        const Pieces pieces = find_pieces(*body);
        if (pieces.n == 1)
          continue;
        const auto n_tied =
          faces_in_interfaces(bodies, *body, pieces, interfaces);
        for (unsigned int k = 0; k < pieces.n; ++k)
          {
            if (n_tied[k] > 0)
              continue;
            const PartOfBody  part{&pieces, k};
            const Extent      where   = extent(*body, part);
            const std::string motions = free_motions_of_part(
              *body, dirichlet[body->index], parts, where, part);
            if (motions.empty() || ++n_free > max_named)
              continue;
            std::ostringstream text;
            text << (message.empty() ? "" : "; ") << "the piece of body "
                 << body->name << " around (" << where.centre << "), one of "
                 << pieces.n
                 << " that share no node, can move freely: " << motions;
            message += text.str();
          }
      }
    if (n_free > max_named)
      message += "; and " + std::to_string(n_free - max_named) + " more";
    if (n_free > 0)
      throw InputError(
        "Boundary conditions and interfaces leave rigid motions free: " +
        message +
        ". Prescribe displacements (Boundary ... / Displacement) that prevent "
        "them, let solids that touch share their faces (gmsh: Coherence, or "
        "BooleanFragments), or make the pieces bodies and tie them by an "
        "interface");
  }

  FreeMotions
  find_free_motions(
    const Bodies                                       &bodies,
    const std::vector<std::vector<DirichletCondition>> &dirichlet,
    const std::vector<RigidPart>                       &parts,
    const std::vector<TieSupport>                      &ties)
  {
    return Supports(bodies, dirichlet, parts, ties).free_motions();
  }

  void
  check_rigid_motions(
    const Bodies                                       &bodies,
    const std::vector<std::vector<DirichletCondition>> &dirichlet,
    const std::vector<RigidPart>                       &parts,
    const std::vector<TieSupport>                      &ties)
  {
    const Supports supports(bodies, dirichlet, parts, ties);
    // bodies that move alike in one phrase
    std::map<std::string, std::vector<unsigned int>> moving;
    for (const auto &body : bodies)
      if (const std::string motions = supports.free_motions(body->index);
          !motions.empty())
        moving[motions].push_back(body->index);
    std::string message;
    for (const auto &[motions, group] : moving)
      {
        message += (message.empty() ? "" : "; ") +
                   std::string(group.size() > 1 ? "the bodies " : "the body ");
        for (const unsigned int b : group)
          message += (b == group.front() ? "" : ", ") + bodies[b]->name +
                     supports.ties_of(b);
        message += " can move freely: " + motions;
      }
    if (!message.empty())
      throw InputError(
        "Boundary conditions and interfaces leave rigid motions free: " +
        message +
        ". Prescribe displacements (Boundary ... / Displacement) that prevent them, tie the body to a supported one, "
        "or exchange slave and master of an interface with few multipliers");
  }
} // namespace mortise
