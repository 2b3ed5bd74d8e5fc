// Reader of VTU files for tests, in the format that the program writes, binary
// and compressed. It needs nothing of deal.II, whose
// libraries take long to load.
#pragma once

#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mortise::testing
{
  /// The pieces of a file one after the other. @p Point: made of three numbers.
  template <typename Point>
  struct VtuPieces
  {
    explicit VtuPieces(const std::string &file)
    {
      std::ostringstream all;
      all << std::ifstream(file).rdbuf();
      const std::string text = all.str();
      for (std::size_t at = text.find("<Piece "); at != std::string::npos;
           at             = text.find("<Piece ", at + 1))
        add_piece(text.substr(at, text.find("</Piece>", at) - at));
    }

    std::vector<Point>                     points;
    std::vector<std::vector<unsigned int>> cells; ///< numbers of points
    std::vector<unsigned int>              types;
    std::vector<std::string>               names; ///< of point data
    std::vector<std::string>               cell_names;
    std::map<std::string, std::vector<std::vector<double>>>
                 data; ///< by name and point (or cell): components
    unsigned int n_pieces = 0;

  private:
    static std::string
    attribute(const std::string &tag, const std::string &name)
    {
      const std::size_t at = tag.find(" " + name + "=\"");
      if (at == std::string::npos)
        return "";
      const std::size_t begin = at + name.size() + 3;
      return tag.substr(begin, tag.find('"', begin) - begin);
    }

    static void
    require(const bool condition, const std::string &otherwise)
    {
      if (!condition)
        throw std::runtime_error(otherwise);
    }

    static std::vector<unsigned char>
    from_base64(const std::string &text)
    {
      namespace Iterators = boost::archive::iterators;
      using Bytes         = Iterators::transform_width<
        Iterators::binary_from_base64<std::string::const_iterator>,
        8,
        6>;
      std::vector<unsigned char> bytes(Bytes(text.begin()), Bytes(text.end()));
      bytes.resize(bytes.size() - std::count(text.begin(), text.end(), '='));
      return bytes;
    }

    /// Number of blocks, sizes of whole ones and of the last if it is another,
    /// compressed sizes, all in base 64; the blocks in base 64.
    static std::string
    uncompressed(const std::string &text)
    {
      const auto number = [](const std::vector<unsigned char> &bytes,
                             const unsigned int                i) {
        std::uint32_t value;
        std::memcpy(&value, &bytes.at(4 * i), 4);
        return value;
      };
      const std::size_t   begin = text.find_first_not_of(" \n");
      const std::size_t   end   = text.find_last_not_of(" \n") + 1;
      const std::uint32_t n_blocks =
        number(from_base64(text.substr(begin, 8)), 0);
      const std::size_t header_size = (4 * (3 + n_blocks) + 2) / 3 * 4;
      const auto        header = from_base64(text.substr(begin, header_size));
      if (n_blocks == 0)
        return "";
      const auto blocks = from_base64(
        text.substr(begin + header_size, end - begin - header_size));
      std::string result;
      std::size_t at = 0;
      for (std::uint32_t b = 0; b < n_blocks; ++b)
        {
          const bool  last = b + 1 == n_blocks && number(header, 2) > 0;
          std::string block(number(header, last ? 2 : 1), '\0');
          uLongf      size = block.size();
          require(at + number(header, 3 + b) <= blocks.size() &&
                    uncompress(reinterpret_cast<Bytef *>(&block[0]),
                               &size,
                               &blocks[at],
                               number(header, 3 + b)) == Z_OK &&
                    size == block.size(),
                  "the data are broken");
          at += number(header, 3 + b);
          result += block;
        }
      require(at == blocks.size(), "the compressed size is another");
      return result;
    }

    template <typename Number>
    static std::vector<double>
    numbers(const std::string &bytes)
    {
      std::vector<double> result;
      for (std::size_t i = 0; i < bytes.size(); i += sizeof(Number))
        {
          Number value;
          std::memcpy(&value, &bytes[i], sizeof(Number));
          result.push_back(value);
        }
      return result;
    }

    void
    add_array(const std::string &tag,
              const std::string &content,
              const bool         of_cells)
    {
      const std::string bytes = uncompressed(content);
      const std::string type  = attribute(tag, "type"),
                        name  = attribute(tag, "Name");
      const std::vector<double> values =
        type == "Float32" ? numbers<float>(bytes) :
        type == "Float64" ? numbers<double>(bytes) :
        type == "Int32"   ? numbers<std::int32_t>(bytes) :
                            numbers<std::uint8_t>(bytes);
      if (name == "connectivity")
        connectivity = values;
      else if (name == "offsets")
        for (unsigned int c = 0; c < values.size(); ++c)
          {
            cells.emplace_back();
            for (unsigned int i = c == 0 ? 0 : values[c - 1]; i < values[c];
                 ++i)
              cells.back().push_back(first_point + connectivity.at(i));
          }
      else if (name == "types")
        types.insert(types.end(), values.begin(), values.end());
      else if (name == "Points")
        for (unsigned int i = 0; i < values.size(); i += 3)
          points.push_back(Point{values[i], values[i + 1], values[i + 2]});
      else
        {
          const std::string  given = attribute(tag, "NumberOfComponents");
          const unsigned int n     = given.empty() ? 1 : std::stoi(given);
          if (n_pieces == 1)
            (of_cells ? cell_names : names).push_back(name);
          for (unsigned int i = 0; i < values.size(); i += n)
            data[name].emplace_back(&values[i], &values[i] + n);
        }
    }

    void
    add_piece(const std::string &text)
    {
      ++n_pieces;
      first_point = points.size();
      for (std::size_t at = text.find("<DataArray "); at != std::string::npos;
           at             = text.find("<DataArray ", at + 1))
        {
          const std::size_t begin = text.find('>', at) + 1;
          add_array(text.substr(at, begin - at),
                    text.substr(begin, text.find('<', begin) - begin),
                    at > text.find("<CellData"));
        }
      require(points.size() - first_point ==
                std::stoul(attribute(text, "NumberOfPoints")),
              "the number of points is another");
    }

    unsigned int        first_point = 0;
    std::vector<double> connectivity;
  };
} // namespace mortise::testing
