#include <seiche/output/file/checksum.hpp>

#include <boost/crc.hpp>

namespace seiche {

std::uint32_t checksum(std::string_view bytes, std::uint32_t before) {
  constexpr std::uint32_t polynomial = 0x04C11DB7;
  boost::crc_optimal<32, polynomial, checksum_of_nothing, 0, true, true> crc(before);
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.get_interim_remainder();  // with which the next part goes on
}

}  // namespace seiche
