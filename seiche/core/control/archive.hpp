// The bytes of a checkpoint. Whatever evolves lists its members once, and the same list writes and reads them.
#pragma once

#include <seiche/core/base/error.hpp>
#include <seiche/core/base/vector.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace seiche {

class Archive;

template <class T>
concept Archived = requires(T& object, Archive& archive) {
  object.archive(archive);
};

// Numbers lie as they do in memory: bits come back as they were, on a machine of the same kind.
class Archive {
 public:
  // To be written: `sink` gets the bytes one piece after the other, and a vector whole, so that none is copied.
  explicit Archive(std::function<void(std::string_view)> sink) : sink_(std::move(sink)) {}
  explicit Archive(std::string bytes) : bytes_(std::move(bytes)) {}  // to be read

  bool reads() const { return !sink_; }
  bool is_at_end() const { return at_ == bytes_.size(); }

  // archive(a, b, c), each in turn. Reading throws Error where the bytes end, or were not written by this list.
  template <class... Values>
    requires(sizeof...(Values) > 1)
  void operator()(Values&... values) { ((*this)(values), ...); }
  template <Archived T>
  void operator()(T& object) {
    object.archive(*this);
  }
  template <class T>
    requires(std::is_arithmetic_v<T> || std::is_enum_v<T>)
  void operator()(T& value) { raw(&value, sizeof(T)); }
  void operator()(bool& value);  // 0 or 1, and nothing else a byte can be
  // Structures of numbers of one type, which say so: a view of a text would come back as a wild pointer, a bool as
  // neither true nor false, and gaps between members hold whatever was there.
  template <class T>
  void numbers(T& structure) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw(&structure, sizeof(T));
  }
  void operator()(Vector& vector);
  void operator()(std::vector<double>& list);
  void operator()(std::string& text);
  // One of the program's own words, which live as long as it does.
  void literal(std::string_view& text);
  template <class T>
  void operator()(std::vector<T>& list) {
    list.resize(count(list.size()));
    for (T& value : list) (*this)(value);
  }
  template <class Key, class T>
  void operator()(std::map<Key, T>& map) {
    std::vector<std::pair<Key, T>> list(map.begin(), map.end());
    list.resize(count(list.size()));
    for (auto& [key, value] : list) (*this)(key, value);
    map = std::map<Key, T>(list.begin(), list.end());
  }
  template <class T>
  void operator()(std::optional<T>& value) {
    bool has = value.has_value();
    (*this)(has);
    if (!has) return value.reset();
    if (!value) value.emplace();
    (*this)(*value);
  }
  // A word between two parts: reading throws Error where another one stands there.
  void section(std::string_view name);
  // Reading throws Error where what was read is nothing that a run writes: a checksum says that nothing was damaged on
  // the way, and not who has made it.
  void require(bool is_possible) const;

 private:
  void raw(void* data, std::size_t size);
  std::size_t count(std::size_t size);  // of what follows, one byte each at least

  std::function<void(std::string_view)> sink_ = {};
  std::string bytes_ = {};
  std::size_t at_ = 0;
};

}  // namespace seiche
