// Reference nodes of a deck, which move faces as a whole or load them:
// *COUPLING, *RIGID BODY and *PRE-TENSION SECTION.
#include <deal.II/base/numbers.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "import_conditions.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Options of keywords that name reference nodes.
    const std::vector<std::array<std::string, 2>> reference_options = {
      {{"*COUPLING", "REF NODE"}},
      {{"*KINEMATIC COUPLING", "REF NODE"}},
      {{"*RIGID BODY", "REF NODE"}},
      {{"*RIGID BODY", "ROT NODE"}},
      {{"*PRE-TENSION SECTION", "NODE"}}};

    bool
    acts(const std::vector<ImportChange> &changes)
    {
      return std::any_of(changes.begin(), changes.end(), [](const auto &c) {
        return c.value != 0.;
      });
    }
  } // namespace

  void
  ImportConditions::find_references()
  {
    for (const InpBlock *block : steps.model)
      for (const auto &[keyword, option] : reference_options)
        if (block->keyword == keyword && block->has(option))
          for (const unsigned int node :
               deck.find_nodes(block->option(option), block->instance))
            references[node].preload = keyword == "*PRE-TENSION SECTION";
  }

  /// *BOUNDARY, FIXED keeps the shortening of a preload.
  bool
  ImportConditions::is_kept(const InpBlock &block, const std::size_t step)
  {
    std::set<unsigned int> nodes;
    for (const InpLine &line : block.lines)
      nodes.merge(deck.find_nodes(line.words[0], block.instance));
    const bool kept =
      !nodes.empty() &&
      std::all_of(nodes.begin(), nodes.end(), [&](const auto node) {
        const auto reference = references.find(node);
        return reference != references.end() && reference->second.preload;
      });
    for (const unsigned int node : nodes)
      if (kept && references.at(node).fixed_from == 0)
        references.at(node).fixed_from = step;
    return kept;
  }

  std::string
  ImportConditions::preload_text(const InpBlock &section)
  {
    const auto nodes =
      deck.find_nodes(section.option("NODE"), section.instance);
    if (nodes.size() != 1)
      {
        remarks.left_out(section.place, section.keyword + " without a node");
        return "";
      }
    const Reference &reference = references.at(*nodes.begin());
    if (acts(reference.motion[0]))
      remarks.left_out(section.place,
                       section.keyword +
                         " whose shortening is given; Preload is a force");
    std::string text;
    if (!reference.load[0].empty())
      {
        // against the normal of the surface that is given the force presses
        double sense = 1.;
        if (!section.lines.empty())
          {
            auto x = import_numbers(section.lines[0]);
            x.resize(3);
            const auto &surface = deck.surfaces.at(
              deck.find_surface(section.option("SURFACE"), section.instance));
            for (const unsigned int f : bodies.faces_of(surface))
              if (bodies.normal_of(bodies.faces[f]) *
                    Tensor<1, 3>({x[0], x[1], x[2]}) <
                  0.)
                sense = -1.;
          }
        text = "  set Preload = " +
               steps.history(reference.load[0]).times(sense).text() + "\n";
        if (reference.fixed_from > 1)
          text += "  set Preload until = " +
                  number_text(steps.steps[reference.fixed_from - 1].start) +
                  "\n";
      }
    return text;
  }

  /// Faces of a surface, or of which a set has all nodes.
  std::vector<unsigned int>
  ImportConditions::coupled_faces(const InpBlock    &block,
                                  const std::string &name) const
  {
    const std::string key = deck.find_surface(name, block.instance);
    if (const auto surface = deck.surfaces.find(key);
        surface != deck.surfaces.end())
      return bodies.faces_of(surface->second);
    const auto                of_surface = deck.node_surfaces.find(key);
    const auto                nodes = of_surface != deck.node_surfaces.end() ?
                                        of_surface->second :
                                        deck.find_nodes(name, block.instance);
    std::vector<unsigned int> faces;
    for (unsigned int f = 0; f < bodies.faces.size(); ++f)
      if (const auto &its = bodies.faces[f].nodes;
          std::all_of(its.begin(), its.end(), [&](const auto node) {
            return nodes.count(node) > 0;
          }))
        faces.push_back(f);
    return faces;
  }

  void
  ImportConditions::find_couplings()
  {
    const InpBlock *coupling = nullptr;
    for (const InpBlock *block : steps.model)
      {
        const std::string &keyword = block->keyword;
        if (keyword == "*COUPLING")
          coupling = block;
        const bool with_coupling =
          coupling != nullptr &&
          (keyword == "*KINEMATIC" || keyword == "*DISTRIBUTING");
        if (!with_coupling && keyword != "*KINEMATIC COUPLING" &&
            keyword != "*RIGID BODY")
          continue;
        const InpBlock &source = with_coupling ? *coupling : *block;
        const auto      at =
          deck.find_nodes(source.option("REF NODE"), source.instance);
        const auto turns =
          source.has("ROT NODE") ?
            deck.find_nodes(source.option("ROT NODE"), source.instance) :
            at;
        const std::string what =
          with_coupling ? "*COUPLING with " + keyword : keyword;
        if (at.size() != 1 || turns.size() != 1)
          {
            remarks.left_out(block->place, what + " without a reference node");
            continue;
          }
        // lines of *KINEMATIC COUPLING begin with nodes or sets
        const bool               names_sets = keyword == "*KINEMATIC COUPLING";
        std::vector<std::string> sets;
        if (names_sets)
          for (const InpLine &line : block->lines)
            sets.push_back(line.words[0]);
        else
          sets = {source.has("SURFACE") ? source.option("SURFACE") :
                                          source.option("NSET")};
        std::array<bool, 3> follows = {{true, true, true}};
        if (!block->lines.empty() && keyword.rfind("*KINEMATIC", 0) == 0)
          {
            follows = {};
            for (const InpLine &line : block->lines)
              {
                auto x = import_numbers(line, names_sets ? 1 : 0);
                x.resize(2);
                if (x[0] == 0.)
                  x = {1., 6.};
                for (unsigned int c = 0; c < 3; ++c)
                  if (c + 1. >= x[0] && c + 1. <= std::max(x[0], x[1]))
                    follows[c] = true;
              }
          }
        std::set<unsigned int> unique;
        for (const std::string &set : sets)
          {
            const auto of_set = coupled_faces(source, set);
            unique.insert(of_set.begin(), of_set.end());
          }
        const std::vector<unsigned int> faces(unique.begin(), unique.end());
        if (faces.empty() || sets[0].empty())
          {
            remarks.left_out(block->place,
                             what + " of " + in_quotes(sets[0], '\'') +
                               ", which has no outer faces of a body");
            continue;
          }
        Reference reference = references.at(*at.begin());
        reference.place     = block->place;
        if (const Reference &turn = references.at(*turns.begin()); turns != at)
          for (unsigned int c = 0; c < 3; ++c)
            {
              reference.motion[3 + c] = turn.motion[c];
              reference.load[3 + c]   = turn.load[c];
            }
        if (keyword == "*DISTRIBUTING")
          add_distributed(
            faces, sets[0], reference, deck.nodes[*at.begin()], what);
        else
          add_motion(
            faces, sets[0], follows, reference, deck.nodes[*at.begin()], what);
      }
  }

  /// Faces move as a rigid body in the components that follow: u = U + R x (x -
  /// reference).
  void
  ImportConditions::add_motion(const std::vector<unsigned int> &faces,
                               const std::string               &name,
                               const std::array<bool, 3>       &follows,
                               const Reference                 &reference,
                               const Point<3>                  &at,
                               const std::string               &what)
  {
    const auto         &motion = reference.motion;
    std::array<bool, 6> needed{};
    for (unsigned int c = 0; c < 3; ++c)
      if (follows[c])
        needed[c] = needed[3 + (c + 1) % 3] = needed[3 + (c + 2) % 3] = true;
    std::string unknown;
    for (unsigned int c = 0; c < 6; ++c)
      if (needed[c] && motion[c].empty())
        unknown += (unknown.empty() ? "" : ", ") + std::to_string(c + 1);
    if (!unknown.empty())
      {
        if (follows == std::array<bool, 3>{{true, true, true}})
          return add_rigid_part(faces, name, reference, at);
        return remarks.left_out(
          reference.place,
          what + ", whose reference node is free in the components " + unknown +
            ", and which does not move all components of the face");
      }
    ImportCondition condition;
    condition.name = name;
    bool turns     = false;
    for (unsigned int c = 3; c < 6; ++c)
      turns = turns || (needed[c] && acts(motion[c]));
    if (!turns)
      {
        condition.kind = ImportCondition::Kind::support;
        for (unsigned int c = 0; c < 3; ++c)
          if (follows[c])
            {
              condition.component = c;
              condition.value[0]  = steps.history(motion[c]);
              add(condition, faces);
            }
        return;
      }
    condition.kind      = ImportCondition::Kind::motion;
    condition.reference = at;
    for (unsigned int c = 0; c < 3; ++c)
      {
        condition.displacement[c] =
          follows[c] ? steps.history(motion[c]).text() : "-";
        if (needed[3 + c])
          condition.traction[c] =
            steps.history(motion[3 + c]).times(180. / numbers::PI);
      }
    add(condition, faces);
  }

  /// Coupling = rigid: forces decide what is not given.
  void
  ImportConditions::add_rigid_part(const std::vector<unsigned int> &faces,
                                   const std::string               &name,
                                   const Reference                 &reference,
                                   const Point<3>                  &at)
  {
    ImportCondition condition;
    condition.kind      = ImportCondition::Kind::rigid_part;
    condition.name      = name;
    condition.reference = at;
    const auto text     = [](const ImportHistory &history) {
      return history.text();
    };
    for (unsigned int c = 0; c < 3; ++c)
      {
        const auto &moved  = reference.motion[c];
        const auto &turned = reference.motion[3 + c];
        if (!moved.empty())
          condition.displacement[c] = text(steps.history(moved));
        if (!turned.empty())
          condition.rotation[c] =
            text(steps.history(turned).times(180. / numbers::PI));
        condition.force.force[c]  = steps.history(reference.load[c]);
        condition.force.moment[c] = steps.history(reference.load[3 + c]);
      }
    add(condition, faces);
  }

  void
  ImportConditions::add_distributed(const std::vector<unsigned int> &faces,
                                    const std::string               &name,
                                    const Reference                 &reference,
                                    const Point<3>                  &at,
                                    const std::string               &what)
  {
    if (std::any_of(reference.motion.begin(),
                    reference.motion.end(),
                    [](const auto &m) { return !m.empty(); }))
      remarks.left_out(reference.place,
                       "the given motion of a " + what +
                         ": a mean displacement");
    if (std::none_of(reference.load.begin(), reference.load.end(), acts))
      return;
    ImportCondition condition;
    condition.kind     = ImportCondition::Kind::force;
    condition.name     = name;
    ImportForce &force = condition.force;
    force              = area_of(faces);
    for (unsigned int d = 0; d < 3; ++d)
      {
        const ImportHistory history = steps.history(reference.load[d]);
        force.force[d]              = history;
        force.moment[d] =
          force.moment[d].plus(steps.history(reference.load[3 + d]));
        Tensor<1, 3> unit;
        unit[d]                   = 1.;
        const Tensor<1, 3> moment = cross_product_3d(at - force.centroid, unit);
        for (unsigned int c = 0; c < 3; ++c)
          if (std::fabs(moment[c]) > 1e-12 * at.distance(force.centroid) &&
              acts(reference.load[d]))
            force.moment[c] = force.moment[c].plus(history.times(moment[c]));
      }
    remarks.approximated(reference.place,
                         what +
                           " is a force and a moment, spread evenly over an "
                           "area of " +
                           number_text(force.area));
    add(condition, faces);
  }
} // namespace mortise
