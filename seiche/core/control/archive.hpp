// The bytes of a checkpoint. Whatever evolves lists its members once, and the same list writes and reads them.
#pragma once

#include <seiche/core/base/error.hpp>
#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/base/vector.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <span>
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

// How processes that hold the parts of vectors write and read each as one.
class JointVectors {
 public:
  virtual ~JointVectors() = default;
  virtual Index size_of_all(const Vector& mine) const = 0;
  // All of its numbers, in their order, on the process that writes.
  virtual void join(const Vector& mine, FunctionRef<void(std::span<const double> piece)> write) const = 0;
  // mine ← what is here of one of so many numbers, some of which `read` gets.
  virtual void part(Index all, FunctionRef<void(Index from, std::span<double> to)> read, Vector& mine) const = 0;
};

// Numbers lie as they do in memory: bits come back as they were, on a machine of the same kind.
class Archive {
 public:
  // To be written: `sink` gets the bytes one piece after the other, and a vector whole, so that none is copied.
  explicit Archive(std::function<void(std::string_view)> sink) : sink_(std::move(sink)) {}
  // To be read: so many bytes, which `source` gets wherever they lie, or throws Error.
  using Source = std::function<void(std::uint64_t at, std::span<char> bytes)>;
  Archive(std::uint64_t size, Source source) : source_(std::move(source)), size_(size) {}
  explicit Archive(const std::string& bytes);

  bool reads() const { return !sink_; }
  bool is_at_end() const { return at_ == size_; }
  // From here on vectors are those of several processes. `how` outlives the archive.
  void join_vectors(const JointVectors& how) { joint_ = &how; }

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
  void advance(std::uint64_t size);     // what has been read to its end is let go
  std::size_t count(std::size_t size);  // of what follows, one byte each at least

  std::function<void(std::string_view)> sink_ = {};
  Source source_ = {};
  std::uint64_t size_ = 0, at_ = 0;
  const JointVectors* joint_ = nullptr;
};

}  // namespace seiche
