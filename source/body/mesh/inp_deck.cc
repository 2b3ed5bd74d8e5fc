#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/inp_deck.h>
#include <mortise/body/mesh/inp_shapes.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "inp_lines.h"
#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  std::string
  upper(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
      return std::toupper(c);
    });
    return text;
  }

  double
  inp_number(const std::string &word, const FileError &fail)
  {
    std::string text = word;
    for (char &c : text)
      if (c == 'd' || c == 'D') // of Fortran
        c = 'e';
    const ReadNumber value = read_number(text);
    if (!value.problem.empty() || !std::isfinite(value.value))
      fail(in_quotes(word, '\'') + ", which is no number");
    return value.value;
  }

  std::string
  InpBlock::option(const std::string &name) const
  {
    const auto found = options.find(name);
    return found == options.end() ? "" : found->second;
  }

  namespace
  {
    std::string
    within(const std::string &instance, const std::string &name)
    {
      return (instance.empty() ? "" : instance + ".") + upper(name);
    }

    /// A number as set of one, or a set by its name.
    std::set<unsigned int>
    members_of(const InpDeck                                      &deck,
               const InpDeck::Named<std::set<unsigned int>>       &sets,
               const InpDeck::Named<std::map<long, unsigned int>> &places,
               const std::string                                  &word,
               const std::string                                  &instance)
    {
      if (const auto *set = deck.find_set(sets, word, instance))
        return *set;
      const std::size_t dot = word.rfind('.');
      const std::string scope =
        dot == std::string::npos ? instance : upper(word.substr(0, dot));
      const auto tag = InpLines::integer_if_any(
        dot == std::string::npos ? word : word.substr(dot + 1));
      if (!tag || places.count(scope) == 0)
        return {};
      const auto found = places.at(scope).find(*tag);
      if (found == places.at(scope).end())
        return {};
      return {found->second};
    }
  } // namespace

  const std::set<unsigned int> *
  InpDeck::find_set(const Named<std::set<unsigned int>> &sets,
                    const std::string                   &word,
                    const std::string                   &instance) const
  {
    for (const std::string &key : {within(instance, word), upper(word)})
      if (const auto found = sets.find(key); found != sets.end())
        return &found->second;
    return nullptr;
  }

  std::set<unsigned int>
  InpDeck::find_nodes(const std::string &word,
                      const std::string &instance) const
  {
    return members_of(*this, node_sets, node_places, word, instance);
  }

  std::set<unsigned int>
  InpDeck::find_elements(const std::string &word,
                         const std::string &instance) const
  {
    return members_of(*this, element_sets, element_places, word, instance);
  }

  std::string
  InpDeck::find_surface(const std::string &word,
                        const std::string &instance) const
  {
    for (const std::string &key : {within(instance, word), upper(word)})
      if (surfaces.count(key) > 0 || node_surfaces.count(key) > 0)
        return key;
    return "";
  }

  std::vector<unsigned int>
  InpDeck::nodes_of(const InpSide &side) const
  {
    const InpElement         &element = elements[side.element];
    const InpShape           &shape   = inp_shape(element.n_vertices);
    const auto               &face    = shape.faces[side.face];
    std::vector<unsigned int> result;
    for (const unsigned int v : face)
      result.push_back(element.nodes[v]);
    if (element.nodes.size() > element.n_vertices)
      for (std::size_t v = 0; v < face.size(); ++v)
        for (std::size_t e = 0; e < shape.edges.size(); ++e)
          if (std::minmax(shape.edges[e][0], shape.edges[e][1]) ==
              std::minmax(face[v], face[(v + 1) % face.size()]))
            result.push_back(element.nodes[element.n_vertices + e]);
    return result;
  }

  std::vector<InpSide>
  InpDeck::sides_of(const std::set<unsigned int> &of_set) const
  {
    std::vector<bool> in_set(nodes.size(), false);
    for (const unsigned int node : of_set)
      in_set[node] = true;
    std::vector<InpSide> result;
    for (unsigned int e = 0; e < elements.size(); ++e)
      if (elements[e].dimension == 3)
        {
          const auto &faces = inp_shape(elements[e].n_vertices).faces;
          for (unsigned int f = 0; f < faces.size(); ++f)
            if (std::all_of(faces[f].begin(),
                            faces[f].end(),
                            [&](const unsigned int v) {
                              return in_set[elements[e].nodes[v]];
                            }))
              result.push_back({e, f});
        }
    return result;
  }

  namespace
  {
    /// Converts a deck to the model of a mesh.
    class InpModel
    {
    public:
      explicit InpModel(const InpDeck &deck)
        : deck(deck)
        , groups(deck.elements.size())
      {}

      GmshModel
      model()
      {
        result.nodes     = deck.nodes;
        result.node_tags = deck.node_tags;
        for (const auto &[key, members] : deck.element_sets)
          for (const unsigned int e : members)
            groups[e].push_back(group(key));
        for (const auto &[key, sides] : deck.surfaces)
          add_faces(key, sides);
        for (const auto &[key, nodes] : deck.node_sets)
          if (!has_all(nodes))
            add_faces(key, deck.sides_of(nodes));
        for (unsigned int e = 0; e < deck.elements.size(); ++e)
          if (deck.elements[e].dimension > 0)
            {
              const InpElement &element = deck.elements[e];
              std::sort(groups[e].begin(), groups[e].end());
              add(element.dimension,
                  element.n_vertices,
                  {element.nodes.begin(),
                   element.dimension == 3 ?
                     element.nodes.end() :
                     element.nodes.begin() + element.n_vertices},
                  groups[e],
                  element.tag);
            }
        for (auto &[key, block] : blocks)
          {
            for (const int tag : block.groups)
              (block.dimension == 2 ? result.surface_names :
                                      result.volume_names)[tag] = names.at(tag);
            result.elements.push_back(std::move(block));
          }
        result.surfaces_may_overlap = true;
        return std::move(result);
      }

    private:
      int
      group(const std::string &key)
      {
        const int tag =
          numbers_of.emplace(key, numbers_of.size() + 1).first->second;
        names.emplace(tag, deck.names.at(key));
        return tag;
      }

      /// The set that is called NALL.
      bool
      has_all(const std::set<unsigned int> &nodes) const
      {
        return std::all_of(deck.elements.begin(),
                           deck.elements.end(),
                           [&](const auto &e) {
                             return e.dimension == 0 ||
                                    std::all_of(e.nodes.begin(),
                                                e.nodes.begin() + e.n_vertices,
                                                [&](const auto v) {
                                                  return nodes.count(v) > 0;
                                                });
                           });
      }

      void
      add_faces(const std::string &key, const std::vector<InpSide> &sides)
      {
        for (const InpSide &side : sides)
          {
            auto       nodes = deck.nodes_of(side);
            const auto n     = inp_shape(deck.elements[side.element].n_vertices)
                             .faces[side.face]
                             .size();
            nodes.resize(n);
            add(2, n, nodes, {group(key)}, deck.elements[side.element].tag);
          }
      }

      static std::vector<Point<3>>
      reference_of(const unsigned int dimension,
                   const unsigned int n_vertices,
                   const std::size_t  n_nodes)
      {
        if (dimension == 2)
          return std::vector<Point<3>>(n_vertices);
        const InpShape       &shape = inp_shape(n_vertices);
        std::vector<Point<3>> nodes = shape.vertices;
        if (n_nodes > n_vertices)
          for (const auto &edge : shape.edges)
            nodes.push_back(nodes[edge[0]] +
                            (nodes[edge[1]] - nodes[edge[0]]) / 2.);
        return nodes;
      }

      void
      add(const unsigned int               dimension,
          const unsigned int               n_vertices,
          const std::vector<unsigned int> &nodes,
          const std::vector<int>          &its_groups,
          const std::size_t                tag)
      {
        GmshElements &block =
          blocks[{dimension, n_vertices, nodes.size(), its_groups}];
        if (block.reference.empty())
          {
            block.groups     = its_groups;
            block.dimension  = dimension;
            block.n_vertices = n_vertices;
            block.order      = nodes.size() > n_vertices ? 2 : 1;
            block.type = dimension == 3 ? inp_shape(n_vertices).name + " " +
                                            std::to_string(nodes.size()) :
                                          "side";
            block.reference = reference_of(dimension, n_vertices, nodes.size());
          }
        block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
        block.tags.push_back(tag);
      }

      using BlockKey =
        std::tuple<unsigned int, unsigned int, std::size_t, std::vector<int>>;

      const InpDeck                   &deck;
      GmshModel                        result;
      std::vector<std::vector<int>>    groups; ///< by element
      std::map<std::string, int>       numbers_of;
      std::map<int, std::string>       names;
      std::map<BlockKey, GmshElements> blocks; ///< surfaces, then volumes
    };
  } // namespace

  GmshModel
  read_inp(const std::string &file, const FileError &fail)
  {
    return InpModel(read_inp_deck(file, fail)).model();
  }
} // namespace mortise
