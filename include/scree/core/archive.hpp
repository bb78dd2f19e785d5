#pragma once
/// \file
/// Values one behind the other as bytes, and back to the same bits.
///
/// A class says which of its parts are kept:
///
///     template <class Self, class Archive>
///     static void fields(Self& self, Archive& archive) {
///       archive(self.position_, self.velocity_);
///     }
///
/// Self is const where it is written. What has no `fields` must be a plain record of numbers, a string, an
/// Eigen object of fixed size, or a vector, array, pair, optional, map or variant of such.

#include "scree/core/error.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace scree {

namespace detail {

struct AnyArchive {
  static constexpr bool reading = false;
  template <class... T>
  void operator()(T&...) const {}
};

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_map = false;
template <class K, class V>
inline constexpr bool is_map<std::map<K, V>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_pair = false;
template <class A, class B>
inline constexpr bool is_pair<std::pair<A, B>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t n>
inline constexpr bool is_array<std::array<T, n>> = true;

/// Eigen objects of fixed size: their numbers lie one behind the other.
template <class T>
concept FixedDense = requires(T& v) {
  { T::SizeAtCompileTime } -> std::convertible_to<int>;
  v.data();
}
&&(T::SizeAtCompileTime > 0);
template <class T>
concept IsQuaternion = requires(T& q) {
  q.coeffs().data();
  q.conjugate();
};

/// A record that is its bytes. What points elsewhere is none, but that cannot be seen of a record's parts.
template <class T>
inline constexpr bool is_plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

} // namespace detail

/// A type that says which of its parts are kept.
template <class T>
concept HasFields = requires(T& value, detail::AnyArchive& archive) {
  T::fields(value, archive);
};

/// Whether a value of this type can be kept.
template <class T>
inline constexpr bool is_archivable =
    HasFields<T> || std::is_same_v<T, std::string> || detail::is_vector<T> || detail::is_map<T> ||
    detail::is_optional<T> || detail::is_pair<T> || detail::is_array<T> || detail::FixedDense<T> ||
    detail::IsQuaternion<T> || detail::is_plain<T>;
template <class... T>
inline constexpr bool is_archivable<std::variant<T...>> = true;

/// Writes values as the machine holds them.
class ArchiveWriter {
public:
  static constexpr bool reading = false;

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  /// A name that the reader looks for at the same place.
  void section(std::string_view name) { put(std::string{name}); }

  /// What the reader must have too. \param value a number or a string
  template <class T>
  void same(std::string_view /*what*/, const T& value) {
    put(value);
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
  void raw(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
  void size(std::size_t n) { put(static_cast<std::uint64_t>(n)); }

  template <class T>
  void put(const T& value) {
    static_assert(is_archivable<T>,
                  "scree: a type that is to be kept is missing fields(self, archive) (core/archive.hpp)");
    if constexpr (HasFields<const T>) {
      T::fields(value, *this);
    } else if constexpr (std::is_same_v<T, std::string>) {
      size(value.size());
      raw(value.data(), value.size());
    } else if constexpr (detail::is_vector<T>) {
      size(value.size());
      items(std::span{value});
    } else if constexpr (detail::is_map<T>) {
      size(value.size());
      for (const auto& [key, item] : value) {
        put(key);
        put(item);
      }
    } else if constexpr (detail::is_optional<T>) {
      put(value.has_value());
      if (value) {
        put(*value);
      }
    } else if constexpr (detail::is_pair<T>) {
      put(value.first);
      put(value.second);
    } else if constexpr (detail::FixedDense<T>) {
      raw(value.data(), sizeof(typename T::Scalar) * static_cast<std::size_t>(T::SizeAtCompileTime));
    } else if constexpr (detail::IsQuaternion<T>) {
      put(value.coeffs());
    } else if constexpr (detail::is_array<T>) {
      items(std::span{value});
    } else {
      raw(&value, sizeof value);
    }
  }
  template <class... T>
  void put(const std::variant<T...>& value) {
    size(value.index());
    std::visit([this](const auto& held) { this->put(held); }, value);
  }

  template <class T, std::size_t n>
  void items(std::span<const T, n> values) {
    if constexpr (!HasFields<const T> && detail::is_plain<T>) {
      raw(values.data(), values.size_bytes());
    } else {
      for (const T& value : values) {
        put(value);
      }
    }
  }

  std::string bytes_;
};

/// Reads what an `ArchiveWriter` of the same program wrote, in the same order.
class ArchiveReader {
public:
  static constexpr bool reading = true;

  /// \param bytes must outlive the reader
  /// \param source where they are from, for messages
  ArchiveReader(std::string_view bytes, std::string source) : bytes_{bytes}, source_{std::move(source)} {}

  /// \throws Error where the bytes end too soon, or hold something else.
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  /// \throws Error where something else was written here.
  void section(std::string_view name) {
    std::string found;
    get(found);
    if (found != name) {
      fail(message("the part '", name, "' is not where it should be"));
    }
  }
  /// \param what for the message
  /// \throws Error where the writer had another value.
  template <class T>
  void same(std::string_view what, const T& value) {
    T found{};
    get(found);
    if (!(found == value)) {
      fail(message(what, " is ", printable(message(found)), " there and ", value, " here"));
    }
  }
  /// \throws Error unless all was read.
  void end() const {
    if (!bytes_.empty()) {
      fail(message(bytes_.size(), " bytes are left over"));
    }
  }
  [[noreturn]] void fail(std::string_view what) const { throw Error(message(source_, ": ", what)); }

private:
  void raw(void* to, std::size_t size) {
    need(size);
    if (size > 0) {
      std::memcpy(to, bytes_.data(), size);
    }
    bytes_.remove_prefix(size);
  }
  void need(std::size_t size) const {
    if (size > bytes_.size()) {
      fail(message("cut off: ", size, " bytes expected where ", bytes_.size(), " are left"));
    }
  }
  /// Of items of `each` bytes at least, which must be there before memory is asked for.
  std::size_t count(std::size_t each) {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    if (n > bytes_.size() / each) {
      fail(message("cut off: ", n, " items expected where ", bytes_.size(), " bytes are left"));
    }
    return static_cast<std::size_t>(n);
  }

  template <class T>
  void get(T& value) {
    static_assert(is_archivable<T>,
                  "scree: a type that is to be kept is missing fields(self, archive) (core/archive.hpp)");
    if constexpr (HasFields<T>) {
      T::fields(value, *this);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value.resize(count(1));
      raw(value.data(), value.size());
    } else if constexpr (detail::is_vector<T>) {
      using Item = typename T::value_type;
      value.clear();
      value.resize(count(!HasFields<Item> && detail::is_plain<Item> ? sizeof(Item) : 1));
      items(std::span{value});
    } else if constexpr (detail::is_map<T>) {
      value.clear();
      for (std::size_t n = count(1); n > 0; --n) {
        std::pair<typename T::key_type, typename T::mapped_type> item;
        get(item);
        value.insert(std::move(item));
      }
    } else if constexpr (detail::is_optional<T>) {
      bool there = false;
      get(there);
      value.reset();
      if (there) {
        get(value.emplace());
      }
    } else if constexpr (detail::is_pair<T>) {
      get(value.first);
      get(value.second);
    } else if constexpr (detail::FixedDense<T>) {
      raw(value.data(), sizeof(typename T::Scalar) * static_cast<std::size_t>(T::SizeAtCompileTime));
    } else if constexpr (detail::IsQuaternion<T>) {
      get(value.coeffs());
    } else if constexpr (detail::is_array<T>) {
      items(std::span{value});
    } else if constexpr (std::is_same_v<T, bool>) {
      unsigned char byte = 0;
      raw(&byte, sizeof byte);
      if (byte > 1) {
        fail("holds neither yes nor no where one of them should be");
      }
      value = byte == 1;
    } else {
      raw(&value, sizeof value);
    }
  }
  /// The kind that is held must be the one that was written, as what it was made with is not kept.
  template <class... T>
  void get(std::variant<T...>& value) {
    std::uint64_t index = 0;
    raw(&index, sizeof index);
    if (index != value.index()) {
      fail(message("holds a thing of kind ", index, " where one of kind ", value.index(), " is"));
    }
    std::visit([this](auto& held) { this->get(held); }, value);
  }

  template <class T, std::size_t n>
  void items(std::span<T, n> values) {
    if constexpr (!HasFields<T> && detail::is_plain<T>) {
      raw(values.data(), values.size_bytes());
    } else {
      for (T& value : values) {
        get(value);
      }
    }
  }

  std::string_view bytes_;
  std::string source_;
};

} // namespace scree
