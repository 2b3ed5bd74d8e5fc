#include <mortise/base/error.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "import_conditions.h"

namespace mortise
{
  using namespace dealii;

  void
  ImportConditions::read_boundary(const InpBlock &block, const std::size_t step)
  {
    if (block.has("TYPE") && upper(block.option("TYPE")) != "DISPLACEMENT")
      return remarks.left_out(block.place,
                              "*BOUNDARY, TYPE=" + block.option("TYPE"));
    if (upper(block.option("OP")) == "NEW")
      new_supports.emplace(step, block.place);
    static const std::map<std::string, std::vector<unsigned int>> kinds = {
      {"ENCASTRE", {0, 1, 2}},
      {"PINNED", {0, 1, 2}},
      {"XSYMM", {0}},
      {"YSYMM", {1}},
      {"ZSYMM", {2}}};
    for (const InpLine &line : block.lines)
      {
        const std::string kind =
          line.words.size() > 1 ? upper(line.words[1]) : "";
        if (const auto found = kinds.find(kind); found != kinds.end())
          {
            for (const unsigned int component : found->second)
              prescribe(block, line, component, 0., step);
            continue;
          }
        auto numbers = import_numbers(line, 1);
        numbers.resize(3);
        if (numbers[0] < 1.)
          {
            remarks.left_out(line.place, "*BOUNDARY without a component");
            continue;
          }
        if (numbers[1] == 0.) // "12, 3" and "12, 3, , 0.1"
          numbers[1] = numbers[0];
        if (numbers[1] > 3.)
          remarks.left_out(line.place, "*BOUNDARY of the components beyond 3");
        for (unsigned int c = numbers[0] - 1.; c < std::min(numbers[1], 3.);
             ++c)
          prescribe(block, line, c, numbers[2], step);
      }
  }

  void
  ImportConditions::prescribe(const InpBlock    &block,
                              const InpLine     &line,
                              const unsigned int component,
                              const double       value,
                              const std::size_t  step)
  {
    const auto nodes = deck.find_nodes(line.words[0], block.instance);
    if (nodes.empty())
      return remarks.left_out(line.place,
                              "*BOUNDARY of " + in_quotes(line.words[0], '\'') +
                                ", which has no nodes");
    const ImportChange change = {step, value, upper(block.option("AMPLITUDE"))};
    const std::string  name   = nodes.size() > 1 ? line.words[0] : "";
    auto               source =
      std::find_if(sources.begin(), sources.end(), [&](const auto &s) {
        return s.name == name && (!name.empty() || s.place == block.place);
      });
    if (source == sources.end())
      {
        sources.emplace_back();
        source        = sources.end() - 1;
        source->name  = name;
        source->place = name.empty() ? block.place : line.place;
      }
    ImportSteps::change(source->changes[component], change);
    for (const unsigned int node : nodes)
      if (bodies.bodies_of_node[node].empty())
        remarks.left_out(line.place, "*BOUNDARY of a node of no body");
      else
        {
          source->nodes.insert(node);
          Supported &entry = supported[component][node];
          entry.source     = source - sources.begin();
          ImportSteps::change(entry.changes, change);
        }
  }

  void
  ImportConditions::tell_released_supports()
  {
    for (const auto &[step, place] : new_supports)
      for (const auto &component : supported)
        if (std::any_of(component.begin(),
                        component.end(),
                        [step = step](const auto &entry) {
                          const auto &changes = entry.second.changes;
                          return changes.front().step < step &&
                                 std::none_of(changes.begin(),
                                              changes.end(),
                                              [step](const auto &change) {
                                                return change.step == step;
                                              });
                        }))
          remarks.approximated(place,
                               "*BOUNDARY, OP=NEW: what was held before stays "
                               "held");
  }

  namespace
  {
    /// The normal, of length 1.
    Tensor<1, 3>
    normal_of(const InpDeck &deck, const ImportFace &face)
    {
      const auto  &x             = deck.nodes;
      const auto  &n             = face.nodes;
      const bool   quadrilateral = face.n_vertices == 4;
      Tensor<1, 3> normal =
        cross_product_3d(x[n[quadrilateral ? 2 : 1]] - x[n[0]],
                         x[n[quadrilateral ? 3 : 2]] -
                           x[n[quadrilateral ? 1 : 0]]);
      return normal / normal.norm();
    }

    /// Numbers of the patches that @p faces form where they meet smoothly.
    std::vector<unsigned int>
    smooth_patches_of(const ImportBodies              &bodies,
                      const std::vector<unsigned int> &faces)
    {
      std::vector<unsigned int> root(faces.size());
      std::iota(root.begin(), root.end(), 0u);
      const auto find = [&](unsigned int i) {
        while (root[i] != i)
          i = root[i] = root[root[i]];
        return i;
      };
      std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>>
        at_edge;
      for (unsigned int i = 0; i < faces.size(); ++i)
        {
          const ImportFace &face = bodies.faces[faces[i]];
          for (unsigned int v = 0; v < face.n_vertices; ++v)
            at_edge[std::minmax(
                      {face.nodes[v], face.nodes[(v + 1) % face.n_vertices]})]
              .push_back(i);
        }
      const double smooth = std::cos(40. * numbers::PI / 180.);
      for (const auto &edge : at_edge)
        for (const unsigned int i : edge.second)
          for (const unsigned int j : edge.second)
            if (bodies.faces[faces[i]].body == bodies.faces[faces[j]].body &&
                normal_of(bodies.deck, bodies.faces[faces[i]]) *
                    normal_of(bodies.deck, bodies.faces[faces[j]]) >
                  smooth)
              root[std::max(find(i), find(j))] = std::min(find(i), find(j));
      for (unsigned int i = 0; i < faces.size(); ++i)
        root[i] = find(i);
      return root;
    }
  } // namespace

  /// Faces of which all nodes are held in a component, without those that only
  /// connect others, as the sides of a plate with one layer of elements whose
  /// bottom and top are held: their nodes are all on faces along the component,
  /// or on other patches with nodes of their own.
  std::vector<unsigned int>
  ImportConditions::held_faces(const unsigned int component) const
  {
    std::vector<unsigned int> faces, across;
    std::set<unsigned int>    all, of_across;
    for (unsigned int f = 0; f < bodies.faces.size(); ++f)
      if (const auto &nodes = bodies.faces[f].nodes;
          std::all_of(nodes.begin(), nodes.end(), [&](const auto n) {
            return supported[component].count(n) > 0;
          }))
        {
          faces.push_back(f);
          all.insert(nodes.begin(), nodes.end());
          if (std::fabs(normal_of(deck, bodies.faces[f])[component]) > 0.9)
            {
              across.push_back(f);
              of_across.insert(nodes.begin(), nodes.end());
            }
        }
    if (of_across == all)
      return across;
    const auto patch = smooth_patches_of(bodies, faces);
    std::map<unsigned int, std::set<unsigned int>> patches_of_node;
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (const unsigned int node : bodies.faces[faces[i]].nodes)
        patches_of_node[node].insert(patch[i]);
    std::set<unsigned int> needed;
    for (const auto &entry : patches_of_node)
      if (entry.second.size() == 1)
        needed.insert(*entry.second.begin());
    std::set<unsigned int> not_needed;
    for (std::size_t i = 0; i < faces.size(); ++i)
      not_needed.insert(patch[i]);
    for (const unsigned int p : needed)
      not_needed.erase(p);
    for (const auto &entry : patches_of_node)
      if (std::none_of(entry.second.begin(),
                       entry.second.end(),
                       [&](const auto p) { return needed.count(p) > 0; }))
        for (const unsigned int p : entry.second)
          not_needed.erase(p);
    std::vector<unsigned int> result;
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (not_needed.count(patch[i]) == 0)
        result.push_back(faces[i]);
    return result;
  }

  /// A face has the prescribed displacement that all of its nodes have.
  void
  ImportConditions::find_supports()
  {
    std::map<std::string, std::pair<ImportCondition, std::vector<unsigned int>>>
      found;
    for (unsigned int c = 0; c < 3; ++c)
      {
        std::set<unsigned int>    covered;
        std::vector<unsigned int> mixed;
        for (const unsigned int f : held_faces(c))
          {
            const auto &nodes   = bodies.faces[f].nodes;
            const auto  axes_at = [&](const unsigned int node) {
              const auto axes = local_axes.find(node);
              return axes == local_axes.end() ? "" : axes->second;
            };
            const std::string axes = axes_at(nodes[0]);
            if (axes == "round" ||
                !std::all_of(nodes.begin(), nodes.end(), [&](const auto n) {
                  return axes_at(n) == axes;
                }))
              continue;
            // that of a set with all nodes, else that of each node
            const Supported                 &first = supported[c].at(nodes[0]);
            const std::vector<ImportChange> *changes = nullptr;
            std::string                      name;
            if (std::all_of(nodes.begin(), nodes.end(), [&](const auto n) {
                  return supported[c].at(n).changes == first.changes;
                }))
              changes = &first.changes;
            for (const Source &source : sources)
              if (!source.name.empty() && !source.changes[c].empty() &&
                  std::all_of(nodes.begin(),
                              nodes.end(),
                              [&](const auto n) {
                                return source.nodes.count(n) > 0;
                              }) &&
                  (changes == nullptr || source.changes[c] == *changes))
                {
                  name    = source.name;
                  changes = &source.changes[c];
                  break;
                }
            if (changes == nullptr)
              {
                mixed.push_back(f);
                continue;
              }
            covered.insert(nodes.begin(), nodes.end());
            ImportCondition condition;
            condition.kind      = ImportCondition::Kind::support;
            condition.name      = name.empty() ? "held" : name;
            condition.component = c;
            condition.axes      = axes;
            condition.value[0]  = steps.history(*changes);
            auto &entry = found[condition.name + ":" + std::to_string(c) + ":" +
                                axes + ":" + condition.value[0].text()];
            entry.first = condition;
            entry.second.push_back(f);
          }
        find_affine_supports(c, mixed);
        for (const unsigned int f : mixed)
          covered.insert(bodies.faces[f].nodes.begin(),
                         bodies.faces[f].nodes.end());
        std::map<unsigned int, unsigned int> left;
        for (const auto &[node, entry] : supported[c])
          if (covered.count(node) == 0)
            ++left[entry.source];
        for (const auto &[source, n] : left)
          remarks.left_out(sources[source].place,
                           "*BOUNDARY of component " + std::to_string(c + 1) +
                             " at " + std::to_string(n) +
                             (n == 1 ? " node that is" : " nodes that are") +
                             " not those of a face" +
                             (sources[source].name.empty() ?
                                "" :
                                " (" + sources[source].name + ")"));
      }
    for (const auto &entry : found)
      add(entry.second.first, entry.second.second);
  }

  /// Values that differ from node to node, of each body and set of steps.
  void
  ImportConditions::find_affine_supports(const unsigned int component,
                                         const std::vector<unsigned int> &faces)
  {
    std::map<std::string, std::vector<unsigned int>> groups;
    const auto kind_of = [&](const unsigned int node) {
      std::string kind;
      for (const ImportChange &change : supported[component].at(node).changes)
        kind += std::to_string(change.step) + "," + change.amplitude + ",";
      return kind;
    };
    for (const unsigned int f : faces)
      groups[std::to_string(bodies.faces[f].body) + ":" +
             kind_of(bodies.faces[f].nodes[0])]
        .push_back(f);
    for (const auto &group : groups)
      {
        std::set<unsigned int> nodes;
        for (const unsigned int f : group.second)
          nodes.insert(bodies.faces[f].nodes.begin(),
                       bodies.faces[f].nodes.end());
        std::vector<Point<3>> points;
        for (const unsigned int node : nodes)
          points.push_back(deck.nodes[node]);
        const Supported &first = supported[component].at(*nodes.begin());
        bool fits = std::all_of(nodes.begin(), nodes.end(), [&](const auto n) {
          return kind_of(n) == kind_of(*nodes.begin());
        });
        std::array<std::vector<ImportChange>, 4> coefficients;
        for (std::size_t i = 0; fits && i < first.changes.size(); ++i)
          {
            std::vector<double> values;
            for (const unsigned int node : nodes)
              values.push_back(supported[component].at(node).changes[i].value);
            const auto fit = affine_fit(points, values);
            fits           = !fit.empty();
            for (unsigned int k = 0; fits && k < 4; ++k)
              coefficients[k].push_back(
                {first.changes[i].step, fit[k], first.changes[i].amplitude});
          }
        if (!fits)
          {
            remarks.left_out(sources[first.source].place,
                             "*BOUNDARY of component " +
                               std::to_string(component + 1) + " at " +
                               std::to_string(nodes.size()) +
                               " nodes, whose values are no linear function of "
                               "x, y, z");
            continue;
          }
        ImportCondition condition;
        condition.kind      = ImportCondition::Kind::support;
        condition.component = component;
        condition.name      = sources[first.source].name.empty() ?
                                "moved" :
                                sources[first.source].name;
        for (unsigned int k = 0; k < 4; ++k)
          condition.value[k] = steps.history(coefficients[k]);
        add(condition, group.second);
      }
  }
} // namespace mortise
