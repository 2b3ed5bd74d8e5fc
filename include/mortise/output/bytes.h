// Plain values as bytes, bit for bit, in the order of this machine.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace mortise
{
  template <typename T>
  void
  append_bytes(std::string &bytes, const T &value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char *>(&value), sizeof(T));
  }

  /// Its length, then the text.
  inline void
  append_text(std::string &bytes, const std::string &text)
  {
    append_bytes<std::uint64_t>(bytes, text.size());
    bytes += text;
  }

  /// Reads from the front what the functions above have appended; throws
  /// std::out_of_range where it is less than asked for.
  class ByteReader
  {
  public:
    /// @p bytes are not copied.
    ByteReader(const char *const bytes, const std::size_t size)
      : next(bytes)
      , end(bytes + size)
    {}

    explicit ByteReader(const std::string &bytes)
      : ByteReader(bytes.data(), bytes.size())
    {}

    std::size_t
    left() const
    {
      return end - next;
    }

    template <typename T>
    T
    get()
    {
      static_assert(std::is_trivially_copyable_v<T>);
      T value;
      std::memcpy(&value, take(sizeof(T)), sizeof(T));
      return value;
    }

    std::string
    get_text()
    {
      const auto size = get<std::uint64_t>();
      return std::string(take(size), size);
    }

    /// The next @p size bytes.
    const char *
    take(const std::size_t size)
    {
      if (size > left())
        throw std::out_of_range("there are " + std::to_string(left()) +
                                " bytes where " + std::to_string(size) +
                                " are expected");
      const char *const start = next;
      next += size;
      return start;
    }

  private:
    const char *next, *const end;
  };
} // namespace mortise
