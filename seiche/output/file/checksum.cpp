#include <seiche/output/file/checksum.hpp>

#include <zlib.h>

namespace seiche {

// zlib begins and ends with the complement of the remainder that is carried on here.
std::uint32_t checksum(std::string_view bytes, std::uint32_t before) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  return ~static_cast<std::uint32_t>(crc32_z(~before, data, bytes.size()));
}

}  // namespace seiche
