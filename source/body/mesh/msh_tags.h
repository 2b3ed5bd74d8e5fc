// Tags and totals of a .msh file, which have to agree with what it holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "msh_scanner.h"

namespace mortise
{
  /// The nodes of a file by their tags.
  class NodeTags
  {
  public:
    void
    add(const std::uint64_t tag, const MshScanner &in)
    {
      if (tag < 1)
        in.fail("a node has the tag 0; allowed: 1 and more");
      positions.emplace_back(tag, positions.size());
    }

    void
    finish(const MshScanner &in)
    {
      std::sort(positions.begin(), positions.end());
      for (std::size_t i = 1; i < positions.size(); ++i)
        if (positions[i].first == positions[i - 1].first)
          in.fail("there are two nodes with the tag " +
                  std::to_string(positions[i].first) + "; allowed: one");
    }

    /// Index of the node @p tag in the file's order.
    unsigned int
    index(const std::uint64_t tag, const MshScanner &in) const
    {
      const auto found =
        std::lower_bound(positions.begin(),
                         positions.end(),
                         std::make_pair(tag, std::uint64_t(0)));
      if (found == positions.end() || found->first != tag)
        in.fail("an element has the node " + std::to_string(tag) +
                ", which the file does not have");
      return found->second;
    }

  private:
    std::vector<std::pair<std::uint64_t, std::uint64_t>> positions;
  };

  /// Totals of all blocks in the header of a section of version 4.1.
  class Total
  {
  public:
    Total(const char *things, const unsigned int size, MshScanner &in)
      : things(things)
      , blocks(in.count())
      , n(in.count())
      , least(in.count())
      , largest(in.count())
    {
      in.fits(blocks, 20, "blocks");
      in.fits(n, size, things);
    }

    std::uint64_t
    n_blocks() const
    {
      return blocks;
    }

    void
    check(const std::uint64_t tag, const MshScanner &in)
    {
      ++found;
      if (tag < least || tag > largest)
        in.fail("the tag " + std::to_string(tag) +
                " is none of those that the header of the section tells; "
                "allowed: " +
                std::to_string(least) + " to " + std::to_string(largest));
    }

    void
    finish(const MshScanner &in) const
    {
      if (found != n)
        in.fail("the blocks have " + std::to_string(found) + " " + things +
                ", the header of the section says " + std::to_string(n));
    }

  private:
    const char         *things;
    const std::uint64_t blocks, n, least, largest;
    std::uint64_t       found = 0;
  };
} // namespace mortise
