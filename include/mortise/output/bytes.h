// Plain values as bytes, bit for bit, in the order of this machine.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

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
    explicit ByteReader(const std::string &bytes)
      : next(bytes.data())
      , end(next + bytes.size())
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

  /// An archive as those of Boost that appends what serialize() names: numbers,
  /// texts, arrays, pairs, vectors, maps, and classes that have serialize().
  class ByteWriter
  {
  public:
    template <typename T>
    ByteWriter &
    operator&(T &value)
    {
      put(value);
      return *this;
    }

    std::string bytes;

  private:
    template <typename T>
    void
    put(T &value)
    {
      if constexpr (std::is_arithmetic_v<T>)
        append_bytes(bytes, value);
      else
        value.serialize(*this, 0);
    }

    void
    put(std::string &text)
    {
      append_text(bytes, text);
    }

    template <typename T, std::size_t n>
    void
    put(std::array<T, n> &values)
    {
      for (T &value : values)
        put(value);
    }

    template <typename A, typename B>
    void
    put(std::pair<A, B> &values)
    {
      put(values.first);
      put(values.second);
    }

    template <typename T>
    void
    put(std::vector<T> &values)
    {
      append_bytes<std::uint64_t>(bytes, values.size());
      for (T &value : values)
        put(value);
    }

    template <typename Key, typename T>
    void
    put(std::map<Key, T> &values)
    {
      std::vector<std::pair<Key, T>> pairs(values.begin(), values.end());
      put(pairs);
    }
  };

  /// The archive that reads them again; throws std::out_of_range where there
  /// are fewer bytes than they need, before it takes memory for them.
  class ByteArchive
  {
  public:
    explicit ByteArchive(const std::string &bytes)
      : reader(bytes)
    {}

    template <typename T>
    ByteArchive &
    operator&(T &value)
    {
      get(value);
      return *this;
    }

    std::size_t
    left() const
    {
      return reader.left();
    }

  private:
    template <typename T>
    void
    get(T &value)
    {
      if constexpr (std::is_same_v<T, bool>)
        value = reader.get<char>() != 0; // other bytes are no bool
      else if constexpr (std::is_arithmetic_v<T>)
        value = reader.get<T>();
      else
        value.serialize(*this, 0);
    }

    void
    get(std::string &text)
    {
      text = reader.get_text();
    }

    template <typename T, std::size_t n>
    void
    get(std::array<T, n> &values)
    {
      for (T &value : values)
        get(value);
    }

    template <typename A, typename B>
    void
    get(std::pair<A, B> &values)
    {
      get(values.first);
      get(values.second);
    }

    template <typename T>
    void
    get(std::vector<T> &values)
    {
      values.clear();
      for (auto n = reader.get<std::uint64_t>(); n > 0; --n)
        get(values.emplace_back());
    }

    template <typename Key, typename T>
    void
    get(std::map<Key, T> &values)
    {
      std::vector<std::pair<Key, T>> pairs;
      get(pairs);
      values = {pairs.begin(), pairs.end()};
    }

    ByteReader reader;
  };

  template <typename T>
  std::string
  to_bytes(T value)
  {
    ByteWriter writer;
    writer    &value;
    return std::move(writer.bytes);
  }

  /// What to_bytes() gave. Throws std::out_of_range if @p bytes are too few or too many.
  template <typename T>
  T
  from_bytes(const std::string &bytes)
  {
    T           value;
    ByteArchive archive(bytes);
    archive    &value;
    if (archive.left() > 0)
      throw std::out_of_range("there are " + std::to_string(archive.left()) +
                              " bytes too many");
    return value;
  }
} // namespace mortise
