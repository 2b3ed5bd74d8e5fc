// Plain values as bytes, bit for bit, in the order of this machine: numbers,
// texts, arrays, pairs, optional values, vectors, maps, and classes that have
// serialize(), as archives of Boost take it.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace mortise
{
  /// Appends what serialize() names.
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
        bytes.append(reinterpret_cast<const char *>(&value), sizeof(T));
      else
        value.serialize(*this, 0);
    }

    void
    put_size(std::uint64_t size)
    {
      put(size);
    }

    void
    put(std::string &text)
    {
      put_size(text.size());
      bytes += text;
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
    put(std::optional<T> &value)
    {
      put_size(value ? 1 : 0);
      if (value)
        put(*value);
    }

    template <typename T>
    void
    put(std::vector<T> &values)
    {
      put_size(values.size());
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

  /// Reads them again; throws std::out_of_range where there
  /// are fewer bytes than they need, before it takes memory for them.
  class ByteArchive
  {
  public:
    /// @p bytes are not copied.
    explicit ByteArchive(const std::string &bytes)
      : next(bytes.data())
      , end(next + bytes.size())
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
      return end - next;
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
    template <typename T>
    void
    get(T &value)
    {
      if constexpr (std::is_same_v<T, bool>)
        value = *take(1) != 0; // other bytes are no bool
      else if constexpr (std::is_arithmetic_v<T>)
        std::memcpy(&value, take(sizeof(T)), sizeof(T));
      else
        value.serialize(*this, 0);
    }

    std::uint64_t
    get_size()
    {
      std::uint64_t size;
      get(size);
      return size;
    }

    void
    get(std::string &text)
    {
      const auto size = get_size();
      text.assign(take(size), size);
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
    get(std::optional<T> &value)
    {
      value.reset();
      if (get_size() > 0)
        get(value.emplace());
    }

    template <typename T>
    void
    get(std::vector<T> &values)
    {
      values.clear();
      for (auto n = get_size(); n > 0; --n)
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

    const char *next, *const end;
  };

  template <typename T>
  std::string
  to_bytes(T value)
  {
    ByteWriter writer;
    writer    &value;
    return std::move(writer.bytes);
  }

  /// The inverse of to_bytes(). Throws std::out_of_range if @p bytes are too
  /// few or too many.
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
