// The arrays of numbers in an XML file of VTK.
#pragma once

#include <boost/property_tree/ptree.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "mesh_file_parts.h"

namespace mortise
{
  /// Knows how the file packs numbers: as text, or as bytes in base 64 in place
  /// or appended (in base 64 or raw), as they are or compressed by zlib.
  class VtuArrays
  {
  public:
    using Tree = boost::property_tree::ptree;

    /// @p content must live on. @p fail is told what is wrong.
    VtuArrays(const std::string &content, const FileError &fail);

    /// The element VTKFile.
    const Tree &
    root() const
    {
      return file;
    }

    /// The attribute @p name of @p element, empty if there is none.
    static std::string
    attribute(const Tree &element, const std::string &name);

    /// The child of @p element of this name; there must be one.
    const Tree &
    child(const Tree &element, const std::string &name) const;

    /// The DataArray in @p element with the attribute Name = @p name.
    const Tree &
    array(const Tree &element, const std::string &name) const;

    /// All numbers of a DataArray, @p n of them.
    std::vector<double>
    reals(const Tree &array, std::size_t n) const;
    std::vector<std::int64_t>
    integers(const Tree &array,
             std::size_t n = std::numeric_limits<std::size_t>::max()) const;

  private:
    template <typename Number>
    std::vector<Number>
    numbers(const Tree &array, std::size_t n) const;

    template <typename Number>
    std::vector<Number>
    from_text(const Tree &array) const;

    /// What the array was before it was packed.
    std::vector<unsigned char>
    bytes(const Tree &array) const;

    /// Without the header, and not compressed.
    std::vector<unsigned char>
    unpacked(const std::vector<unsigned char> &packed,
             const std::string                &name) const;

    std::uint64_t
    header_number(const std::vector<unsigned char> &packed,
                  std::size_t                       i,
                  const std::string                &name) const;

    [[noreturn]] void
    refuse(const std::string &name, const std::string &what) const;

    const FileError         &fail;
    Tree                     file;
    std::string              appended; ///< behind the underscore
    bool                     appended_raw = false, compressed = false;
    std::size_t              header_size = 4;
    std::vector<std::size_t> offsets; ///< of appended arrays, ascending
  };
} // namespace mortise
