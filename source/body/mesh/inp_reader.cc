#include <deal.II/base/tensor.h>

#include <deal.II/physics/transformations.h>

#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/inp_deck.h>
#include <mortise/body/mesh/inp_shapes.h>

#include <algorithm>
#include <cmath>

#include "inp_lines.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Walks through the lines of a file. Parts are decks of their own, which
    /// instances copy into the deck.
    class InpReader : private InpLines
    {
    public:
      InpReader(const std::string &file, const FileError &fail)
        : InpLines(file, fail)
        , fail_file(fail)
      {}

      InpDeck
      read()
      {
        while (next_line())
          if (line[0] == '*')
            begin_keyword();
          else
            data_line();
        if (deck.elements.empty())
          fail_file("holds no *ELEMENT" +
                    std::string(parts.empty() ? "" : " in an *INSTANCE"));
        return std::move(deck);
      }

    private:
      void
      begin_keyword()
      {
        // lines of data may be in a file of their own
        const auto        before       = options;
        const std::string next_keyword = read_keyword();
        if (next_keyword == "*INCLUDE")
          {
            include(options["INPUT"]);
            options = before;
            return;
          }
        keyword = next_keyword;
        if (keyword == "*PART")
          at = &parts[upper(needed("NAME"))];
        else if (keyword == "*INSTANCE")
          begin_instance();
        else if (keyword == "*END INSTANCE")
          end_instance();
        else if (keyword == "*END PART")
          at = &deck;
        else if (keyword == "*ELEMENT")
          begin_elements();
        else if (keyword == "*ELSET" || keyword == "*NSET")
          begin_set();
        else if (keyword == "*SURFACE")
          begin_surface();
        else if (keyword == "*NGEN" || keyword == "*NFILL" ||
                 keyword == "*NCOPY" || keyword == "*ELGEN" ||
                 keyword == "*ELCOPY" || keyword == "*SYSTEM")
          fail("the keyword " + keyword +
               "; allowed: nodes and elements given one by one");
        else if (keyword != "*NODE" && keyword != "*ASSEMBLY" &&
                 keyword != "*END ASSEMBLY")
          {
            at->blocks.emplace_back();
            at->blocks.back().keyword = keyword;
            at->blocks.back().options = options;
            at->blocks.back().place   = place();
          }
      }

      /// The value of an option that must be there.
      std::string
      needed(const std::string &option)
      {
        if (options[option].empty())
          fail("a " + keyword + " without a name");
        return options[option];
      }

      void
      begin_instance()
      {
        instance_name   = needed("NAME");
        const auto part = parts.find(upper(options["PART"]));
        if (part == parts.end())
          fail("an *INSTANCE of the part " + in_quotes(options["PART"], '\'') +
               ", which the file does not have before it");
        instance = part->second;
        at       = &instance;
        motion.clear();
      }

      /// Copy the instance into the deck: moved, then turned about an axis.
      void
      end_instance()
      {
        at = &deck;
        Tensor<1, 3> shift;
        Point<3>     pivot;
        Tensor<2, 3> rotation = unit_symmetric_tensor<3>();
        if (motion.size() > 0)
          shift = point_of(motion[0], 0);
        if (motion.size() > 1)
          {
            if (motion[1].size() != 7)
              fail("an *INSTANCE whose rotation has " +
                   std::to_string(motion[1].size()) +
                   " numbers before it; allowed: 7, two points and an angle");
            pivot                   = point_of(motion[1], 0);
            const Tensor<1, 3> axis = point_of(motion[1], 3) - pivot;
            if (!(axis.norm() > 0.))
              fail("an *INSTANCE with an axis of no length before it");
            rotation = Physics::Transformations::Rotations::rotation_matrix_3d(
              Point<3>(axis / axis.norm()), motion[1][6] * numbers::PI / 180.);
          }
        append(instance, upper(instance_name), [&](const Point<3> &x) {
          return pivot + rotation * (x + shift - pivot);
        });
        deck.rotations[upper(instance_name)] = rotation;
      }

      static Point<3>
      point_of(const std::vector<double> &numbers, const unsigned int first)
      {
        Point<3> x;
        for (unsigned int d = 0; d < 3 && first + d < numbers.size(); ++d)
          x[d] = numbers[first + d];
        return x;
      }

      template <typename Move>
      void
      append(const InpDeck &part, const std::string &name, const Move &move)
      {
        const unsigned int first_node    = deck.nodes.size(),
                           first_element = deck.elements.size();
        for (const Point<3> &x : part.nodes)
          deck.nodes.push_back(move(x));
        deck.node_tags.insert(deck.node_tags.end(),
                              part.node_tags.begin(),
                              part.node_tags.end());
        for (InpElement element : part.elements)
          {
            for (unsigned int &node : element.nodes)
              node += first_node;
            deck.elements.push_back(element);
          }
        const auto copy_sets =
          [&](const auto &from, auto &to, const unsigned int first) {
            for (const auto &[set, members] : from)
              for (const unsigned int member : members)
                to[name + "." + set].insert(first + member);
          };
        copy_sets(part.node_sets, deck.node_sets, first_node);
        copy_sets(part.node_surfaces, deck.node_surfaces, first_node);
        copy_sets(part.element_sets, deck.element_sets, first_element);
        for (const auto &[surface, sides] : part.surfaces)
          for (const InpSide &side : sides)
            deck.surfaces[name + "." + surface].push_back(
              {first_element + side.element, side.face});
        for (const auto &[key, written] : part.names)
          deck.names[name + "." + key] = instance_name + "." + written;
        const auto copy_places =
          [&](const auto &from, auto &to, const unsigned int first) {
            if (from.count("") > 0)
              for (const auto &[tag, place] : from.at(""))
                to[name][tag] = first + place;
          };
        copy_places(part.node_places, deck.node_places, first_node);
        copy_places(part.element_places, deck.element_places, first_element);
        deck.passed_over.insert(deck.passed_over.end(),
                                part.passed_over.begin(),
                                part.passed_over.end());
        for (InpBlock block : part.blocks)
          {
            block.instance = name;
            deck.blocks.push_back(block);
          }
        // an instance is a set of its elements
        deck.names[name] = instance_name;
        for (unsigned int e = first_element; e < deck.elements.size(); ++e)
          deck.element_sets[name].insert(e);
      }

      void
      begin_elements()
      {
        pattern            = InpElement();
        pattern.type       = upper(options["TYPE"]);
        const InpType type = inp_type(pattern.type);
        if (type.dimension == 3 && type.n_vertices == 0)
          fail("elements of type " + pattern.type +
               "; allowed: C3D4, C3D6, C3D8, C3D10, C3D15 and C3D20 in all "
               "their variants");
        n_nodes            = type.n_nodes;
        pattern.dimension  = type.n_vertices == 0 ? 0 : type.dimension;
        pattern.n_vertices = type.n_vertices;
        set_key            = "";
        if (!options["ELSET"].empty())
          set_key = named(options["ELSET"], "");
        if (!set_key.empty())
          at->element_sets[set_key];
        if (pattern.dimension != 3)
          at->passed_over.push_back(
            {{place(), "*ELEMENT, TYPE=" + pattern.type}});
      }

      /// The key of a set, whose name as it is written is kept.
      std::string
      named(const std::string &name, const std::string &of_instance)
      {
        const std::string key =
          (of_instance.empty() ? "" : of_instance + ".") + upper(name);
        at->names.emplace(key,
                          (of_instance.empty() ? "" : of_instance + ".") +
                            name);
        return key;
      }

      void
      begin_set()
      {
        scope   = upper(options["INSTANCE"]);
        set_key = named(needed(keyword.substr(1)), "");
        if (keyword == "*NSET")
          at->node_sets[set_key];
        else
          at->element_sets[set_key];
        if (keyword == "*NSET" && !options["ELSET"].empty())
          for (const unsigned int e :
               at->find_elements(options["ELSET"], scope))
            at->node_sets[set_key].insert(at->elements[e].nodes.begin(),
                                          at->elements[e].nodes.end());
      }

      void
      begin_surface()
      {
        set_key = named(needed("NAME"), "");
        if (options.count("COMBINE") > 0)
          fail("a *SURFACE with COMBINE; allowed: TYPE=ELEMENT and TYPE=NODE");
        if (upper(options["TYPE"]) == "NODE")
          at->node_surfaces[set_key];
        else
          at->surfaces[set_key];
      }

      void
      data_line()
      {
        if (keyword == "*NODE")
          read_node();
        else if (keyword == "*ELEMENT")
          pattern.dimension > 0 ? read_element() : pass_over_element();
        else if (keyword == "*ELSET" || keyword == "*NSET")
          read_set();
        else if (keyword == "*SURFACE")
          read_surface();
        else if (keyword == "*INSTANCE")
          {
            motion.emplace_back();
            for (const std::string &word : words_of(line))
              motion.back().push_back(real(word));
          }
        else if (!at->blocks.empty() && at->blocks.back().keyword == keyword)
          at->blocks.back().lines.push_back({words_of(line), place()});
      }

      void
      read_node()
      {
        const auto words = words_of(line);
        if (words.size() < 2)
          fail("a node without coordinates");
        if (options.count("SYSTEM") > 0 && upper(options["SYSTEM"]) != "R")
          fail("nodes in another system; allowed: x, y, z");
        Point<3> x;
        for (unsigned int d = 0; d + 1 < std::min<std::size_t>(4, words.size());
             ++d)
          x[d] = words[d + 1].empty() ? 0. : real(words[d + 1]);
        const long tag = integer(words[0]);
        if (!at->node_places[""].emplace(tag, at->nodes.size()).second)
          fail("the node " + words[0] + " a second time");
        if (!options["NSET"].empty())
          at->node_sets[named(options["NSET"], "")].insert(at->nodes.size());
        at->nodes.push_back(x);
        at->node_tags.push_back(tag);
      }

      void
      read_element()
      {
        auto words = words_of(line);
        while (words.size() < n_nodes + 1)
          {
            if (!next_line() || line[0] == '*')
              fail("an element with fewer than " + std::to_string(n_nodes) +
                   " nodes before it");
            for (const std::string &word : words_of(line))
              words.push_back(word);
          }
        InpElement element = pattern;
        element.tag        = integer(words[0]);
        const auto &places = at->node_places[""];
        for (unsigned int v = 0; v < n_nodes; ++v)
          {
            const auto node = places.find(integer(words[v + 1]));
            if (node == places.end())
              fail("the node " + words[v + 1] +
                   ", which the file does not have before it");
            element.nodes.push_back(node->second);
          }
        if (!at->element_places[""]
               .emplace(element.tag, at->elements.size())
               .second)
          fail("the element " + words[0] + " a second time");
        if (!set_key.empty())
          at->element_sets[set_key].insert(at->elements.size());
        at->elements.push_back(element);
      }

      /// Of an element that is none here its number is kept, and what may be
      /// one: how many lines it has is not known.
      void
      pass_over_element()
      {
        if (const auto tag = integer_if_any(words_of(line)[0]))
          other_elements.insert(*tag);
      }

      /// Members of a set: numbers, or other sets.
      void
      read_set()
      {
        const bool of_elements = keyword == "*ELSET";
        const auto words       = words_of(line);
        auto      &sets        = of_elements ? at->element_sets : at->node_sets;
        auto      &members     = sets[set_key];
        if (options.count("GENERATE") > 0)
          {
            if (words.size() < 2)
              fail("a range without its end");
            const long first = integer(words[0]), last = integer(words[1]),
                       step = words.size() > 2 ? integer(words[2]) : 1;
            if (step < 1)
              fail("a range with the step " + std::to_string(step));
            // only those that are there: ranges may be of any length
            const auto &known =
              of_elements ? at->element_places[scope] : at->node_places[scope];
            for (auto it = known.lower_bound(first);
                 it != known.end() && it->first <= last;
                 ++it)
              if ((it->first - first) % step == 0)
                members.insert(it->second);
            return;
          }
        for (const std::string &word : words)
          {
            if (word.empty())
              continue;
            const auto more = of_elements ? at->find_elements(word, scope) :
                                            at->find_nodes(word, scope);
            if (more.empty() && !integer_if_any(word) &&
                at->find_set(sets, word, scope) == nullptr)
              fail("the set " + in_quotes(word, '\'') +
                   ", which the file does not have before it");
            members.insert(more.begin(), more.end());
          }
      }

      /// "elements, S3", or elements alone: their faces at no other element.
      void
      read_surface()
      {
        const auto words = words_of(line);
        if (at->node_surfaces.count(set_key) > 0)
          {
            const auto nodes = at->find_nodes(words[0], "");
            at->node_surfaces[set_key].insert(nodes.begin(), nodes.end());
            return;
          }
        const std::string side = words.size() > 1 ? upper(words[1]) : "";
        if (side == "SPOS" || side == "SNEG")
          return at->passed_over.push_back({{place(), "a side of *SURFACE"}});
        if (!side.empty() && (side.size() != 2 || side[0] != 'S' ||
                              side[1] < '1' || side[1] > '6'))
          fail("a surface " + in_quotes(line, '\'') +
               "; allowed: an element or a set of elements, and S1 to S6");
        const auto members = at->find_elements(words[0], "");
        const auto tag     = integer_if_any(words[0]);
        if (members.empty() &&
            (tag ? other_elements.count(*tag) > 0 :
                   at->find_set(at->element_sets, words[0], "") != nullptr))
          return at->passed_over.push_back({{place(), "a side of *SURFACE"}});
        if (members.empty() && tag)
          fail("the element " + words[0] + ", which the file does not have");
        if (members.empty())
          fail("the set " + in_quotes(words[0], '\'') +
               ", which the file does not have before it");
        if (side.empty())
          return add_free_faces(members);
        const unsigned int face = side[1] - '1';
        for (const unsigned int e : members)
          {
            const InpElement &element = at->elements[e];
            if (element.dimension != 3)
              {
                at->passed_over.push_back({{place(), "a side of *SURFACE"}});
                continue;
              }
            if (face >= inp_shape(element.n_vertices).faces.size())
              fail("the side " + side + " of element " +
                   std::to_string(element.tag) + ", which has none such");
            at->surfaces[set_key].push_back({e, face});
          }
      }

      void
      add_free_faces(const std::set<unsigned int> &members)
      {
        std::map<std::set<unsigned int>, std::vector<InpSide>> faces;
        for (unsigned int e = 0; e < at->elements.size(); ++e)
          if (at->elements[e].dimension == 3)
            for (unsigned int f = 0;
                 f < inp_shape(at->elements[e].n_vertices).faces.size();
                 ++f)
              {
                const auto nodes = at->nodes_of({e, f});
                faces[{nodes.begin(), nodes.end()}].push_back({e, f});
              }
        for (const auto &face : faces)
          if (face.second.size() == 1 &&
              members.count(face.second[0].element) > 0)
            at->surfaces[set_key].push_back(face.second[0]);
      }

      const FileError &fail_file;
      std::string      keyword; ///< of the lines of data
      std::string      set_key; ///< of the set or surface that is read
      std::string      scope;   ///< instance of the members of a set
      InpElement       pattern;
      std::size_t      n_nodes = 0;

      InpDeck                          deck, instance;
      InpDeck                         *at = &deck; ///< what is read
      std::map<std::string, InpDeck>   parts;
      std::set<long>                   other_elements;
      std::string                      instance_name;
      std::vector<std::vector<double>> motion; ///< lines of *INSTANCE
    };
  } // namespace

  InpDeck
  read_inp_deck(const std::string &file, const FileError &fail)
  {
    return InpReader(file, fail).read();
  }
} // namespace mortise
