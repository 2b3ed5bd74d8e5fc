#include "vtu_arrays.h"

#include <boost/property_tree/xml_parser.hpp>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <type_traits>

namespace mortise
{
  namespace
  {
    /// The end of a tag, which is not within quotes.
    std::size_t
    end_of_tag(const std::string &xml, const std::size_t begin)
    {
      std::size_t at = xml.find_first_of("\"'>", begin);
      while (at != std::string::npos && xml[at] != '>')
        {
          at = xml.find(xml[at], at + 1);
          if (at != std::string::npos)
            at = xml.find_first_of("\"'>", at + 1);
        }
      return at;
    }

    /// Elements within each other; the parser calls itself for each of them.
    std::size_t
    depth_of(const std::string &xml)
    {
      std::size_t depth = 0, most = 0;
      for (std::size_t at = xml.find('<'); at < xml.size() - 1;
           at             = xml.find('<', at + 1))
        if (xml[at + 1] == '/')
          depth -= depth > 0;
        else if (xml[at + 1] != '?' && xml[at + 1] != '!')
          {
            const std::size_t end = end_of_tag(xml, at);
            if (end == std::string::npos)
              return std::max(most, depth + 1);
            if (xml[end - 1] != '/')
              most = std::max(most, ++depth);
            at = end;
          }
      return most;
    }

    /// Bytes of a text in base 64, in which several pieces may follow each
    /// other, each filled up by "="; false: there is something else.
    bool
    decode(const char                 *begin,
           const char                 *end,
           std::vector<unsigned char> &bytes)
    {
      static const auto values = [] {
        constexpr char digits[] =
          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::array<signed char, 256> result;
        result.fill(-1);
        for (int i = 0; i < 64; ++i)
          result[static_cast<unsigned char>(digits[i])] = i;
        return result;
      }();
      std::uint32_t bits = 0;
      unsigned int  n = 0, n_filled = 0;
      for (; begin != end; ++begin)
        {
          const auto c = static_cast<unsigned char>(*begin);
          if (std::isspace(c) != 0)
            continue;
          if ((c != '=' && (values[c] < 0 || n_filled > 0)) ||
              (c == '=' && n < 2))
            return false;
          bits = bits << 6 | (c == '=' ? 0 : values[c]);
          n_filled += c == '=';
          if (++n == 4)
            {
              for (unsigned int i = 0; i + n_filled < 3; ++i)
                bytes.push_back(bits >> (16 - 8 * i) & 255);
              bits = n = n_filled = 0;
            }
        }
      return n == 0;
    }

    template <typename Stored, typename Number>
    std::vector<Number>
    converted(const std::vector<unsigned char> &bytes)
    {
      std::vector<Number> result(bytes.size() / sizeof(Stored));
      for (std::size_t i = 0; i < result.size(); ++i)
        {
          Stored number;
          std::memcpy(&number, &bytes[i * sizeof(Stored)], sizeof(Stored));
          result[i] = static_cast<Number>(number);
        }
      return result;
    }
  } // namespace

  VtuArrays::VtuArrays(const std::string &content, const FileError &fail)
    : fail(fail)
  {
    // what is appended may be bytes that no XML may have
    const std::size_t cut = content.find("<AppendedData");
    std::string       xml = content.substr(0, cut);
    if (cut != std::string::npos)
      {
        const std::size_t begin = content.find('_', content.find('>', cut));
        const std::size_t end   = content.rfind("</AppendedData>");
        if (begin == std::string::npos || end == std::string::npos ||
            end < begin)
          fail("has <AppendedData> without its end");
        appended_raw =
          content.substr(cut, begin - cut).find("raw") != std::string::npos;
        appended = content.substr(begin + 1, end - begin - 1);
        xml += "</VTKFile>";
      }
    if (depth_of(xml) > 100)
      fail("has more than 100 elements within each other");
    try
      {
        std::istringstream in(xml);
        Tree               whole;
        boost::property_tree::read_xml(in, whole);
        if (whole.count("VTKFile") != 1)
          fail("holds no <VTKFile>; allowed: an XML file of VTK");
        file = whole.get_child("VTKFile");
      }
    catch (const boost::property_tree::xml_parser_error &error)
      {
        fail("is no XML file: " + error.message() + " in line " +
             std::to_string(error.line()));
      }
    if (attribute(file, "type") != "UnstructuredGrid")
      fail("is a VTK file of type " + in_quotes(attribute(file, "type"), '\'') +
           "; allowed: UnstructuredGrid");
    if (attribute(file, "byte_order") == "BigEndian")
      fail("has the byte order BigEndian; allowed: LittleEndian");
    if (attribute(file, "header_type") == "UInt64")
      header_size = 8;
    const std::string compressor = attribute(file, "compressor");
    compressed                   = !compressor.empty();
    if (compressed && compressor != "vtkZLibDataCompressor")
      fail("is compressed by " + in_quotes(compressor, '\'') +
           "; allowed: vtkZLibDataCompressor, or nothing");
    // where an array ends is where the next one begins
    for (std::size_t at = xml.find("offset=\""); at != std::string::npos;
         at             = xml.find("offset=\"", at + 1))
      offsets.push_back(std::strtoull(&xml[at + 8], nullptr, 10));
    std::sort(offsets.begin(), offsets.end());
  }

  std::string
  VtuArrays::attribute(const Tree &element, const std::string &name)
  {
    return element.get<std::string>("<xmlattr>." + name, "");
  }

  const VtuArrays::Tree &
  VtuArrays::child(const Tree &element, const std::string &name) const
  {
    const auto found = element.find(name);
    if (found == element.not_found())
      fail("has no <" + name + "> where it must be");
    return found->second;
  }

  const VtuArrays::Tree &
  VtuArrays::array(const Tree &element, const std::string &name) const
  {
    for (const auto &[kind, array] : element)
      if (kind == "DataArray" && attribute(array, "Name") == name)
        return array;
    fail("has no array " + in_quotes(name, '\'') + " of its cells");
    return element;
  }

  void
  VtuArrays::refuse(const std::string &name, const std::string &what) const
  {
    fail("has the array " + in_quotes(name, '\'') + ", " + what);
    throw InputError(what); // never reached
  }

  std::vector<double>
  VtuArrays::reals(const Tree &array, const std::size_t n) const
  {
    return numbers<double>(array, n);
  }

  std::vector<std::int64_t>
  VtuArrays::integers(const Tree &array, const std::size_t n) const
  {
    return numbers<std::int64_t>(array, n);
  }

  template <typename Number>
  std::vector<Number>
  VtuArrays::numbers(const Tree &array, const std::size_t n) const
  {
    const std::string   name = attribute(array, "Name");
    const std::string   type = attribute(array, "type");
    std::vector<Number> result;
    if (std::is_integral_v<Number> && type.rfind("Float", 0) == 0)
      refuse(name, "whose type is " + type + "; allowed: integers");
    if (attribute(array, "format") == "ascii")
      result = from_text<Number>(array);
    else if (type == "Float64")
      result = converted<double, Number>(bytes(array));
    else if (type == "Float32")
      result = converted<float, Number>(bytes(array));
    else if (type == "Int64" || type == "UInt64")
      result = converted<std::int64_t, Number>(bytes(array));
    else if (type == "Int32")
      result = converted<std::int32_t, Number>(bytes(array));
    else if (type == "UInt32")
      result = converted<std::uint32_t, Number>(bytes(array));
    else if (type == "Int16")
      result = converted<std::int16_t, Number>(bytes(array));
    else if (type == "UInt16")
      result = converted<std::uint16_t, Number>(bytes(array));
    else if (type == "Int8")
      result = converted<std::int8_t, Number>(bytes(array));
    else if (type == "UInt8")
      result = converted<std::uint8_t, Number>(bytes(array));
    else
      refuse(name,
             "whose type is " + in_quotes(type, '\'') +
               "; allowed: Float32, Float64, Int8 to Int64, UInt8 to "
               "UInt64");
    if (n != std::numeric_limits<std::size_t>::max() && result.size() != n)
      refuse(name,
             "which has " + std::to_string(result.size()) +
               " numbers; allowed: " + std::to_string(n) + " here");
    return result;
  }

  template <typename Number>
  std::vector<Number>
  VtuArrays::from_text(const Tree &array) const
  {
    const std::string  &text = array.data();
    std::vector<Number> result;
    const char *at = text.data(), *const end = at + text.size();
    const auto is_blank = [](const char c) {
      return std::isspace(static_cast<unsigned char>(c)) != 0;
    };
    while ((at = std::find_if_not(at, end, is_blank)) != end)
      {
        Number            number = 0;
        const char *const stop   = std::find_if(at, end, is_blank);
        const auto [rest, error] = std::from_chars(at, stop, number);
        if (error != std::errc() || rest != stop)
          refuse(attribute(array, "Name"),
                 "with " + in_quotes(std::string(at, stop), '\'') +
                   ", which is no " +
                   (std::is_integral_v<Number> ? "integer" : "number"));
        result.push_back(number);
        at = stop;
      }
    return result;
  }

  std::vector<unsigned char>
  VtuArrays::bytes(const Tree &array) const
  {
    const std::string          name   = attribute(array, "Name");
    const std::string          format = attribute(array, "format");
    std::vector<unsigned char> packed;
    const char *begin = array.data().data(), *end = begin + array.data().size();
    if (format == "appended")
      {
        const std::size_t offset =
          std::strtoull(attribute(array, "offset").c_str(), nullptr, 10);
        if (offset >= appended.size())
          refuse(name, "whose offset is beyond the appended data");
        const auto next =
          std::upper_bound(offsets.begin(), offsets.end(), offset);
        begin = appended.data() + offset;
        end   = appended.data() + (next == offsets.end() ?
                                     appended.size() :
                                     std::min(*next, appended.size()));
        if (appended_raw)
          packed.assign(begin, end);
      }
    else if (format != "binary")
      refuse(name,
             "whose format is " + in_quotes(format, '\'') +
               "; allowed: ascii, binary, appended");
    if (packed.empty() && !decode(begin, end, packed))
      refuse(name, "which is not in base 64");
    return unpacked(packed, name);
  }

  std::uint64_t
  VtuArrays::header_number(const std::vector<unsigned char> &packed,
                           const std::size_t                 i,
                           const std::string                &name) const
  {
    if ((i + 1) * header_size > packed.size())
      refuse(name, "which ends early");
    std::uint64_t number = 0; // LittleEndian
    std::memcpy(&number, &packed[i * header_size], header_size);
    return number;
  }

  std::vector<unsigned char>
  VtuArrays::unpacked(const std::vector<unsigned char> &packed,
                      const std::string                &name) const
  {
    if (!compressed)
      {
        const std::uint64_t n = header_number(packed, 0, name);
        if (n > packed.size() - header_size)
          refuse(name, "which ends early");
        return {packed.begin() + header_size, packed.begin() + header_size + n};
      }
    // number of blocks, their size, that of the last if it is smaller, and what
    // each has packed
    constexpr std::uint64_t    best     = 1100; // of zlib
    const std::uint64_t        n_blocks = header_number(packed, 0, name);
    std::vector<unsigned char> result;
    if (n_blocks == 0)
      return result;
    if (n_blocks > packed.size())
      refuse(name, "which ends early");
    const std::uint64_t size = header_number(packed, 1, name),
                        last = header_number(packed, 2, name);
    std::size_t at           = (3 + n_blocks) * header_size;
    for (std::uint64_t block = 0; block < n_blocks; ++block)
      {
        const std::uint64_t n = header_number(packed, 3 + block, name);
        const std::uint64_t m =
          block + 1 == n_blocks && last != 0 ? last : size;
        if (at > packed.size() || n > packed.size() - at || m / best > n)
          refuse(name, "which ends early");
        const std::size_t begin = result.size();
        result.resize(begin + m);
        uLongf length = m;
        if (uncompress(result.data() + begin, &length, &packed[at], n) !=
              Z_OK ||
            length != m)
          refuse(name, "which zlib cannot unpack");
        at += n;
      }
    return result;
  }
} // namespace mortise
