#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <set>
#include <sstream>

#include "mesh_file_parts.h"
#include "msh_scanner.h"
#include "msh_tags.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    struct ElementSize
    {
      int          dimension;
      unsigned int n_nodes;
    };

    /// By gmsh's number of the type of elements, up to third order.
    const std::map<int, ElementSize> element_sizes = {
      {1, {1, 2}},   {2, {2, 3}},   {3, {2, 4}},   {4, {3, 4}},   {5, {3, 8}},
      {6, {3, 6}},   {7, {3, 5}},   {8, {1, 3}},   {9, {2, 6}},   {10, {2, 9}},
      {11, {3, 10}}, {12, {3, 27}}, {13, {3, 18}}, {14, {3, 14}}, {15, {0, 1}},
      {16, {2, 8}},  {17, {3, 20}}, {18, {3, 15}}, {19, {3, 13}}, {20, {2, 9}},
      {21, {2, 10}}, {26, {1, 4}},  {29, {3, 20}}, {36, {2, 16}}, {39, {2, 12}},
      {92, {3, 64}}, {99, {3, 32}}, {118, {3, 30}}};

    constexpr std::array<const char *, 4> entity_names = {
      {"point", "curve", "surface", "volume"}};

    /// Walks through the sections of one file. Those that say nothing of nodes,
    /// elements and names are passed over.
    class MshReader
    {
    public:
      MshReader(MshScanner &in, const bool version_4)
        : in(in)
        , version_4(version_4)
      {}

      GmshModel
      read()
      {
        in.end_section(false);
        std::set<std::string> done;
        while (in.next_section())
          {
            const std::string section = in.section;
            if (section.compare(0, 3, "End") == 0)
              in.fail("the section ends before it begins");
            if (done.count(section) > 0)
              in.fail("the section comes a second time; allowed: once");
            const bool known = read_section(section);
            if (known)
              done.insert(section);
            in.end_section(known);
          }
        for (const char *section : {"Nodes", "Elements"})
          if (done.count(section) == 0)
            in.fail_at_end(section);
        return finish();
      }

    private:
      /// Of elements that are in one block: dimension, tag of the entity,
      /// physical group (version 2.2, else 0), number of the type.
      using BlockKey = std::array<int, 4>;

      bool
      read_section(const std::string &section)
      {
        if (section == "PhysicalNames")
          read_names();
        else if (section == "Entities" && version_4)
          read_entities(false);
        else if (section == "PartitionedEntities" && version_4)
          {
            in.count(); // partitions
            for (std::uint64_t ghosts = in.count(); ghosts > 0; --ghosts)
              in.integers(2);
            read_entities(true);
          }
        else if (section == "Nodes")
          {
            version_4 ? read_nodes_4() : read_nodes_2();
            nodes.finish(in);
          }
        else if (section == "Elements")
          version_4 ? read_elements_4() : read_elements_2();
        else
          return false;
        return true;
      }

      void
      read_names()
      {
        const std::uint64_t n = in.line_count();
        in.fits(n, 5, "physical groups");
        for (std::uint64_t i = 0; i < n; ++i)
          {
            const int dimension = in.line_integer();
            check_dimension(dimension);
            const int tag           = in.line_integer();
            names[{dimension, tag}] = in.quoted();
          }
      }

      void
      check_dimension(const int dimension) const
      {
        if (dimension < 0 || dimension > 3)
          in.fail("there is the dimension " + std::to_string(dimension) +
                  "; allowed: 0 to 3");
      }

      /// Points, curves, surfaces and volumes of version 4.1.
      void
      read_entities(const bool of_partitions)
      {
        std::array<std::uint64_t, 4> n;
        for (std::uint64_t &m : n)
          {
            m = in.count();
            in.fits(m, 32, "entities");
          }
        for (int dimension = 0; dimension < 4; ++dimension)
          for (std::uint64_t i = 0; i < n[dimension]; ++i)
            {
              const int tag = in.integer();
              if (of_partitions)
                {
                  in.integers(2); // entity that it is a part of
                  in.integers(in.count());
                }
              in.skip_reals(dimension == 0 ? 3 : 6);
              std::set<int> groups;
              for (const int group : in.integers(in.count()))
                groups.insert(std::abs(group)); // a sign is an orientation
              if (dimension > 0)
                in.integers(in.count()); // boundary
              if (!entities.insert({{dimension, tag}, groups}).second)
                in.fail("the " + std::string(entity_names[dimension]) + " " +
                        std::to_string(tag) + " comes twice; allowed: once");
            }
      }

      void
      read_nodes_4()
      {
        Total total("nodes", 32, in);
        for (std::uint64_t block = 0; block < total.n_blocks(); ++block)
          {
            const int dimension = in.integer();
            check_dimension(dimension);
            in.integer(); // entity
            const int parametric = in.integer();
            if (parametric < 0 || parametric > 1)
              in.fail("a block of nodes is parametric: " +
                      std::to_string(parametric) + "; allowed: 0 or 1");
            const std::uint64_t m = in.count();
            in.fits(m, 32, "nodes");
            const std::size_t first = model.node_tags.size();
            for (std::uint64_t i = 0; i < m; ++i)
              {
                model.node_tags.push_back(in.count());
                total.check(model.node_tags.back(), in);
                nodes.add(model.node_tags.back(), in);
              }
            for (std::uint64_t i = 0; i < m; ++i)
              {
                model.nodes.push_back(
                  in.coordinates(model.node_tags[first + i]));
                in.skip_reals(parametric == 1 ? dimension : 0);
              }
          }
        total.finish(in);
      }

      void
      read_nodes_2()
      {
        const std::uint64_t n = in.line_count();
        in.fits(n, 28, "nodes");
        for (std::uint64_t i = 0; i < n; ++i)
          {
            const std::uint64_t tag = in.tag();
            nodes.add(tag, in);
            model.node_tags.push_back(tag);
            model.nodes.push_back(in.coordinates(tag));
          }
      }

      ElementSize
      size_of(const int type) const
      {
        const auto known = element_sizes.find(type);
        if (known == element_sizes.end())
          in.fail(
            "there are elements of gmsh's type " + std::to_string(type) +
            "; allowed: tetrahedra and hexahedra of first or second order");
        return known->second;
      }

      /// The next @p n numbers of nodes are those of the element @p tag.
      void
      read_element(const BlockKey &key, const std::uint64_t tag)
      {
        const unsigned int n     = size_of(key[3]).n_nodes;
        auto *const        block = key[0] >= 2 ? &elements[key] : nullptr;
        for (unsigned int v = 0; v < n; ++v)
          {
            const std::uint64_t node  = version_4 ? in.count() : in.tag();
            const unsigned int  place = nodes.index(node, in);
            if (block != nullptr)
              block->second.push_back(place);
          }
        if (block != nullptr)
          block->first.push_back(tag);
      }

      void
      read_elements_4()
      {
        Total total("elements", 16, in);
        for (std::uint64_t block = 0; block < total.n_blocks(); ++block)
          {
            const int dimension = in.integer();
            check_dimension(dimension);
            const int         entity = in.integer(), type = in.integer();
            const ElementSize size = size_of(type);
            if (size.dimension != dimension)
              in.fail("elements of gmsh's type " + std::to_string(type) +
                      " are said to have dimension " +
                      std::to_string(dimension) +
                      "; allowed: " + std::to_string(size.dimension));
            if (entities.count({dimension, entity}) == 0)
              in.fail("there are elements of the " +
                      std::string(entity_names[dimension]) + " " +
                      std::to_string(entity) +
                      ", which the file does not have in $Entities");
            const std::uint64_t m = in.count();
            in.fits(m, 8 * (size.n_nodes + 1), "elements");
            for (std::uint64_t i = 0; i < m; ++i)
              {
                const std::uint64_t tag = in.count();
                total.check(tag, in);
                read_element({{dimension, entity, 0, type}}, tag);
              }
          }
        total.finish(in);
      }

      void
      read_elements_2()
      {
        const std::uint64_t n = in.line_count();
        in.fits(n, 8, "elements");
        for (std::uint64_t done = 0; done < n;)
          {
            // as bytes, elements come in blocks of one type, their tag last
            int index = 0, block = 1;
            if (!in.binary)
              index = in.integer();
            const int         type = in.integer();
            const ElementSize size = size_of(type);
            if (in.binary)
              block = in.integer();
            const int n_tags = in.integer();
            if (index < 0 || block < 1 || n_tags < 0)
              in.fail("an element does not begin as it should");
            done += block;
            if (done > n)
              in.fail("there are " + std::to_string(done) +
                      " elements; allowed: " + std::to_string(n) +
                      ", as the section says first");
            for (int i = 0; i < block; ++i)
              {
                if (in.binary)
                  index = in.integer();
                const std::vector<int> tags = in.integers(n_tags);
                const int group  = n_tags > 0 ? std::abs(tags[0]) : 0;
                const int entity = n_tags > 1 ? tags[1] : 0;
                if (group != 0)
                  entities[{size.dimension, entity}].insert(group);
                read_element({{size.dimension, entity, group, type}}, index);
              }
          }
      }

      /// The elements of surfaces, then those of volumes.
      GmshModel
      finish()
      {
        std::map<int, GmshElements> types;
        for (const auto &[key, block] : elements)
          {
            const auto &[dimension, entity, group, type] = key;
            if (types.count(type) == 0)
              types[type] = describe_gmsh_elements(type);
            GmshElements result = types.at(type);
            result.tags         = block.first;
            result.nodes        = block.second;
            if (version_4)
              {
                const std::set<int> &groups = entities.at({dimension, entity});
                result.groups.assign(groups.begin(), groups.end());
              }
            else if (group != 0)
              result.groups = {group};
            model.elements.push_back(std::move(result));
          }
        for (const auto &[place, groups] : entities)
          for (const int group : groups)
            if (place.first >= 2)
              {
                const auto name = names.find({place.first, group});
                (place.first == 2 ? model.surface_names :
                                    model.volume_names)[group] =
                  name == names.end() || name->second.empty() ?
                    std::to_string(group) :
                    name->second;
              }
        model.cells_are_in_one_group = !version_4;
        return std::move(model);
      }

      MshScanner &in;
      const bool  version_4;
      GmshModel   model;
      NodeTags    nodes;
      /// Names of physical groups by dimension and tag.
      std::map<std::pair<int, int>, std::string> names;
      /// Physical groups by dimension and tag of the entity.
      std::map<std::pair<int, int>, std::set<int>> entities;
      /// Tags of elements and indices of their nodes.
      std::map<BlockKey,
               std::pair<std::vector<std::size_t>, std::vector<unsigned int>>>
        elements;
    };

    /// Version 4.1 (else 2.2).
    bool
    read_header(const std::string &content,
                MshScanner        &in,
                const FileError   &fail)
    {
      if (content.compare(0, 11, "$MeshFormat") != 0)
        fail(
          "does not begin with $MeshFormat; allowed: gmsh's .msh format, version 2.2 or 4.1");
      std::istringstream header(content.substr(11, 100));
      std::string        version, binary;
      header >> version >> binary;
      if ((version != "2.2" && version != "4.1") ||
          (binary != "0" && binary != "1"))
        fail("has format version " + version +
             "; allowed: 2.2 or 4.1, ASCII or binary (gmsh -format msh41)");
      in.next_section();
      in.binary = binary == "1";
      if (in.binary)
        {
          // the first line, then a one in the byte order of the writer
          const std::size_t line = content.find('\n', content.find('\n') + 1);
          int               one  = 0;
          if (line != std::string::npos &&
              line + 1 + sizeof(int) < content.size())
            std::memcpy(&one, &content[line + 1], sizeof(int));
          if (one != 1)
            fail(
              "is binary, but not in the byte order of this machine; allowed: ASCII");
        }
      return version == "4.1";
    }
  } // namespace

  GmshModel
  read_msh(const std::string &content, const FileError &fail)
  {
    MshScanner in(content, fail);
    const bool version_4 = read_header(content, in, fail);
    return MshReader(in, version_4).read();
  }
} // namespace mortise
