#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "mesh_file_parts.h"
#include "msh_scanner.h"

namespace mortise
{
  namespace
  {
    /// Number of nodes by gmsh's type of elements, up to third order.
    const std::map<int, unsigned int> element_nodes = {
      {1, 2},   {2, 3},   {3, 4},   {4, 4},   {5, 8},   {6, 6},
      {7, 5},   {8, 3},   {9, 6},   {10, 9},  {11, 10}, {12, 27},
      {13, 18}, {14, 14}, {15, 1},  {16, 8},  {17, 20}, {18, 15},
      {19, 13}, {20, 9},  {21, 10}, {26, 4},  {29, 20}, {36, 16},
      {39, 12}, {90, 40}, {91, 40}, {92, 64}, {99, 32}, {118, 30}};

    /// The tags of nodes that a file has.
    class NodeTags
    {
    public:
      void
      add(const std::int64_t tag, MshScanner &in)
      {
        if (tag < 1)
          in.fail("a node has the tag " + std::to_string(tag));
        tags.push_back(tag);
      }

      void
      finish(MshScanner &in)
      {
        std::sort(tags.begin(), tags.end());
        if (!tags.empty() && static_cast<std::uint64_t>(tags.back()) >
                               100 * tags.size() + 1000000)
          in.fail("the tags of nodes are spread up to " +
                  std::to_string(tags.back()));
      }

      void
      check(const std::int64_t tag, MshScanner &in) const
      {
        if (!std::binary_search(tags.begin(), tags.end(), tag))
          in.fail("an element has the node " + std::to_string(tag) +
                  ", which the file does not have");
      }

    private:
      std::vector<std::int64_t> tags;
    };

    unsigned int
    nodes_of(const int type, MshScanner &in)
    {
      const auto known = element_nodes.find(type);
      if (known == element_nodes.end())
        in.fail("there are elements of gmsh's type " + std::to_string(type) +
                "; allowed: tetrahedra and hexahedra of first or second order");
      return known->second;
    }

    /// Points, curves, surfaces and volumes of version 4.1.
    void
    walk_entities(MshScanner &in)
    {
      std::uint64_t n[4];
      for (std::uint64_t &m : n)
        {
          m = in.count();
          in.fits(m, 32, "entities");
        }
      for (unsigned int dimension = 0; dimension < 4; ++dimension)
        for (std::uint64_t i = 0; i < n[dimension]; ++i)
          {
            in.integer();
            in.skip_reals(dimension == 0 ? 3 : 6);
            in.skip_integers(in.count()); // physical groups
            if (dimension > 0)
              in.skip_integers(in.count()); // boundary
          }
    }

    void
    walk_nodes_4(MshScanner &in, NodeTags &nodes)
    {
      const std::uint64_t blocks = in.count(), n = in.count();
      in.count();
      in.count();
      in.fits(blocks, 20, "blocks of nodes");
      in.fits(n, 32, "nodes");
      for (std::uint64_t block = 0; block < blocks; ++block)
        {
          const int dimension = in.integer();
          in.integer();
          const int           parametric = in.integer();
          const std::uint64_t m          = in.count();
          in.fits(m, 32, "nodes");
          if (dimension < 0 || dimension > 3 || parametric < 0 ||
              parametric > 1)
            in.fail("a block of nodes does not begin as it should");
          std::vector<std::int64_t> tags(m);
          for (std::int64_t &tag : tags)
            {
              tag = in.count();
              nodes.add(tag, in);
            }
          for (const std::int64_t tag : tags)
            {
              in.coordinates(tag);
              in.skip_reals(parametric == 1 ? dimension : 0);
            }
        }
    }

    void
    walk_elements_4(MshScanner &in, const NodeTags &nodes)
    {
      const std::uint64_t blocks = in.count(), n = in.count();
      in.count();
      in.count();
      in.fits(blocks, 20, "blocks of elements");
      in.fits(n, 16, "elements");
      for (std::uint64_t block = 0; block < blocks; ++block)
        {
          const int dimension = in.integer();
          in.integer();
          const unsigned int  per_element = nodes_of(in.integer(), in);
          const std::uint64_t m           = in.count();
          in.fits(m, 8 * (per_element + 1), "elements");
          if (dimension < 0 || dimension > 3)
            in.fail("a block of elements does not begin as it should");
          for (std::uint64_t i = 0; i < m; ++i)
            {
              in.count();
              for (unsigned int v = 0; v < per_element; ++v)
                nodes.check(in.count(), in);
            }
        }
    }

    void
    walk_nodes_2(MshScanner &in, NodeTags &nodes)
    {
      const std::uint64_t n = in.line_count();
      in.fits(n, 28, "nodes");
      for (std::uint64_t i = 0; i < n; ++i)
        {
          const int tag = in.integer();
          nodes.add(tag, in);
          in.coordinates(tag);
        }
    }

    void
    walk_elements_2(MshScanner &in, const NodeTags &nodes)
    {
      const std::uint64_t n = in.line_count();
      in.fits(n, 8, "elements");
      for (std::uint64_t done = 0; done < n;)
        {
          // as bytes, elements come in blocks of one type, their tag last
          int index = 0, block = 1;
          if (!in.binary)
            index = in.integer();
          const unsigned int per_element = nodes_of(in.integer(), in);
          if (in.binary)
            block = in.integer();
          const int tags = in.integer();
          if (index < 0 || block < 1 || tags < 0)
            in.fail("an element does not begin as it should");
          for (int i = 0; i < block; ++i)
            {
              if (in.binary)
                in.integer();
              in.skip_integers(tags);
              for (unsigned int v = 0; v < per_element; ++v)
                nodes.check(in.integer(), in);
            }
          done += block;
        }
    }

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

  void
  check_msh_content(const std::string &content, const FileError &fail)
  {
    MshScanner in(content, fail);
    const bool version_4 = read_header(content, in, fail);
    NodeTags   nodes;
    bool       has_nodes = false, has_elements = false;
    in.end_section(false);
    while (in.next_section())
      {
        const std::string section = in.section;
        const bool        known = section == "Nodes" || section == "Elements" ||
                           (section == "Entities" && version_4);
        if (section == "Entities" && version_4)
          walk_entities(in);
        if (section == "Nodes")
          {
            version_4 ? walk_nodes_4(in, nodes) : walk_nodes_2(in, nodes);
            nodes.finish(in);
            has_nodes = true;
          }
        if (section == "Elements")
          {
            version_4 ? walk_elements_4(in, nodes) : walk_elements_2(in, nodes);
            has_elements = true;
          }
        in.end_section(known);
      }
    if (!has_nodes || !has_elements)
      fail(std::string("ends before $End") +
           (has_nodes ? "Elements" : "Nodes") + "; allowed: a complete file");
  }
} // namespace mortise
