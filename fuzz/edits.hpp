// Damage to files, as the bytes of an input say it: so an input is short, and the file is whole where it says nothing.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace seiche::fuzz {

// Eight bytes of an input: which file, what is done to it, where, how much, and with what.
class Edits {
 public:
  static constexpr std::size_t size = 8;

  explicit Edits(std::span<const std::uint8_t> input) : input_(input) {}

  // Those that are meant for the file of this number, of so many.
  std::string applied(std::string bytes, unsigned file, unsigned files) const;

 private:
  std::span<const std::uint8_t> input_;
};

}  // namespace seiche::fuzz
