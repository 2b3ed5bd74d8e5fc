#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/inp_shapes.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "import_conditions.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    bool
    replaces_all(const InpBlock &block)
    {
      return upper(block.option("OP")) == "NEW";
    }

    /// What a block that begins with OP=NEW does to a load of earlier steps.
    void
    end_load(std::vector<ImportChange> &changes, const std::size_t step)
    {
      if (!changes.empty() && changes.back().step < step &&
          changes.back().value != 0.)
        changes.push_back({step, 0., ""});
    }

    /// A load on the same set and of the same kind replaces that of an earlier
    /// step, which ends where its direction is another one.
    template <typename Load>
    Load &
    load_of(std::map<std::string, Load> &loads,
            const InpBlock              &block,
            const InpLine               &line,
            const std::size_t            step)
    {
      const std::string same = block.keyword + ":" + block.instance + ":" +
                               upper(line.words[0]) + ":" +
                               upper(line.words[1]) + ":";
      std::string key = same;
      for (const double number : import_numbers(line, 3))
        key += number_text(number) + ",";
      for (auto &[other, load] : loads)
        if (other != key && other.compare(0, same.size(), same) == 0)
          end_load(load.changes, step);
      return loads[key];
    }

    /// Of length 1.
    Tensor<1, 3>
    direction_of(const InpLine             &line,
                 const std::vector<double> &numbers,
                 const unsigned int         first)
    {
      Tensor<1, 3> direction;
      for (unsigned int d = 0; d < 3 && first + d < numbers.size(); ++d)
        direction[d] = numbers[first + d];
      if (!(direction.norm() > 0.))
        throw InputError("--import: the deck has in " + line.place +
                         " a direction of no length");
      return direction / direction.norm();
    }

    double
    number_at(const InpLine &line, const std::size_t i)
    {
      const auto numbers = import_numbers(line, i);
      return numbers.empty() ? 0. : numbers[0];
    }
  } // namespace

  void
  ImportConditions::read_loads(const InpBlock &block, const std::size_t step)
  {
    if (replaces_all(block))
      {
        const auto end_all = [&](auto &loads) {
          for (auto &[key, load] : loads)
            if (key.compare(0, block.keyword.size(), block.keyword) == 0)
              end_load(load.changes, step);
        };
        end_all(face_loads);
        end_all(body_forces);
      }
    for (const InpLine &line : block.lines)
      {
        const std::string kind =
          line.words.size() > 1 ? upper(line.words[1]) : "";
        const bool pressure =
          kind == "P" || (kind.size() == 2 && kind[0] == 'P' &&
                          kind[1] >= '1' && kind[1] <= '6');
        const bool foundation = block.keyword == "*FOUNDATION";
        if (pressure || foundation ||
            (kind == "TRVEC" && line.words.size() > 5))
          read_face_load(block, line, step);
        else if (kind == "GRAV" || kind == "CENTRIF" || kind == "BX" ||
                 kind == "BY" || kind == "BZ")
          read_body_force(block, line, step);
        else
          remarks.left_out(line.place,
                           block.keyword + " of the kind " +
                             in_quotes(kind, '\''));
      }
  }

  void
  ImportConditions::read_face_load(const InpBlock   &block,
                                   const InpLine    &line,
                                   const std::size_t step)
  {
    const std::string kind = upper(line.words[1]);
    FaceLoad         &load = load_of(face_loads, block, line, step);
    if (load.changes.empty())
      {
        std::vector<InpSide> sides;
        if (block.keyword == "*DSLOAD")
          {
            const std::string key =
              deck.find_surface(line.words[0], block.instance);
            if (const auto surface = deck.surfaces.find(key);
                surface != deck.surfaces.end())
              sides = surface->second;
          }
        else if (kind.size() == 2)
          for (const unsigned int e :
               deck.find_elements(line.words[0], block.instance))
            if (const unsigned int face = kind[1] - '1';
                deck.elements[e].dimension == 3 &&
                face < inp_shape(deck.elements[e].n_vertices).faces.size())
              sides.push_back({e, face});
        load.faces = bodies.faces_of(sides);
        if (load.faces.empty())
          return remarks.left_out(line.place,
                                  block.keyword + " on " +
                                    in_quotes(line.words[0], '\'') +
                                    ", which has no outer faces of a body");
        load.condition.kind =
          kind == "TRVEC"                ? ImportCondition::Kind::traction :
          block.keyword == "*FOUNDATION" ? ImportCondition::Kind::foundation :
                                           ImportCondition::Kind::pressure;
        const bool number   = std::isdigit(static_cast<unsigned char>(
          line.words[0].empty() ? '0' : line.words[0][0]));
        load.condition.name = number ? "loaded" : line.words[0];
      }
    if (load.faces.empty())
      return;
    if (kind == "TRVEC")
      {
        const Tensor<1, 3> direction =
          direction_of(line, import_numbers(line, 3), 0);
        load.direction = {direction[0], direction[1], direction[2]};
      }
    ImportSteps::change(load.changes,
                        {step,
                         number_at(line, 2),
                         upper(block.option("AMPLITUDE"))});
  }

  void
  ImportConditions::read_body_force(const InpBlock   &block,
                                    const InpLine    &line,
                                    const std::size_t step)
  {
    const std::string kind  = upper(line.words[1]);
    BodyForce        &force = load_of(body_forces, block, line, step);
    if (force.changes.empty())
      {
        auto elements = deck.find_elements(line.words[0], block.instance);
        if (line.words[0].empty()) // all
          for (unsigned int e = 0; e < deck.elements.size(); ++e)
            elements.insert(e);
        force.kind  = kind;
        force.place = line.place;
        for (unsigned int b = 0; b < bodies.bodies.size(); ++b)
          {
            const auto &of_body = bodies.bodies[b].elements;
            const auto  n =
              std::count_if(of_body.begin(), of_body.end(), [&](const auto e) {
                return elements.count(e) > 0;
              });
            if (n == static_cast<std::ptrdiff_t>(of_body.size()))
              force.bodies.push_back(b);
            else if (n > 0)
              remarks.left_out(line.place,
                               block.keyword + ", " + kind + " on " +
                                 std::to_string(n) + " of " +
                                 std::to_string(of_body.size()) +
                                 " elements of the body " +
                                 bodies.bodies[b].name);
          }
      }
    force.numbers = import_numbers(line, 3);
    if (kind == "GRAV" || kind == "CENTRIF")
      {
        const unsigned int first = kind == "GRAV" ? 0 : 3;
        const Tensor<1, 3> unit  = direction_of(line, force.numbers, first);
        force.numbers.resize(first + 3);
        for (unsigned int d = 0; d < 3; ++d)
          force.numbers[first + d] = unit[d];
      }
    ImportSteps::change(force.changes,
                        {step,
                         number_at(line, 2),
                         upper(block.option("AMPLITUDE"))});
  }

  void
  ImportConditions::read_nodal_forces(const InpBlock   &block,
                                      const std::size_t step)
  {
    if (replaces_all(block))
      {
        for (auto &component : nodal_forces)
          for (auto &node : component)
            end_load(node.second.changes, step);
        for (auto &reference : references)
          for (auto &component : reference.second.load)
            end_load(component, step);
      }
    for (const InpLine &line : block.lines)
      {
        const auto   numbers = import_numbers(line, 1);
        const double dof     = numbers.empty() ? 0. : numbers[0];
        const auto   nodes   = deck.find_nodes(line.words[0], block.instance);
        if (numbers.size() < 2 || dof < 1. || dof > 6. || nodes.empty())
          {
            remarks.left_out(line.place,
                             "*CLOAD on " + in_quotes(line.words[0], '\'') +
                               (nodes.empty() ? ", which has no nodes" :
                                                ", which is no force"));
            continue;
          }
        const unsigned int c      = dof - 1.;
        const ImportChange change = {step,
                                     numbers[1],
                                     upper(block.option("AMPLITUDE"))};
        for (const unsigned int node : nodes)
          if (const auto reference = references.find(node);
              reference != references.end())
            ImportSteps::change(reference->second.load[c], change);
          else if (c >= 3 || bodies.bodies_of_node[node].empty())
            remarks.left_out(line.place,
                             c >= 3 ? "*CLOAD that is a moment of a node" :
                                      "*CLOAD on a node of no body");
          else
            {
              NodalForce &force = nodal_forces[c][node];
              force.name        = nodes.size() > 1 ? line.words[0] : "loaded";
              force.place       = line.place;
              ImportSteps::change(force.changes, change);
            }
      }
  }

  /// Nodal forces become forces on faces all of whose vertices, or nodes in
  /// the middles of edges, have some: those that touch are one.
  void
  ImportConditions::find_forces()
  {
    std::map<unsigned int, std::string> loaded; // with their places
    for (const auto &component : nodal_forces)
      for (const auto &[node, force] : component)
        if (std::any_of(force.changes.begin(),
                        force.changes.end(),
                        [](const auto &c) { return c.value != 0.; }))
          loaded.emplace(node, force.place);
    if (loaded.empty())
      return;
    const auto is_loaded = [&](const unsigned int node) {
      return loaded.count(node) > 0;
    };
    std::map<unsigned int, std::vector<unsigned int>> faces_of_node;
    for (unsigned int f = 0; f < bodies.faces.size(); ++f)
      {
        const ImportFace &face   = bodies.faces[f];
        const auto        middle = face.nodes.begin() + face.n_vertices;
        if (std::all_of(face.nodes.begin(), middle, is_loaded) ||
            (middle != face.nodes.end() &&
             std::all_of(middle, face.nodes.end(), is_loaded)))
          for (const unsigned int node : face.nodes)
            faces_of_node[node].push_back(f);
      }
    std::set<unsigned int> done;
    for (const auto &start : faces_of_node)
      for (const unsigned int first : start.second)
        {
          if (!done.insert(first).second)
            continue;
          std::vector<unsigned int> group = {first};
          std::set<unsigned int>    nodes;
          for (std::size_t i = 0; i < group.size(); ++i)
            for (const unsigned int node : bodies.faces[group[i]].nodes)
              if (nodes.insert(node).second)
                for (const unsigned int f : faces_of_node[node])
                  if (done.insert(f).second)
                    group.push_back(f);
          add_force(group, nodes);
          for (const unsigned int node : nodes)
            loaded.erase(node);
        }
    std::map<std::string, unsigned int> left;
    for (const auto &[node, place] : loaded)
      ++left[place];
    for (const auto &[place, n] : left)
      remarks.left_out(place,
                       "*CLOAD on " + std::to_string(n) +
                         (n == 1 ? " node that is" : " nodes that are") +
                         " not those of a face");
  }

  /// The forces of @p nodes, which are those of @p faces.
  void
  ImportConditions::add_force(const std::vector<unsigned int> &faces,
                              const std::set<unsigned int>    &nodes)
  {
    ImportCondition condition;
    condition.kind     = ImportCondition::Kind::force;
    ImportForce &force = condition.force;
    force              = area_of(faces);
    std::string place;
    double      largest = 0., arm = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      for (const unsigned int node : nodes)
        {
          const auto found = nodal_forces[d].find(node);
          if (found == nodal_forces[d].end())
            continue;
          if (condition.name.empty() || found->second.name != "loaded")
            condition.name = found->second.name;
          place = place.empty() ? found->second.place : place;
          const ImportHistory history = steps.history(found->second.changes);
          Tensor<1, 3>        unit;
          unit[d] = 1.;
          if (const auto local = local_axes.find(node);
              local != local_axes.end())
            unit = local->second.axes * unit;
          const Tensor<1, 3> lever  = deck.nodes[node] - force.centroid;
          const Tensor<1, 3> moment = cross_product_3d(lever, unit);
          for (unsigned int c = 0; c < 3; ++c)
            {
              if (unit[c] != 0.)
                force.force[c] = force.force[c].plus(history.times(unit[c]));
              if (moment[c] != 0.)
                force.moment[c] =
                  force.moment[c].plus(history.times(moment[c]));
            }
          arm = std::max(arm, lever.norm());
          for (const auto &point : history.points)
            largest = std::max(largest, std::fabs(point.second));
        }
    // rounding is no moment
    for (auto *part : {&force.force, &force.moment})
      for (ImportHistory &history : *part)
        for (auto &point : history.points)
          if (std::fabs(point.second) <
              1e-9 * largest * (part == &force.force ? 1. : arm))
            point.second = 0.;
    remarks.approximated(place,
                         "*CLOAD on the " + std::to_string(nodes.size()) +
                           " nodes of faces is their force and moment, spread "
                           "evenly over an area of " +
                           number_text(force.area));
    add(condition, faces);
  }

  namespace
  {
    /// Adds a triangle to the area, first and second moments of @p force.
    void
    add_triangle(const Point<3> &a,
                 const Point<3> &b,
                 const Point<3> &c,
                 ImportForce    &force,
                 Tensor<2, 3>   &second)
    {
      const double area = cross_product_3d(b - a, c - a).norm() / 2.;
      force.area += area;
      force.centroid +=
        area / 3. * (Tensor<1, 3>(a) + Tensor<1, 3>(b) + Tensor<1, 3>(c));
      // exact for quadratic functions
      for (const Point<3> &middle :
           {a + (b - a) / 2., b + (c - b) / 2., c + (a - c) / 2.})
        second +=
          area / 3. * outer_product(Tensor<1, 3>(middle), Tensor<1, 3>(middle));
    }
  } // namespace

  ImportForce
  ImportConditions::area_of(const std::vector<unsigned int> &faces) const
  {
    ImportForce  sum;
    Tensor<2, 3> second;
    for (const unsigned int f : faces)
      {
        const ImportFace &face = bodies.faces[f];
        const std::size_t n    = face.n_vertices;
        // the corners of faces with middle nodes, and the polygon of these
        std::vector<unsigned int> polygon(face.nodes.begin(),
                                          face.nodes.begin() + n);
        const auto x = [&](const unsigned int v) { return deck.nodes[v]; };
        if (face.nodes.size() > n)
          {
            for (std::size_t v = 0; v < n; ++v)
              add_triangle(x(face.nodes[v]),
                           x(face.nodes[n + v]),
                           x(face.nodes[n + (v + n - 1) % n]),
                           sum,
                           second);
            polygon.assign(face.nodes.begin() + n, face.nodes.end());
          }
        for (std::size_t v = 2; v < polygon.size(); ++v)
          add_triangle(
            x(polygon[0]), x(polygon[v - 1]), x(polygon[v]), sum, second);
      }
    sum.centroid /= sum.area;
    const Tensor<1, 3> c(sum.centroid);
    second -= sum.area * outer_product(c, c);
    sum.inertia = trace(second) * unit_symmetric_tensor<3>() - second;
    return sum;
  }

  std::string
  ImportConditions::body_text(const unsigned int    body,
                              const ImportMaterial &material) const
  {
    std::array<AffineHistory, 3> sum;
    const double                 density = material.density;
    bool                         acts    = false;
    for (const auto &entry : body_forces)
      {
        const BodyForce &force = entry.second;
        if (std::count(force.bodies.begin(), force.bodies.end(), body) == 0)
          continue;
        if (density == 0. && force.kind.size() > 2)
          {
            remarks.left_out(force.place,
                             force.kind + " on the body " +
                               bodies.bodies[body].name +
                               ", which has no *DENSITY");
            continue;
          }
        acts              = true;
        const auto  scale = steps.history(force.changes);
        const auto &x     = force.numbers;
        const auto  add =
          [&](const unsigned int d, const unsigned int i, const double factor) {
            if (factor != 0.)
              sum[d][i] = sum[d][i].plus(scale.times(factor));
          };
        if (force.kind == "GRAV")
          for (unsigned int d = 0; d < 3; ++d)
            add(d, 0, density * x[d]);
        else if (force.kind == "CENTRIF")
          {
            // density omega^2 times the vector from the axis
            const Point<3>     origin(x[0], x[1], x[2]);
            const Tensor<1, 3> axis({x[3], x[4], x[5]});
            const Tensor<2, 3> across =
              Tensor<2, 3>(unit_symmetric_tensor<3>()) -
              outer_product(axis, axis);
            for (unsigned int d = 0; d < 3; ++d)
              {
                add(d, 0, -density * (across[d] * Tensor<1, 3>(origin)));
                for (unsigned int i = 0; i < 3; ++i)
                  add(d, i + 1, density * across[d][i]);
              }
          }
        else
          add(force.kind == "BX" ? 0 : force.kind == "BY" ? 1 : 2, 0, 1.);
      }
    std::string text;
    if (acts)
      text = "  set Body force = " + affine_text(sum[0]) + "; " +
             affine_text(sum[1]) + "; " + affine_text(sum[2]) + "\n";
    return text;
  }
} // namespace mortise
