// CRC-32, by which damage is told from data.
#pragma once

#include <cstdint>
#include <string_view>

namespace seiche {

inline constexpr std::uint32_t checksum_of_nothing = 0xFFFFFFFF;

// Of some bytes, behind others whose checksum is `before`.
std::uint32_t checksum(std::string_view bytes, std::uint32_t before = checksum_of_nothing);

}  // namespace seiche
