// Single nodes and straight edges of a deck that are held: entries of
// Displacement at.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "import_conditions.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// The vertices of an edge, ascending, and the node in its middle.
    struct ImportEdge
    {
      std::array<unsigned int, 2> ends;
      std::vector<unsigned int>   nodes; ///< all
    };

    std::vector<ImportEdge>
    surface_edges_of(const ImportBodies &bodies, const unsigned int body)
    {
      std::map<std::array<unsigned int, 2>, ImportEdge> edges;
      for (const ImportFace &face : bodies.faces)
        if (face.body == body)
          for (unsigned int v = 0; v < face.n_vertices; ++v)
            {
              const auto [a, b] = std::minmax(
                {face.nodes[v], face.nodes[(v + 1) % face.n_vertices]});
              ImportEdge edge = {{{a, b}}, {a, b}};
              if (face.nodes.size() > face.n_vertices)
                edge.nodes.push_back(face.nodes[face.n_vertices + v]);
              edges.emplace(edge.ends, edge);
            }
      std::vector<ImportEdge> result;
      for (const auto &edge : edges)
        result.push_back(edge.second);
      return result;
    }

    std::string
    place_text(const Point<3> &x)
    {
      return number_text(x[0]) + ", " + number_text(x[1]) + ", " +
             number_text(x[2]);
    }

    /// The ends of the straight lines that edges form which meet in one
    /// direction.
    std::vector<std::array<unsigned int, 2>>
    straight_lines_of(const std::vector<Point<3>>             &x,
                      std::vector<std::array<unsigned int, 2>> edges)
    {
      for (bool found = true; found;)
        {
          found = false;
          std::map<unsigned int, std::vector<std::size_t>> at;
          for (std::size_t e = 0; e < edges.size(); ++e)
            for (const unsigned int v : edges[e])
              at[v].push_back(e);
          std::vector<bool> gone(edges.size(), false);
          for (const auto &[v, of_vertex] : at)
            for (std::size_t i = 0; i < of_vertex.size(); ++i)
              for (std::size_t j = i + 1; j < of_vertex.size(); ++j)
                {
                  auto &one = edges[of_vertex[i]], &other = edges[of_vertex[j]];
                  if (gone[of_vertex[i]] || gone[of_vertex[j]] ||
                      std::count(one.begin(), one.end(), v) == 0 ||
                      std::count(other.begin(), other.end(), v) == 0)
                    continue;
                  const unsigned int a = one[0] == v ? one[1] : one[0],
                                     b = other[0] == v ? other[1] : other[0];
                  const Tensor<1, 3> d = x[v] - x[a], e = x[b] - x[v];
                  if (d * e <= 0. || cross_product_3d(d, e).norm() >
                                       1e-7 * d.norm() * e.norm())
                    continue;
                  one                = {{a, b}};
                  gone[of_vertex[j]] = true;
                  found              = true;
                }
          std::vector<std::array<unsigned int, 2>> rest;
          for (std::size_t e = 0; e < edges.size(); ++e)
            if (!gone[e])
              rest.push_back(edges[e]);
          edges = rest;
        }
      return edges;
    }
  } // namespace

  /// What is prescribed at nodes: one value, or a linear function of x, y, z;
  /// empty if it is neither.
  std::string
  ImportConditions::values_text(const unsigned int               component,
                                const std::vector<unsigned int> &nodes) const
  {
    const auto &first = supported[component].at(nodes[0]).changes;
    std::array<std::vector<ImportChange>, 4> coefficients;
    for (std::size_t i = 0; i < first.size(); ++i)
      {
        std::vector<Point<3>> places;
        std::vector<double>   values;
        for (const unsigned int node : nodes)
          {
            const auto &its = supported[component].at(node).changes;
            if (its.size() != first.size() || its[i].step != first[i].step ||
                its[i].amplitude != first[i].amplitude)
              return "";
            places.push_back(deck.nodes[node]);
            values.push_back(its[i].value);
          }
        const bool same =
          std::all_of(values.begin(), values.end(), [&](const double value) {
            return value == values[0];
          });
        const auto fit = same ? std::vector<double>{values[0], 0., 0., 0.} :
                                affine_fit(places, values);
        if (fit.empty())
          return "";
        for (unsigned int k = 0; k < 4; ++k)
          coefficients[k].push_back(
            {first[i].step, fit[k], first[i].amplitude});
      }
    AffineHistory sum;
    for (unsigned int k = 0; k < 4; ++k)
      sum[k] = steps.history(coefficients[k]);
    return affine_text(sum);
  }

  /// Edges at the surface of @p body of which all nodes are held, and some are
  /// not those of a face that is.
  void
  ImportConditions::find_edges(const unsigned int                     body,
                               std::array<std::set<unsigned int>, 3> &of_edges)
  {
    EdgesByValues alike;
    for (const ImportEdge &edge : surface_edges_of(bodies, body))
      {
        std::array<std::string, 3> values = free_components;
        for (unsigned int c = 0; c < 3; ++c)
          {
            if (!std::all_of(edge.nodes.begin(),
                             edge.nodes.end(),
                             [&](const auto n) {
                               return supported[c].count(n) > 0;
                             }) ||
                std::all_of(edge.nodes.begin(), edge.nodes.end(), [&](auto n) {
                  return covered[c].count(n) > 0;
                }))
              continue;
            const std::string text = values_text(c, edge.nodes);
            if (text.empty())
              continue;
            values[c] = text;
            of_edges[c].insert(edge.nodes.begin(), edge.nodes.end());
          }
        if (values != free_components)
          alike[values].push_back(edge.ends);
      }
    add_lines(body, alike);
  }

  void
  ImportConditions::add_lines(const unsigned int   body,
                              const EdgesByValues &alike)
  {
    for (const auto &[values, edges] : alike)
      for (const auto &[a, b] : straight_lines_of(deck.nodes, edges))
        held_at[body].push_back(place_text(deck.nodes[a]) + ", " +
                                place_text(deck.nodes[b]) + ": " + values[0] +
                                ", " + values[1] + ", " + values[2]);
  }

  namespace
  {
    /// Does it prescribe a displacement that is rather along the normal than
    /// across it?
    bool
    holds_normal(const ImportCondition &condition, const Tensor<1, 3> &normal)
    {
      const bool support = condition.kind == ImportCondition::Kind::support;
      if (!support || condition.component == ImportCondition::normal)
        return support || condition.kind == ImportCondition::Kind::motion;
      Tensor<1, 3> along;
      along[condition.component] = 1.;
      if (condition.axes.norm() > 0.)
        along = condition.axes * along;
      return std::fabs(along * normal) > 0.5;
    }
  } // namespace

  void
  ImportConditions::hold_edges(const unsigned int body,
                               const unsigned int condition,
                               const std::string &place)
  {
    const auto is_support = [&](const unsigned int c) {
      return conditions[c].kind == ImportCondition::Kind::support ||
             conditions[c].kind == ImportCondition::Kind::motion;
    };
    std::map<std::array<unsigned int, 2>, std::array<std::string, 3>> values;
    std::vector<ImportFace *>                                         held;
    for (ImportFace &face : bodies.faces)
      if (face.body == body && std::count(face.conditions.begin(),
                                          face.conditions.end(),
                                          condition) > 0)
        for (const unsigned int c : face.conditions)
          if (is_support(c))
            {
              const ImportCondition &support = conditions[c];
              if (holds_normal(support, bodies.normal_of(face)) ||
                  support.axes.norm() > 0.)
                return;
              held.push_back(&face);
              for (unsigned int v = 0; v < face.n_vertices; ++v)
                {
                  const auto [a, b] = std::minmax(
                    {face.nodes[v], face.nodes[(v + 1) % face.n_vertices]});
                  auto &at =
                    values.try_emplace({{a, b}}, free_components).first->second;
                  at[support.component] = affine_text(support.value);
                }
            }
    if (held.empty())
      return;
    for (ImportFace *face : held)
      {
        auto &its = face->conditions;
        its.erase(std::remove_if(its.begin(), its.end(), is_support),
                  its.end());
      }
    EdgesByValues alike;
    for (const auto &[edge, at] : values)
      alike[at].push_back(edge);
    add_lines(body, alike);
    remarks.approximated(place,
                         "*CONTACT PAIR: the slave's faces of the body " +
                           bodies.bodies[body].name +
                           " are held along the edges of elements");
  }

  void
  ImportConditions::find_points()
  {
    held_at.resize(bodies.bodies.size());
    std::set<unsigned int> vertices;
    for (const ImportFace &face : bodies.faces)
      vertices.insert(face.nodes.begin(), face.nodes.begin() + face.n_vertices);
    std::array<std::set<unsigned int>, 3> found;
    for (unsigned int body = 0; body < bodies.bodies.size(); ++body)
      {
        std::array<std::set<unsigned int>, 3> of_edges;
        find_edges(body, of_edges);
        for (const unsigned int node : bodies.bodies[body].nodes)
          {
            std::string values;
            bool        any = false;
            for (unsigned int c = 0; c < 3; ++c)
              {
                const bool here =
                  supported[c].count(node) > 0 && covered[c].count(node) == 0 &&
                  of_edges[c].count(node) == 0 && vertices.count(node) > 0;
                values +=
                  (c > 0 ? ", " : "") + (here ? values_text(c, {node}) : "-");
                any = any || here;
                if (here || of_edges[c].count(node) > 0)
                  found[c].insert(node);
              }
            if (any)
              held_at[body].push_back(place_text(deck.nodes[node]) + ": " +
                                      values);
          }
      }
    for (unsigned int c = 0; c < 3; ++c)
      covered[c].insert(found[c].begin(), found[c].end());
    tell_unsupported();
  }

  void
  ImportConditions::tell_unsupported() const
  {
    std::array<std::map<unsigned int, unsigned int>, 6> left; // by source
    for (unsigned int c = 0; c < 6; ++c)
      for (const auto &[node, entry] : supported[c])
        {
          const auto scene = scene_axes.find(node);
          const bool is_scene =
            c >= 3 && scene != scene_axes.end() && scene->second[c - 3];
          if (covered[c].count(node) == 0 && !is_scene)
            ++left[c][entry.source];
        }
    for (unsigned int c = 0; c < 6; ++c)
      for (const auto &[source, n] : left[c])
        remarks.left_out(
          sources[source].place,
          "*BOUNDARY of component " + std::to_string(c % 3 + 1) + " at " +
            std::to_string(n) + (n == 1 ? " node" : " nodes") +
            (c < 3 ? " within a body or in the middles of edges" :
                     " along axes of *TRANSFORM, which no face has for all of "
                     "its nodes") +
            (sources[source].name.empty() ? "" :
                                            " (" + sources[source].name + ")"));
  }

  std::string
  ImportConditions::supports_text(const unsigned int body) const
  {
    std::string text;
    for (const std::string &entry : held_at[body])
      text += (text.empty() ? "" : "; ") + entry;
    return text.empty() ? "" : "  set Displacement at = " + text + "\n";
  }
} // namespace mortise
