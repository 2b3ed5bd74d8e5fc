#include <mortise/base/error.h>
#include <mortise/base/quotes.h>

#include <algorithm>
#include <array>
#include <set>

#include "inp_lines.h"
#include "inp_shapes.h"
#include "mesh_file_parts.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    struct InpElement
    {
      unsigned int              dimension = 0, n_vertices = 0;
      std::vector<unsigned int> nodes;
      std::size_t               tag = 0;
      std::set<int>             groups;
    };

    /// Walks through the lines of one file.
    class InpReader : private InpLines
    {
    public:
      InpReader(const std::string &content, const FileError &fail)
        : InpLines(content, fail)
        , fail_file(fail)
      {}

      GmshModel
      read()
      {
        while (next_line())
          if (line[0] == '*')
            begin_keyword();
          else if (!read_data.empty())
            data_line();
        if (elements.empty())
          fail_file("holds no *ELEMENT");
        return finish();
      }

    private:
      void
      begin_keyword()
      {
        const std::string keyword = read_keyword();
        read_data                 = "";
        if (keyword == "*PART" || keyword == "*INSTANCE")
          fail("the keyword " + keyword +
               "; allowed: one mesh without parts and instances (in Abaqus: "
               "Model attributes, no parts and assemblies in input files)");
        if (keyword == "*INCLUDE")
          fail("the keyword *INCLUDE; allowed: all in one file");
        if (keyword == "*ELEMENT")
          begin_elements();
        else if (keyword == "*SURFACE" && upper(options["TYPE"]) == "NODE")
          return;
        else if (keyword == "*NODE" || keyword == "*ELSET" ||
                 keyword == "*NSET" || keyword == "*SURFACE")
          read_data = keyword;
        if (read_data == "*ELSET" || read_data == "*NSET" ||
            read_data == "*SURFACE")
          {
            const std::string name =
              options[read_data == "*SURFACE" ? "NAME" : read_data.substr(1)];
            if (name.empty())
              fail("a " + read_data + " without a name");
            set_name = name;
          }
      }

      void
      begin_elements()
      {
        const std::string name = upper(options["TYPE"]);
        const InpType     type = inp_type(name);
        if (type.dimension == 3 && type.n_vertices == 0)
          fail("elements of type " + name +
               "; allowed: C3D4, C3D6, C3D8, C3D10, C3D15 and C3D20 in all "
               "their variants");
        if (type.n_vertices == 0)
          return; // beams, springs: no part of a body
        pattern            = InpElement();
        pattern.dimension  = type.dimension;
        pattern.n_vertices = type.n_vertices;
        n_nodes            = type.n_nodes;
        read_data          = "*ELEMENT";
        if (!options["ELSET"].empty())
          pattern.groups = {group(options["ELSET"])};
      }

      void
      data_line()
      {
        if (read_data == "*NODE")
          read_node();
        else if (read_data == "*ELEMENT")
          read_element();
        else if (read_data == "*SURFACE")
          read_surface();
        else
          read_set();
      }

      void
      read_node()
      {
        const auto words = words_of(line);
        if (words.size() < 3)
          fail("a node with fewer than two coordinates");
        Point<3> x;
        for (unsigned int d = 0; d + 1 < std::min<std::size_t>(4, words.size());
             ++d)
          x[d] = real(words[d + 1]);
        const long tag = integer(words[0]);
        if (!places.emplace(tag, model.nodes.size()).second)
          fail("the node " + words[0] + " a second time");
        model.nodes.push_back(x);
        model.node_tags.push_back(tag);
        if (options.count("NSET") > 0)
          {
            node_sets[upper(options["NSET"])].insert(tag);
            names.emplace(upper(options["NSET"]), options["NSET"]);
          }
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
        for (unsigned int v = 0; v < n_nodes; ++v)
          {
            const auto place = places.find(integer(words[v + 1]));
            if (place == places.end())
              fail("the node " + words[v + 1] +
                   ", which the file does not have before it");
            element.nodes.push_back(place->second);
          }
        if (!element_places.emplace(element.tag, elements.size()).second)
          fail("the element " + words[0] + " a second time");
        elements.push_back(element);
      }

      /// Members of a set: numbers, or other sets.
      void
      read_set()
      {
        const bool of_elements = read_data == "*ELSET";
        const auto words       = words_of(line);
        auto      &sets        = of_elements ? element_sets : node_sets;
        names.emplace(upper(set_name), set_name);
        std::set<long> &members = sets[upper(set_name)];
        if (options.count("GENERATE") > 0)
          {
            if (words.size() < 2)
              fail("a range without its end");
            const long first = integer(words[0]), last = integer(words[1]),
                       step = words.size() > 2 ? integer(words[2]) : 1;
            if (step < 1)
              fail("a range with the step " + std::to_string(step));
            // only those that are there: ranges may be of any length
            const auto &known = of_elements ? element_places : places;
            for (auto it = known.lower_bound(first);
                 it != known.end() && it->first <= last;
                 ++it)
              if ((it->first - first) % step == 0)
                members.insert(it->first);
            return;
          }
        for (const std::string &word : words)
          if (const auto value = integer_if_any(word))
            members.insert(*value);
          else if (sets.count(upper(word)) > 0)
            members.insert(sets.at(upper(word)).begin(),
                           sets.at(upper(word)).end());
          else
            fail("the set " + in_quotes(word, '\'') +
                 ", which the file does not have before it");
      }

      /// "elements, S3".
      void
      read_surface()
      {
        const auto        words = words_of(line);
        const std::string side  = words.size() > 1 ? upper(words[1]) : "";
        if (side.size() != 2 || side[0] != 'S' || side[1] < '1' ||
            side[1] > '6')
          fail("a surface " + in_quotes(line, '\'') +
               "; allowed: an element or a set of elements, and S1 to S6");
        std::set<long> members;
        if (const auto value = integer_if_any(words[0]))
          members = {*value};
        else if (element_sets.count(upper(words[0])) > 0)
          members = element_sets.at(upper(words[0]));
        else
          for (const InpElement &element : elements)
            if (element.groups.count(group(words[0])) > 0)
              members.insert(element.tag);
        if (members.empty())
          fail("the set " + in_quotes(words[0], '\'') +
               ", which the file does not have before it");
        for (const long tag : members)
          {
            const auto place = element_places.find(tag);
            if (place == element_places.end())
              fail("the element " + std::to_string(tag) +
                   ", which the file does not have");
            const InpElement &element = elements[place->second];
            const auto       &faces   = inp_shape(element.n_vertices).faces;
            const std::size_t f       = side[1] - '1';
            if (element.dimension != 3 || f >= faces.size())
              fail("the side " + side + " of element " + std::to_string(tag) +
                   ", which has none such");
            add_face(element, faces[f], set_name);
          }
      }

      void
      add_face(const InpElement                &cell,
               const std::vector<unsigned int> &vertices,
               const std::string               &name)
      {
        InpElement face;
        face.dimension  = 2;
        face.n_vertices = vertices.size();
        face.tag        = cell.tag;
        face.groups     = {group(name)};
        for (const unsigned int v : vertices)
          face.nodes.push_back(cell.nodes[v]);
        faces_of_sets.push_back(face);
      }

      /// The number of a set by its name, whatever the case of its letters.
      int
      group(const std::string &name)
      {
        names.emplace(upper(name), name);
        return groups.emplace(upper(name), groups.size() + 1).first->second;
      }

      /// Sides of cells all of whose vertices are in a set of nodes.
      void
      add_node_sets()
      {
        for (const auto &[name, tags] : node_sets)
          {
            std::vector<bool> in_set(model.nodes.size(), false);
            for (const long tag : tags)
              if (places.count(tag) > 0)
                in_set[places.at(tag)] = true;
            const bool has_all =
              std::all_of(elements.begin(), elements.end(), [&](const auto &e) {
                return std::all_of(e.nodes.begin(),
                                   e.nodes.begin() + e.n_vertices,
                                   [&](const auto v) { return in_set[v]; });
              });
            if (has_all)
              continue; // the set that is called NALL
            for (const InpElement &cell : elements)
              if (cell.dimension == 3)
                for (const auto &face : inp_shape(cell.n_vertices).faces)
                  if (std::all_of(face.begin(), face.end(), [&](const auto v) {
                        return in_set[cell.nodes[v]];
                      }))
                    add_face(cell, face, names.at(name));
          }
      }

      static std::vector<Point<3>>
      reference_of(const InpElement &element)
      {
        if (element.dimension == 2)
          return std::vector<Point<3>>(element.n_vertices);
        const InpShape       &shape = inp_shape(element.n_vertices);
        std::vector<Point<3>> nodes = shape.vertices;
        if (element.nodes.size() > element.n_vertices)
          for (const auto &edge : shape.edges)
            nodes.push_back(nodes[edge[0]] +
                            (nodes[edge[1]] - nodes[edge[0]]) / 2.);
        return nodes;
      }

      void
      add_blocks(const std::vector<InpElement> &sorted, const bool solid)
      {
        std::map<std::array<std::size_t, 2>,
                 std::map<std::set<int>, GmshElements>>
          blocks;
        for (const InpElement &element : sorted)
          {
            if ((element.dimension == 3) != solid)
              continue;
            const std::size_t n =
              solid ? element.nodes.size() : element.n_vertices;
            GmshElements &block =
              blocks[{element.n_vertices, n}][element.groups];
            if (block.reference.empty())
              {
                block.groups.assign(element.groups.begin(),
                                    element.groups.end());
                block.dimension  = element.dimension;
                block.n_vertices = element.n_vertices;
                block.order      = n > element.n_vertices ? 2 : 1;
                block.type = solid ? inp_shape(element.n_vertices).name + " " +
                                       std::to_string(n) :
                                     "side";
                block.reference = reference_of(element);
              }
            block.nodes.insert(block.nodes.end(),
                               element.nodes.begin(),
                               element.nodes.begin() + n);
            block.tags.push_back(element.tag);
          }
        for (const auto &shape : blocks)
          for (const auto &block : shape.second)
            model.elements.push_back(block.second);
      }

      GmshModel
      finish()
      {
        for (const auto &[name, tags] : element_sets)
          for (const long tag : tags)
            if (element_places.count(tag) > 0)
              elements[element_places.at(tag)].groups.insert(
                group(names.at(name)));
        add_node_sets();
        add_blocks(faces_of_sets, false);
        add_blocks(elements, false);
        add_blocks(elements, true);
        for (const GmshElements &block : model.elements)
          for (const int tag : block.groups)
            for (const auto &[name, its_tag] : groups)
              if (its_tag == tag)
                (block.dimension == 2 ? model.surface_names :
                                        model.volume_names)[tag] =
                  names.at(name);
        model.surfaces_may_overlap = true;
        return std::move(model);
      }

      const FileError &fail_file;
      std::string      read_data; ///< keyword; empty: skipped
      std::string      set_name;
      InpElement       pattern;
      std::size_t      n_nodes = 0;

      GmshModel                             model;
      std::map<long, std::size_t>           places, element_places;
      std::vector<InpElement>               elements, faces_of_sets;
      std::map<std::string, std::set<long>> element_sets, node_sets;
      std::map<std::string, std::string>    names;  ///< as first written
      std::map<std::string, int>            groups; ///< by name in capitals
    };
  } // namespace

  GmshModel
  read_inp(const std::string &content, const FileError &fail)
  {
    return InpReader(content, fail).read();
  }
} // namespace mortise
