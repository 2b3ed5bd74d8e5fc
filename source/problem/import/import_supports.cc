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
      {"ENCASTRE", {0, 1, 2, 3, 4, 5}},
      {"PINNED", {0, 1, 2}},
      {"XSYMM", {0, 4, 5}},
      {"YSYMM", {1, 3, 5}},
      {"ZSYMM", {2, 3, 4}},
      {"XASYMM", {1, 2, 3}},
      {"YASYMM", {0, 2, 4}},
      {"ZASYMM", {0, 1, 5}}};
    for (const InpLine &line : block.lines)
      {
        const std::string kind =
          line.words.size() > 1 ? upper(line.words[1]) : "";
        if (const auto found = kinds.find(kind); found != kinds.end())
          {
            prescribe(block, line, found->second, 0., step);
            continue;
          }
        auto numbers = import_numbers(line, 1);
        numbers.resize(3);
        if (numbers[1] == 0.) // "12, 3" and "12, 3, , 0.1"
          numbers[1] = numbers[0];
        if (numbers[0] < 1. || numbers[1] > 6.)
          {
            remarks.left_out(line.place,
                             "*BOUNDARY of the component " +
                               number_text(numbers[0] < 1. ? numbers[0] :
                                                             numbers[1]));
            continue;
          }
        std::vector<unsigned int> components;
        for (unsigned int c = numbers[0] - 1.; c < numbers[1]; ++c)
          components.push_back(c);
        prescribe(block, line, components, numbers[2], step);
      }
  }

  /// Nodes of solids have three components, references six.
  void
  ImportConditions::prescribe(const InpBlock                  &block,
                              const InpLine                   &line,
                              const std::vector<unsigned int> &components,
                              const double                     value,
                              const std::size_t                step)
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
    for (const unsigned int c : components)
      if (c < 3)
        ImportSteps::change(source->changes[c], change);
    for (const unsigned int node : nodes)
      if (const auto reference = references.find(node);
          reference != references.end())
        for (const unsigned int c : components)
          ImportSteps::change(reference->second.motion[c], change);
      else if (bodies.bodies_of_node[node].empty())
        remarks.left_out(line.place, "*BOUNDARY of a node of no body");
      else
        {
          source->nodes.insert(node);
          for (const unsigned int c : components)
            if (c < 3)
              {
                Supported &entry = supported[c][node];
                entry.source     = source - sources.begin();
                ImportSteps::change(entry.changes, change);
              }
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
    /// Steps and amplitudes: what may differ is the value.
    std::string
    kind_of(const std::vector<ImportChange> &changes)
    {
      std::string kind;
      for (const ImportChange &change : changes)
        kind += std::to_string(change.step) + "," + change.amplitude + ",";
      return kind;
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
                bodies.normal_of(bodies.faces[faces[i]]) *
                    bodies.normal_of(bodies.faces[faces[j]]) >
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
          if (component < 3 &&
              std::fabs(bodies.normal_of(bodies.faces[f])[component]) > 0.9)
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

  /// Components along the axes of *TRANSFORM that together are components along
  /// axes of the scene, as all three are, are these, too.
  void
  ImportConditions::turn_supports()
  {
    for (const auto &[node, system] : local_axes)
      {
        for (Source &source : sources) // whose changes are along other axes
          source.nodes.erase(node);
        std::vector<unsigned int> held;
        for (unsigned int c = 0; c < 3; ++c)
          if (const auto entry = supported[c].find(node);
              entry != supported[c].end())
            {
              supported[3 + c].insert(*entry);
              supported[c].erase(entry);
              held.push_back(c);
            }
        for (unsigned int n = held.size(); n > 0; --n)
          for (unsigned int mask = 1; mask < (1u << held.size()); ++mask)
            {
              std::vector<unsigned int> of;
              Tensor<2, 3>              onto;
              for (unsigned int i = 0; i < held.size(); ++i)
                if ((mask >> i) % 2 == 1)
                  {
                    of.push_back(held[i]);
                    const Tensor<1, 3> a = axis_of(system.axes, held[i]);
                    onto += outer_product(a, a);
                  }
              Tensor<2, 3> rounded;
              for (unsigned int d = 0; d < 3; ++d)
                rounded[d][d] = std::round(onto[d][d]);
              const Supported &first = supported[3 + of[0]].at(node);
              if (of.size() != n || (onto - rounded).norm() > 1e-9 ||
                  !std::all_of(of.begin(), of.end(), [&](const auto c) {
                    return kind_of(supported[3 + c].at(node).changes) ==
                           kind_of(first.changes);
                  }))
                continue;
              for (const unsigned int c : of)
                scene_axes[node][c] = true;
              for (unsigned int d = 0; d < 3; ++d)
                if (rounded[d][d] > 0.)
                  {
                    Supported &entry = supported[d][node] = first;
                    for (std::size_t i = 0; i < entry.changes.size(); ++i)
                      {
                        entry.changes[i].value = 0.;
                        for (const unsigned int c : of)
                          if (std::fabs(system.axes[d][c]) > 1e-9)
                            entry.changes[i].value +=
                              system.axes[d][c] *
                              supported[3 + c].at(node).changes[i].value;
                      }
                  }
              n = 1; // the largest ones only
              break;
            }
      }
  }

  /// Component and axes of a support of @p face along its local axes, and 1, or
  /// -1 where it is against the normal; 0 if there are none for the whole face.
  double
  ImportConditions::set_axes(const ImportFace  &face,
                             const unsigned int component,
                             ImportCondition   &condition) const
  {
    const LocalSystem &first = local_axes.at(face.nodes[0]);
    const auto         all   = [&](const auto &is) {
      return std::all_of(face.nodes.begin(),
                         face.nodes.end(),
                         [&](const auto n) { return is(n, local_axes.at(n)); });
    };
    condition.component = component;
    condition.axes      = first.axes;
    if (all([&](const unsigned int, const LocalSystem &at) {
          return (at.axes - first.axes).norm() < 1e-9;
        }))
      return 1.;
    const Tensor<1, 3> axis = axis_of(first.axes, 2);
    if (!all([&](const unsigned int, const LocalSystem &at) {
          return at.round && (axis_of(at.axes, 2) - axis).norm() < 1e-9;
        }))
      return 0.;
    if (component == 2)
      {
        Tensor<1, 3> across; // any
        across[std::fabs(axis[0]) < 0.6 ? 0 : 1] = 1.;
        across -= (across * axis) * axis;
        condition.axes = axes_of(across, cross_product_3d(axis, across), "");
        return 1.;
      }
    // a face of the cylinder that is held along its normal alone
    const Tensor<1, 3> normal = bodies.normal_of(face);
    const double       sense  = normal * axis_of(first.axes, 0);
    if (component != 0 || std::fabs(sense) < 0.5 ||
        !all([&](const unsigned int, const LocalSystem &at) {
          return std::fabs(at.radius - first.radius) < 1e-6 * first.radius;
        }))
      return 0.;
    for (unsigned int c = 0; c < 6; ++c)
      if (c != 3 && all([&](const unsigned int n, const LocalSystem &) {
            return supported[c].count(n) > 0;
          }))
        return 0.;
    condition.component = ImportCondition::normal;
    condition.axes      = Tensor<2, 3>();
    return sense > 0. ? 1. : -1.;
  }

  /// A face has the prescribed displacement that all of its nodes have.
  void
  ImportConditions::find_supports()
  {
    turn_supports();
    std::map<std::string, std::pair<ImportCondition, std::vector<unsigned int>>>
      found;
    for (unsigned int c = 0; c < 6; ++c)
      {
        std::vector<unsigned int> mixed;
        for (const unsigned int f : held_faces(c))
          {
            const auto     &nodes = bodies.faces[f].nodes;
            ImportCondition condition;
            condition.kind      = ImportCondition::Kind::support;
            condition.component = c;
            const bool is_scene =
              c >= 3 &&
              std::all_of(nodes.begin(), nodes.end(), [&](const auto n) {
                const auto at = scene_axes.find(n);
                return at != scene_axes.end() && at->second[c - 3];
              });
            const double sense =
              c < 3    ? 1. :
              is_scene ? 0. :
                         set_axes(bodies.faces[f], c - 3, condition);
            if (sense == 0.)
              continue;
            // that of a set with all nodes, else that of each node
            const Supported                 &first = supported[c].at(nodes[0]);
            const std::vector<ImportChange> *changes = nullptr;
            std::string                      name;
            if (std::all_of(nodes.begin(), nodes.end(), [&](const auto n) {
                  return supported[c].at(n).changes == first.changes;
                }))
              {
                changes = &first.changes;
                if (std::all_of(nodes.begin(), nodes.end(), [&](const auto n) {
                      return supported[c].at(n).source == first.source;
                    }))
                  name = sources[first.source].name;
              }
            for (const Source &source : sources)
              if (c < 3 && !source.name.empty() && !source.changes[c].empty() &&
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
                if (c < 3)
                  mixed.push_back(f);
                continue;
              }
            covered[c].insert(nodes.begin(), nodes.end());
            condition.name     = name.empty() ? "held" : name;
            condition.value[0] = steps.history(*changes).times(sense);
            auto &entry = found[condition.name + ":" + std::to_string(c) + ":" +
                                std::to_string(condition.component) + ":" +
                                angles_text(condition.axes) + ":" +
                                condition.value[0].text()];
            entry.first = condition;
            entry.second.push_back(f);
          }
        find_affine_supports(c, mixed);
        for (const unsigned int f : mixed)
          covered[c].insert(bodies.faces[f].nodes.begin(),
                            bodies.faces[f].nodes.end());
      }
    for (const auto &entry : found)
      add(entry.second.first, entry.second.second);
    find_points();
  }

  /// Values that differ from node to node, of each body and set of steps.
  void
  ImportConditions::find_affine_supports(const unsigned int component,
                                         const std::vector<unsigned int> &faces)
  {
    std::map<std::string, std::vector<unsigned int>> groups;
    const auto kind_at = [&](const unsigned int node) {
      return kind_of(supported[component].at(node).changes);
    };
    for (const unsigned int f : faces)
      groups[std::to_string(bodies.faces[f].body) + ":" +
             kind_at(bodies.faces[f].nodes[0])]
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
          return kind_at(n) == kind_at(*nodes.begin());
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
