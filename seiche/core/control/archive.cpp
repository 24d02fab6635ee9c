#include <seiche/core/control/archive.hpp>

#include <mutex>
#include <set>
#include <utility>

namespace seiche {
namespace {

Error damaged() { return Error("the checkpoint is damaged, or was written by another version"); }

// Texts that were read stay for good; there are as few as places in the program that write them.
std::string_view kept(std::string text) {
  static std::mutex mutex;
  static std::set<std::string> texts;
  const std::scoped_lock lock(mutex);
  return *texts.insert(std::move(text)).first;
}

}  // namespace

Archive::Archive(const std::string& bytes)
    : Archive(bytes.size(),
              [bytes](std::uint64_t at, std::span<char> to) { std::memcpy(to.data(), bytes.data() + at, to.size()); }) {
}

void Archive::raw(void* data, std::size_t size) {
  if (!reads()) return sink_({static_cast<const char*>(data), size});
  if (size > size_ - at_) throw damaged();
  source_(at_, {static_cast<char*>(data), size});
  advance(size);
}

void Archive::advance(std::uint64_t size) {
  at_ += size;
  if (is_at_end()) source_ = {};
}

std::size_t Archive::count(std::size_t size) {
  auto written = static_cast<std::uint64_t>(size);
  (*this)(written);
  if (reads() && written > size_ - at_) throw damaged();
  return static_cast<std::size_t>(written);
}

void Archive::operator()(bool& value) {
  auto byte = static_cast<unsigned char>(value);
  raw(&byte, 1);
  require(byte <= 1);
  value = byte == 1;
}

void Archive::require(bool is_possible) const {
  if (reads() && !is_possible) throw damaged();
}

void Archive::operator()(Vector& vector) {
  const std::size_t size =
      count(static_cast<std::size_t>(joint_ != nullptr ? joint_->size_of_all(vector) : vector.size()));
  if (reads() && size > (size_ - at_) / sizeof(double)) throw damaged();
  if (joint_ == nullptr) {
    vector.resize(static_cast<Index>(size));
    if (size > 0) raw(vector.data(), size * sizeof(double));
  } else if (!reads()) {
    joint_->join(vector, [&](std::span<const double> piece) {
      sink_({reinterpret_cast<const char*>(piece.data()), piece.size_bytes()});
    });
  } else {
    joint_->part(
        static_cast<Index>(size),
        [&](Index from, std::span<double> to) {
          source_(at_ + sizeof(double) * static_cast<std::uint64_t>(from),
                  {reinterpret_cast<char*>(to.data()), to.size_bytes()});
        },
        vector);
    advance(sizeof(double) * size);
  }
}

void Archive::operator()(std::vector<double>& list) {
  const std::size_t size = count(list.size());
  if (reads() && size > (size_ - at_) / sizeof(double)) throw damaged();
  list.resize(size);
  if (size > 0) raw(list.data(), size * sizeof(double));
}

void Archive::operator()(std::string& text) {
  text.resize(count(text.size()));
  if (!text.empty()) raw(text.data(), text.size());
}

void Archive::literal(std::string_view& text) {
  std::string copy(text);
  (*this)(copy);
  if (reads()) text = kept(std::move(copy));
}

void Archive::section(std::string_view name) {
  std::string word(name);
  (*this)(word);
  if (word != name) throw damaged();
}

}  // namespace seiche
