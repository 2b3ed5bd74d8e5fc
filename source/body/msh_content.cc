#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "mesh_file_parts.h"

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

    /// Reads numbers one by one, as text or as bytes, and fails at the end of
    /// the file.
    class Scanner
    {
    public:
      Scanner(const std::string &content, const FileError &file_error)
        : content(content)
        , file_error(file_error)
      {}

      [[noreturn]] void
      fail(const std::string &what) const
      {
        file_error("is not a complete mesh: in $" + section + ", byte " +
                   std::to_string(at) + ", " + what);
        std::abort(); // file_error throws
      }

      int
      integer()
      {
        return binary ? bytes<int>() : static_cast<int>(text_integer());
      }

      /// A number of things or a tag: size_t in version 4.1.
      std::uint64_t
      count()
      {
        return binary ? bytes<std::uint64_t>() :
                        static_cast<std::uint64_t>(text_integer());
      }

      /// A count in plain text, whatever the format.
      std::uint64_t
      line_count()
      {
        const std::uint64_t n = text_integer();
        if (binary && at < content.size() && content[at] == '\n')
          ++at;
        return n;
      }

      void
      skip_reals(const unsigned int n)
      {
        for (unsigned int i = 0; i < n; ++i)
          if (binary)
            bytes<double>();
          else
            text_real();
      }

      void
      skip_integers(const std::uint64_t n)
      {
        fits(n, 4, "integers");
        for (std::uint64_t i = 0; i < n; ++i)
          integer();
      }

      /// @p n things of so many bytes each, or (as text) of two at least.
      void
      fits(const std::uint64_t n, const unsigned int size, const char *what)
      {
        if (n > (content.size() - at) / (binary ? size : 2))
          fail("there are said to be " + std::to_string(n) + " " + what +
               ", more than the rest of the file can hold");
      }

      /// To the line after "$End" + section.
      void
      end_section(const bool here)
      {
        const std::size_t end = content.find("$End" + section, at);
        if (end == std::string::npos)
          file_error("ends before $End" + section +
                     "; allowed: a complete file");
        if (here && content.find_first_not_of(" \t\r\n", at) != end)
          fail("there is something else before $End" + section);
        at = end + 4 + section.size();
      }

      /// Name of the next section; false at the end of the file.
      bool
      next_section()
      {
        at = content.find('$', at);
        if (at == std::string::npos)
          return false;
        const std::size_t end = content.find_first_of("\r\n", at);
        if (end == std::string::npos)
          return false;
        section = content.substr(at + 1, end - at - 1);
        section.erase(section.find_last_not_of(" \t") + 1);
        at = content.find('\n', end) + 1;
        return at != 0;
      }

      std::string section = "MeshFormat";
      bool        binary  = false;

    private:
      const std::string &content;
      const FileError   &file_error;
      std::size_t        at = 0;

      template <typename Number>
      Number
      bytes()
      {
        Number number;
        if (content.size() - at < sizeof(Number))
          fail("the file ends");
        std::memcpy(&number, &content[at], sizeof(Number));
        at += sizeof(Number);
        return number;
      }

      long long
      text_integer()
      {
        char           *end;
        const long long number = std::strtoll(&content[at], &end, 10);
        finish_text(end);
        return number;
      }

      void
      text_real()
      {
        char *end;
        std::strtod(&content[at], &end);
        finish_text(end);
      }

      void
      finish_text(const char *end)
      {
        if (end == &content[at])
          fail("there is no number");
        at = end - content.data();
      }
    };

    /// The tags of nodes that a file has.
    class NodeTags
    {
    public:
      void
      add(const std::int64_t tag, Scanner &in)
      {
        if (tag < 1)
          in.fail("a node has the tag " + std::to_string(tag));
        tags.push_back(tag);
      }

      void
      finish(Scanner &in)
      {
        std::sort(tags.begin(), tags.end());
        if (!tags.empty() && static_cast<std::uint64_t>(tags.back()) >
                               100 * tags.size() + 1000000)
          in.fail("the tags of nodes are spread up to " +
                  std::to_string(tags.back()));
      }

      void
      check(const std::int64_t tag, Scanner &in) const
      {
        if (!std::binary_search(tags.begin(), tags.end(), tag))
          in.fail("an element has the node " + std::to_string(tag) +
                  ", which the file does not have");
      }

    private:
      std::vector<std::int64_t> tags;
    };

    unsigned int
    nodes_of(const int type, Scanner &in)
    {
      const auto known = element_nodes.find(type);
      if (known == element_nodes.end())
        in.fail("there are elements of gmsh's type " + std::to_string(type) +
                "; allowed: tetrahedra and hexahedra of first or second order");
      return known->second;
    }

    /// Points, curves, surfaces and volumes of version 4.1.
    void
    walk_entities(Scanner &in)
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
    walk_nodes_4(Scanner &in, NodeTags &nodes)
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
          for (std::uint64_t i = 0; i < m; ++i)
            nodes.add(in.count(), in);
          for (std::uint64_t i = 0; i < m; ++i)
            in.skip_reals(3 + (parametric == 1 ? dimension : 0));
        }
    }

    void
    walk_elements_4(Scanner &in, const NodeTags &nodes)
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
    walk_nodes_2(Scanner &in, NodeTags &nodes)
    {
      const std::uint64_t n = in.line_count();
      in.fits(n, 28, "nodes");
      for (std::uint64_t i = 0; i < n; ++i)
        {
          nodes.add(in.integer(), in);
          in.skip_reals(3);
        }
    }

    void
    walk_elements_2(Scanner &in, const NodeTags &nodes)
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
    read_header(const std::string &content, Scanner &in, const FileError &fail)
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
    Scanner    in(content, fail);
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
