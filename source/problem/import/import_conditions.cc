#include "import_conditions.h"

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace mortise
{
  using namespace dealii;

  ImportConditions::ImportConditions(ImportBodies      &bodies,
                                     const ImportSteps &steps,
                                     ImportRemarks     &remarks)
    : bodies(bodies)
    , deck(bodies.deck)
    , steps(steps)
    , remarks(remarks)
  {
    for (const InpBlock *block : steps.model)
      read(*block, 0);
    for (std::size_t step = 0; step < steps.steps.size(); ++step)
      for (const InpBlock *block : steps.steps[step].blocks)
        read(*block, step + 1);
    tell_released_supports();
    find_supports();
    find_forces();
    // elements that are loaded alike, each in a line of its own, are one load
    std::map<std::string, std::pair<ImportCondition, std::set<unsigned int>>>
      loads;
    for (const auto &entry : face_loads)
      {
        const FaceLoad     &load      = entry.second;
        ImportCondition     condition = load.condition;
        const ImportHistory history   = steps.history(load.changes);
        condition.value[0]            = history;
        std::string key = condition.name + ":" + history.text() + ":";
        for (std::size_t d = 0; d < load.direction.size(); ++d)
          {
            condition.traction[d] = history.times(load.direction[d]);
            key += number_text(load.direction[d]) + ",";
          }
        auto &found = loads[key];
        found.first = condition;
        found.second.insert(load.faces.begin(), load.faces.end());
      }
    for (const auto &entry : loads)
      add(entry.second.first,
          {entry.second.second.begin(), entry.second.second.end()});
  }

  void
  ImportConditions::read(const InpBlock &block, const std::size_t step)
  {
    static const std::set<std::string> acting = {
      "*BOUNDARY", "*CLOAD", "*DLOAD", "*DSLOAD", "*TEMPERATURE"};
    if (acting.count(block.keyword) > 0)
      {
        for (const std::string option :
             {"USER", "SUBMODEL", "FIXED", "FILE", "CYCLIC MODE"})
          if (block.has(option))
            return remarks.left_out(block.place, block.keyword + ", " + option);
        for (const std::string option : {"TIME DELAY", "SECTOR"})
          if (block.has(option))
            remarks.left_out(block.place,
                             "the option " + option + " of " + block.keyword);
      }
    if (block.keyword == "*TRANSFORM")
      {
        const auto x = block.lines.empty() ? std::vector<double>() :
                                             import_numbers(block.lines[0]);
        const bool straight =
          x.size() == 6 && upper(block.option("TYPE")).find_first_of("CS") != 0;
        for (const unsigned int node :
             deck.find_nodes(block.option("NSET"), block.instance))
          local_axes[node] =
            straight ? angles_text(axes_of(Tensor<1, 3>({x[0], x[1], x[2]}),
                                           Tensor<1, 3>({x[3], x[4], x[5]}))) :
                       "round";
      }
    else if (block.keyword == "*BOUNDARY")
      read_boundary(block, step);
    else if (block.keyword == "*CLOAD")
      read_nodal_forces(block, step);
    else if (block.keyword == "*DLOAD" || block.keyword == "*DSLOAD")
      read_loads(block, step);
    else if (block.keyword == "*TEMPERATURE" ||
             (block.keyword == "*INITIAL CONDITIONS" &&
              upper(block.option("TYPE")) == "TEMPERATURE"))
      read_temperatures(block, step);
    else if (block.keyword == "*INITIAL CONDITIONS")
      remarks.left_out(block.place,
                       block.keyword + ", TYPE=" + block.option("TYPE"));
  }

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

  unsigned int
  ImportConditions::add(const ImportCondition           &condition,
                        const std::vector<unsigned int> &faces)
  {
    const unsigned int number = conditions.size();
    conditions.push_back(condition);
    for (const unsigned int f : faces)
      bodies.faces[f].conditions.push_back(number);
    return number;
  }

  void
  ImportConditions::name_boundaries()
  {
    std::map<std::pair<unsigned int, std::vector<unsigned int>>, std::string>
                                          boundaries;
    std::vector<std::vector<std::string>> taken(bodies.bodies.size());
    for (ImportFace &face : bodies.faces)
      {
        if (face.conditions.empty())
          continue;
        std::string &name = boundaries[{face.body, face.conditions}];
        if (name.empty())
          {
            std::set<std::string> names;
            for (const unsigned int c : face.conditions)
              names.insert(conditions[c].name);
            std::string joined;
            for (const std::string &part : names)
              joined += (joined.empty() ? "" : "-") + part;
            if (joined.size() > 60)
              joined = joined.substr(0, 60);
            name = scene_name(joined, taken[face.body]);
            taken[face.body].push_back(name);
          }
        face.boundary = name;
      }
    for (ImportFace &face : bodies.faces)
      if (taken[face.body].empty())
        face.boundary = "skin";
  }

  bool
  ImportConditions::is_held(const unsigned int body,
                            const unsigned int condition) const
  {
    return std::any_of(
      bodies.faces.begin(), bodies.faces.end(), [&](const ImportFace &face) {
        const auto &all = face.conditions;
        return face.body == body &&
               std::count(all.begin(), all.end(), condition) > 0 &&
               std::any_of(all.begin(), all.end(), [&](const auto c) {
                 return conditions[c].kind == ImportCondition::Kind::support;
               });
      });
  }

  namespace
  {
    std::string
    three(const std::array<std::string, 3> &texts, const std::string &between)
    {
      return texts[0] + between + texts[1] + between + texts[2];
    }

    std::string
    setting(const std::string &name, const std::string &value)
    {
      return "    set " + name + " = " + value + "\n";
    }

    std::string
    vector_setting(const std::string                  &name,
                   const std::array<ImportHistory, 3> &x)
    {
      if (std::all_of(x.begin(), x.end(), [](const auto &h) {
            return h.is_zero();
          }))
        return "";
      return setting(name,
                     three({x[0].text(), x[1].text(), x[2].text()}, "; "));
    }

    std::array<ImportHistory, 3>
    sum_of(const std::array<ImportHistory, 3> &a,
           const std::array<ImportHistory, 3> &b)
    {
      return {{a[0].plus(b[0]), a[1].plus(b[1]), a[2].plus(b[2])}};
    }

    /// A constant matrix times histories.
    std::array<ImportHistory, 3>
    product(const Tensor<2, 3> &A, const std::array<ImportHistory, 3> &x)
    {
      std::array<ImportHistory, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          if (std::fabs(A[i][j]) > 1e-12 * A.norm())
            result[i] = result[i].plus(x[j].times(A[i][j]));
      return result;
    }

    /// v x ... as a matrix.
    Tensor<2, 3>
    cross_matrix(const Tensor<1, 3> &v)
    {
      Tensor<2, 3> A;
      A[0][1] = -v[2];
      A[0][2] = v[1];
      A[1][0] = v[2];
      A[1][2] = -v[0];
      A[2][0] = -v[1];
      A[2][1] = v[0];
      return A;
    }
  } // namespace

  std::string
  ImportConditions::boundaries_text(const unsigned int body) const
  {
    std::map<std::string, std::vector<unsigned int>> boundaries;
    for (unsigned int f = 0; f < bodies.faces.size(); ++f)
      if (bodies.faces[f].body == body && !bodies.faces[f].boundary.empty())
        boundaries[bodies.faces[f].boundary].push_back(f);
    std::string text;
    for (const auto &[name, faces] : boundaries)
      {
        std::array<std::string, 3>   displacement = {{"-", "-", "-"}};
        std::string                  axes, pressure, lines;
        std::array<ImportHistory, 3> traction, force, moment;
        for (const unsigned int c : bodies.faces[faces[0]].conditions)
          {
            const ImportCondition &condition = conditions[c];
            switch (condition.kind)
              {
                case ImportCondition::Kind::support:
                  displacement[condition.component] =
                    affine_text(condition.value);
                  axes = condition.axes;
                  break;
                case ImportCondition::Kind::pressure:
                  pressure += (pressure.empty() ? "" : " + ") +
                              affine_text(condition.value);
                  break;
                case ImportCondition::Kind::traction:
                  traction = sum_of(traction, condition.traction);
                  break;
                case ImportCondition::Kind::force:
                  {
                    // the part of the traction F / A + w x (x - centroid) on
                    // these faces
                    const ImportForce &whole = condition.force;
                    const ImportForce  part  = area_of(faces);
                    const double       share = part.area / whole.area;
                    const auto w = product(invert(whole.inertia), whole.moment);
                    force        = sum_of(force,
                                          {{whole.force[0].times(share),
                                            whole.force[1].times(share),
                                            whole.force[2].times(share)}});
                    if (share < 1. - 1e-9)
                      force = sum_of(force,
                                     product(-part.area *
                                               cross_matrix(part.centroid -
                                                            whole.centroid),
                                             w));
                    moment = sum_of(moment, product(part.inertia, w));
                    break;
                  }
                default:
                  break;
              }
          }
        if (displacement != std::array<std::string, 3>{{"-", "-", "-"}})
          lines += setting("Displacement", three(displacement, ", "));
        if (!axes.empty())
          lines += setting("Displacement axes", axes);
        if (!pressure.empty())
          lines += setting("Pressure", pressure);
        lines += vector_setting("Traction", traction) +
                 vector_setting("Force", force) +
                 vector_setting("Moment", moment);
        if (!lines.empty())
          text += "  subsection Boundary " + name + "\n" + lines + "  end\n";
      }
    return text;
  }

  std::string
  ImportConditions::side_text(const unsigned int body,
                              const unsigned int condition) const
  {
    std::set<std::string> names;
    for (const ImportFace &face : bodies.faces)
      if (face.body == body && std::count(face.conditions.begin(),
                                          face.conditions.end(),
                                          condition) > 0)
        names.insert(face.boundary);
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? bodies.bodies[body].name + ": " : ", ") + name;
    return text;
  }

  std::string
  ImportConditions::resultants_text() const
  {
    std::set<std::string> entries;
    for (const ImportFace &face : bodies.faces)
      for (const unsigned int c : face.conditions)
        if (conditions[c].kind == ImportCondition::Kind::support)
          {
            const std::string &body = bodies.bodies[face.body].name;
            entries.insert((bodies.bodies.size() > 1 ? body + "-" : "") +
                           face.boundary + ": " + body + ": " + face.boundary);
          }
    std::string text;
    for (const std::string &entry : entries)
      text += (text.empty() ? "" : "; ") + entry;
    return text;
  }

  void
  ImportConditions::read_temperatures(const InpBlock   &block,
                                      const std::size_t step)
  {
    for (const InpLine &line : block.lines)
      {
        const auto numbers = import_numbers(line, 1);
        if (numbers.empty())
          continue;
        for (const unsigned int node :
             deck.find_nodes(line.words[0], block.instance))
          if (block.keyword == "*TEMPERATURE")
            ImportSteps::change(temperatures[node],
                                {step,
                                 numbers[0],
                                 upper(block.option("AMPLITUDE"))});
          else
            initial[node] = numbers[0];
      }
  }

  /// Where it is linear in x, y, z.
  std::string
  ImportConditions::temperature_text(const unsigned int body) const
  {
    const auto &nodes = bodies.bodies[body].nodes;
    std::map<std::string, std::vector<unsigned int>> by_steps;
    for (const unsigned int node : nodes)
      {
        std::string kind;
        if (const auto found = temperatures.find(node);
            found != temperatures.end())
          for (const ImportChange &change : found->second)
            kind += std::to_string(change.step) + "," + change.amplitude + ",";
        by_steps[kind].push_back(node);
      }
    if (by_steps.size() == 1 && by_steps.begin()->first.empty())
      return "";
    bool          fits = by_steps.size() == 1;
    AffineHistory sum;
    if (fits)
      {
        std::vector<Point<3>>                    points;
        std::array<std::vector<ImportChange>, 4> coefficients;
        for (const unsigned int node : nodes)
          points.push_back(deck.nodes[node]);
        const auto &first = temperatures.at(nodes[0]);
        for (std::size_t i = 0; fits && i < first.size(); ++i)
          {
            // what acts is the difference; an amplitude scales the temperature
            std::vector<double> values;
            for (const unsigned int node : nodes)
              {
                const auto at = initial.find(node);
                values.push_back(temperatures.at(node)[i].value -
                                 (at == initial.end() ? 0. : at->second));
              }
            const auto fit = affine_fit(points, values);
            fits           = !fit.empty();
            for (unsigned int k = 0; fits && k < 4; ++k)
              coefficients[k].push_back(
                {first[i].step, fit[k], first[i].amplitude});
          }
        for (unsigned int k = 0; fits && k < 4; ++k)
          sum[k] = steps.history(coefficients[k]);
      }
    if (!fits)
      {
        remarks.left_out("*TEMPERATURE",
                         "that of the body " + bodies.bodies[body].name +
                           ", which is no linear function of x, y, z");
        return "";
      }
    return "  set Temperature = " + affine_text(sum) + "\n";
  }
} // namespace mortise
