#include "import_bodies.h"

#include <mortise/base/error.h>
#include <mortise/body/mesh/inp_shapes.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <set>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    bool
    is_taken(const std::string &name, const std::vector<std::string> &others)
    {
      return std::any_of(others.begin(), others.end(), [&](const auto &other) {
        return upper(other) == upper(name);
      });
    }
  } // namespace

  std::string
  scene_name(const std::string &name, const std::vector<std::string> &others)
  {
    std::string result = name;
    for (char &c : result)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' &&
          c != '-')
        c = '_';
    if (result.empty() || std::isdigit(static_cast<unsigned char>(result[0])))
      result = "part_" + result;
    if (!is_taken(result, others))
      return result;
    unsigned int number = 2;
    while (is_taken(result + "_" + std::to_string(number), others))
      ++number;
    return result + "_" + std::to_string(number);
  }

  ImportBodies::ImportBodies(const InpDeck &deck, ImportRemarks &remarks)
    : deck(deck)
  {
    find_cuts();
    find_bodies(sections(remarks));
    name_bodies();
    find_faces();
    for (const InpBlock &block : deck.blocks)
      if (block.keyword == "*PRE-TENSION SECTION" &&
          std::none_of(shared.begin(), shared.end(), [&](const auto &s) {
            return s.cut == &block;
          }))
        remarks.left_out(block.place,
                         block.keyword +
                           " that is no cut of a body into two by a *SURFACE "
                           "of faces");
  }

  SideKey
  ImportBodies::key_of(const InpSide &side) const
  {
    SideKey key;
    for (const unsigned int v :
         inp_shape(deck.elements[side.element].n_vertices).faces[side.face])
      key.push_back(deck.elements[side.element].nodes[v]);
    std::sort(key.begin(), key.end());
    return key;
  }

  void
  ImportBodies::find_cuts()
  {
    is_cut.resize(deck.nodes.size(), false);
    for (const InpBlock &block : deck.blocks)
      if (block.keyword == "*PRE-TENSION SECTION")
        if (const auto surface = deck.surfaces.find(
              deck.find_surface(block.option("SURFACE"), block.instance));
            surface != deck.surfaces.end())
          for (const InpSide &side : surface->second)
            {
              cuts.emplace(key_of(side), &block);
              for (const unsigned int node : deck.nodes_of(side))
                is_cut[node] = true;
            }
  }

  /// The *SOLID SECTION of each element, nullptr for those without.
  std::vector<const InpBlock *>
  ImportBodies::sections(ImportRemarks &remarks) const
  {
    std::vector<const InpBlock *> section_of(deck.elements.size(), nullptr);
    for (const InpBlock &block : deck.blocks)
      if (block.keyword == "*SOLID SECTION")
        for (const unsigned int e :
             deck.find_elements(block.option("ELSET"), block.instance))
          section_of[e] = &block;
      else if (block.keyword != "*PRE-TENSION SECTION" &&
               block.keyword.size() > 8 &&
               block.keyword.compare(block.keyword.size() - 8, 8, " SECTION") ==
                 0)
        remarks.left_out(block.place, block.keyword + ", which is no solid");
    for (const auto &[place, what] : deck.passed_over)
      remarks.left_out(place, what + ", which is no solid");
    std::size_t without = 0, solids = 0;
    for (std::size_t e = 0; e < section_of.size(); ++e)
      {
        solids += deck.elements[e].dimension == 3;
        without += deck.elements[e].dimension == 3 && section_of[e] == nullptr;
        if (deck.elements[e].dimension != 3)
          section_of[e] = nullptr;
      }
    if (solids == 0)
      throw InputError("--import: the deck has no solid elements; allowed: "
                       "C3D4, C3D6, C3D8, C3D10, C3D15 and C3D20");
    if (without == solids)
      throw InputError(
        "--import: the deck has " + std::to_string(solids) +
        " solid elements, and none of them has a *SOLID SECTION with a "
        "material; allowed: solids with their sections");
    if (without > 0)
      remarks.left_out("elements",
                       std::to_string(without) +
                         " solids without *SOLID SECTION");
    return section_of;
  }

  /// Elements that share nodes off the cuts and have one material and
  /// orientation are one body.
  void
  ImportBodies::find_bodies(const std::vector<const InpBlock *> &section_of)
  {
    std::vector<unsigned int> root(deck.elements.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](unsigned int e) {
      while (root[e] != e)
        e = root[e] = root[root[e]];
      return e;
    };
    const auto kind = [&](const InpBlock &section) {
      return upper(section.option("MATERIAL")) + "," +
             upper(section.option("ORIENTATION")) + "," + section.instance;
    };
    std::vector<std::map<std::string, unsigned int>> first(deck.nodes.size());
    for (unsigned int e = 0; e < root.size(); ++e)
      if (section_of[e] != nullptr)
        for (const unsigned int node : deck.elements[e].nodes)
          {
            if (is_cut[node])
              continue;
            const auto entry = first[node].emplace(kind(*section_of[e]), e);
            const auto a = find(entry.first->second), b = find(e);
            root[std::max(a, b)] = std::min(a, b);
          }
    std::map<unsigned int, unsigned int> body_of;
    bodies_of_node.resize(deck.nodes.size());
    for (unsigned int e = 0; e < root.size(); ++e)
      if (section_of[e] != nullptr)
        {
          const auto [entry, is_new] = body_of.emplace(find(e), bodies.size());
          if (is_new)
            {
              bodies.emplace_back();
              bodies.back().section = section_of[e];
            }
          bodies[entry->second].elements.push_back(e);
          for (const unsigned int node : deck.elements[e].nodes)
            if (auto &list = bodies_of_node[node];
                std::count(list.begin(), list.end(), entry->second) == 0)
              list.push_back(entry->second);
        }
    for (unsigned int node = 0; node < deck.nodes.size(); ++node)
      for (const unsigned int b : bodies_of_node[node])
        bodies[b].nodes.push_back(node);
  }

  void
  ImportBodies::name_bodies()
  {
    std::vector<std::string> wanted, taken;
    for (const ImportBody &body : bodies)
      {
        const std::string instance = body.section->instance;
        const auto        others =
          std::count_if(bodies.begin(),
                        bodies.end(),
                        [&](const ImportBody &other) {
                          return other.section->instance == instance;
                        });
        wanted.push_back(
          !instance.empty() && others == 1 ?
            deck.names.at(instance) :
            (instance.empty() ? "" : deck.names.at(instance) + "_") +
              body.section->option("ELSET"));
      }
    for (std::size_t b = 0; b < bodies.size(); ++b)
      {
        std::string name = wanted[b];
        if (std::count(wanted.begin(), wanted.end(), name) > 1)
          name +=
            "_" + std::to_string(
                    1 + std::count(wanted.begin(), wanted.begin() + b, name));
        bodies[b].name = scene_name(name, taken);
        taken.push_back(bodies[b].name);
      }
  }

  void
  ImportBodies::find_faces()
  {
    std::map<SideKey, std::vector<std::pair<unsigned int, InpSide>>> sides;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      for (const unsigned int e : bodies[b].elements)
        {
          const auto &shape = inp_shape(deck.elements[e].n_vertices);
          for (unsigned int f = 0; f < shape.faces.size(); ++f)
            sides[key_of({e, f})].push_back({b, {e, f}});
        }
    for (const auto &[key, at] : sides)
      {
        const std::size_t before = faces.size();
        for (const auto &[b, side] : at)
          if (std::count_if(at.begin(), at.end(), [b = b](const auto &other) {
                return other.first == b;
              }) == 1)
            {
              ImportFace face;
              face.side                        = side;
              face.body                        = b;
              face.nodes                       = deck.nodes_of(side);
              face.n_vertices                  = key.size();
              place[{side.element, side.face}] = faces.size();
              faces.push_back(face);
            }
        if (faces.size() == before + 2)
          {
            const auto cut = cuts.find(key);
            shared.push_back({{{static_cast<unsigned int>(before),
                                static_cast<unsigned int>(before + 1)}},
                              cut == cuts.end() ? nullptr : cut->second});
          }
      }
  }

  Tensor<1, 3>
  ImportBodies::normal_of(const ImportFace &face) const
  {
    const auto  &x             = deck.nodes;
    const auto  &n             = face.nodes;
    const bool   quadrilateral = face.n_vertices == 4;
    Tensor<1, 3> normal        = cross_product_3d(x[n[quadrilateral ? 3 : 2]] -
                                             x[n[quadrilateral ? 1 : 0]],
                                           x[n[quadrilateral ? 2 : 1]] -
                                             x[n[0]]); // seen from within
    const double length        = normal.norm();
    return length > 0. ? normal / length : normal;
  }

  std::vector<unsigned int>
  ImportBodies::faces_of(const std::vector<InpSide> &sides) const
  {
    std::set<unsigned int> result;
    for (const InpSide &side : sides)
      if (const auto found = place.find({side.element, side.face});
          found != place.end())
        result.insert(found->second);
    return {result.begin(), result.end()};
  }
} // namespace mortise
