#include "import_interfaces.h"

#include <deal.II/base/bounding_box.h>

#include <mortise/base/quotes.h>

#include <algorithm>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::string
    law_line(const std::string &name, const std::string &value)
    {
      return "  set " + name + " = " + value + "\n";
    }

    std::string
    number_of(const InpBlock &block, const std::string &option)
    {
      return number_text(
        import_numbers({{block.option(option)}, block.place})[0]);
    }
  } // namespace

  ImportInterfaces::ImportInterfaces(ImportBodies      &bodies,
                                     ImportConditions  &conditions,
                                     const ImportSteps &steps,
                                     ImportRemarks     &remarks)
    : bodies(bodies)
    , conditions(conditions)
    , steps(steps)
    , remarks(remarks)
  {
    tie_shared_faces();
    std::string interaction;
    for (const InpBlock *block : steps.model)
      if (block->keyword == "*SURFACE INTERACTION")
        {
          interaction               = upper(block->option("NAME"));
          interactions[interaction] = block;
        }
      else if (block->keyword == "*FRICTION")
        frictions[interaction] = block;
      else if (block->keyword == "*SURFACE BEHAVIOR")
        behaviours[interaction] = block;
      else if (block->keyword == "*CLEARANCE")
        clearances.push_back(block);
    for (const InpBlock *block : steps.model)
      if (block->has("CYCLIC SYMMETRY") || block->has("MULTISCALE"))
        remarks.left_out(block->place, "*TIE of cyclic symmetry or of scales");
      else if (block->keyword == "*TIE" || block->keyword == "*CONTACT PAIR")
        for (const InpLine &line : block->lines)
          {
            const bool tie = block->keyword == "*TIE";
            if (line.words.size() < 2 ||
                upper(line.words[0]) == upper(line.words[1]))
              {
                remarks.left_out(line.place,
                                 block->keyword + " of a surface with itself");
                continue;
              }
            std::string lines = tie ? law_line("Law", "tie") :
                                      contact_lines(*block) +
                                        clearance(line.words[0], line.words[1]);
            if (tie && block->has("POSITION TOLERANCE"))
              lines +=
                law_line("Search distance",
                         "length " + number_of(*block, "POSITION TOLERANCE"));
            add_pair(tie && !block->option("NAME").empty() ?
                       block->option("NAME") :
                       line.words[0] + "-" + line.words[1],
                     line.words[0],
                     line.words[1],
                     *block,
                     line,
                     lines);
          }
  }

  std::string
  ImportInterfaces::unused_name(const std::string &name) const
  {
    std::vector<std::string> others;
    for (const Interface &its : interfaces)
      others.push_back(its.name);
    return scene_name(name, others);
  }

  /// Where bodies share nodes they hold together.
  void
  ImportInterfaces::tie_shared_faces()
  {
    std::map<std::tuple<unsigned int, unsigned int, const InpBlock *>,
             std::array<std::vector<unsigned int>, 2>>
      pairs;
    for (const ImportShared &shared : bodies.shared)
      {
        const auto [a, b] = shared.faces;
        auto &faces =
          pairs[{bodies.faces[a].body, bodies.faces[b].body, shared.cut}];
        faces[0].push_back(a);
        faces[1].push_back(b);
      }
    for (const auto &[pair, faces] : pairs)
      {
        const auto [a, b, cut] = pair;
        Interface interface;
        interface.slave_body     = a;
        interface.master_body    = b;
        const std::string slave  = bodies.bodies[a].name,
                          master = bodies.bodies[b].name;
        interface.name           = unused_name(slave + "-" + master);
        interface.lines          = law_line("Law", "tie");
        if (cut != nullptr)
          interface.lines += conditions.preload_text(*cut);
        ImportCondition condition;
        condition.kind   = ImportCondition::Kind::side;
        condition.name   = "to_" + master;
        interface.slave  = conditions.add(condition, faces[0]);
        condition.name   = "to_" + slave;
        interface.master = conditions.add(condition, faces[1]);
        interfaces.push_back(interface);
      }
  }

  ImportInterfaces::Side
  ImportInterfaces::side(const std::string &surface, const std::string &key)
  {
    std::vector<InpSide> sides;
    if (const auto found = bodies.deck.surfaces.find(key);
        found != bodies.deck.surfaces.end())
      sides = found->second;
    else if (const auto nodes = bodies.deck.node_surfaces.find(key);
             nodes != bodies.deck.node_surfaces.end())
      sides = bodies.deck.sides_of(nodes->second);
    const auto      faces = bodies.faces_of(sides);
    ImportCondition condition;
    condition.kind = ImportCondition::Kind::side;
    condition.name = surface;
    Side                   result;
    std::set<unsigned int> of;
    for (const unsigned int f : faces)
      of.insert(bodies.faces[f].body);
    result.bodies.assign(of.begin(), of.end());
    result.condition = conditions.add(condition, faces);
    return result;
  }

  bool
  ImportInterfaces::are_near(const unsigned int a, const unsigned int b) const
  {
    const auto box = [&](const unsigned int body) {
      std::vector<Point<3>> points;
      for (const unsigned int node : bodies.bodies[body].nodes)
        points.push_back(bodies.deck.nodes[node]);
      return BoundingBox<3>(points).get_boundary_points();
    };
    const auto [low, high]             = box(a);
    const auto [other_low, other_high] = box(b);
    const double reach =
      0.05 * (low.distance(high) + other_low.distance(other_high));
    for (unsigned int d = 0; d < 3; ++d)
      if (low[d] > other_high[d] + reach || other_low[d] > high[d] + reach)
        return false;
    return true;
  }

  void
  ImportInterfaces::add_pair(const std::string &name,
                             const std::string &slave,
                             const std::string &master,
                             const InpBlock    &block,
                             const InpLine     &line,
                             const std::string &lines)
  {
    const Side one =
                 side(slave, bodies.deck.find_surface(slave, block.instance)),
               other =
                 side(master, bodies.deck.find_surface(master, block.instance));
    if (one.bodies.empty() || other.bodies.empty())
      return remarks.left_out(line.place,
                              block.keyword + " of " +
                                in_quotes(one.bodies.empty() ? slave : master,
                                          '\'') +
                                ", which has no outer faces of a body");
    const bool several = one.bodies.size() * other.bodies.size() > 1;
    for (const unsigned int s : one.bodies)
      for (const unsigned int m : other.bodies)
        {
          if (s == m)
            {
              remarks.left_out(line.place,
                               block.keyword + " of the body " +
                                 bodies.bodies[s].name + " with itself");
              continue;
            }
          if (several && !are_near(s, m))
            continue;
          Interface interface;
          interface.slave_body  = s;
          interface.master_body = m;
          interface.slave       = one.condition;
          interface.master      = other.condition;
          interface.lines       = lines;
          interface.name        = unused_name(name);
          if (block.keyword == "*CONTACT PAIR")
            conditions.hold_edges(s, one.condition, line.place);
          interfaces.push_back(interface);
        }
  }

  std::string
  ImportInterfaces::contact_lines(const InpBlock &block)
  {
    const std::string interaction = upper(block.option("INTERACTION"));
    const auto        behaviour   = behaviours.find(interaction);
    std::string       kind        = "HARD";
    if (behaviour != behaviours.end())
      {
        const InpBlock &its = *behaviour->second;
        kind                = upper(its.option("PRESSURE-OVERCLOSURE"));
        if (kind == "TIED" || its.has("NO SEPARATION"))
          {
            remarks.approximated(its.place,
                                 kind == "TIED" ?
                                   "PRESSURE-OVERCLOSURE=TIED is a tie" :
                                   "NO SEPARATION is Law = slide");
            return law_line("Law", kind == "TIED" ? "tie" : "slide");
          }
        if (!kind.empty() && kind != "HARD")
          remarks.approximated(its.place,
                               "PRESSURE-OVERCLOSURE=" + kind +
                                 " is hard contact, without penetration");
      }
    if (block.has("ADJUST"))
      remarks.approximated(block.place,
                           "ADJUST: no node is moved; gaps and overlaps of "
                           "the meshes count");
    std::string lines = law_line("Law", "contact");
    if (const auto friction = frictions.find(interaction);
        friction != frictions.end() && !friction->second->lines.empty())
      {
        const auto numbers = import_numbers(friction->second->lines[0]);
        if (!numbers.empty() && numbers[0] > 0.)
          lines += law_line("Friction coefficient", number_text(numbers[0]));
        if (friction->second->has("ROUGH"))
          remarks.left_out(friction->second->place, "*FRICTION, ROUGH");
      }
    if (steps.finite && block.has("SMALL SLIDING"))
      lines += law_line("Sliding", "small");
    return lines;
  }

  std::string
  ImportInterfaces::clearance(const std::string &slave,
                              const std::string &master) const
  {
    for (const InpBlock *block : clearances)
      if (upper(block->option("SLAVE")) == upper(slave) &&
          upper(block->option("MASTER")) == upper(master))
        return law_line("Offset", number_of(*block, "VALUE")) +
               law_line("Mesh gap", "ignored");
    return "";
  }

  std::string
  ImportInterfaces::names() const
  {
    std::string text;
    for (const Interface &interface : interfaces)
      text += (text.empty() ? "" : ", ") + interface.name;
    return text;
  }

  std::string
  ImportInterfaces::text() const
  {
    std::string text;
    for (const auto &[name, slave_body, master_body, slave, master, lines] :
         interfaces)
      {
        std::string sides[2] = {conditions.side_text(slave_body, slave),
                                conditions.side_text(master_body, master)};
        // the slave must not be held
        if (conditions.is_held(slave_body, slave) &&
            !conditions.is_held(master_body, master))
          {
            std::swap(sides[0], sides[1]);
            sides[0] += "  # exchanged: the slave of the deck is held";
          }
        text += "\nsubsection Interface " + name +
                "\n  set Slave  = " + sides[0] +
                "\n  set Master = " + sides[1] + "\n" + lines + "end\n";
      }
    return text;
  }
} // namespace mortise
