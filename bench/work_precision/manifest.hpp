// Where and with what the numbers were measured.
#pragma once

#include <bench/peers/peer.hpp>
#include <bench/work_precision/options.hpp>

#include <string>
#include <utility>
#include <vector>

namespace seiche::bench {

using Manifest = std::vector<std::pair<std::string, std::string>>;  // what, value

Manifest make_manifest(const Options& options, const std::vector<PeerGroup>& groups);

std::string as_csv_comment(const Manifest& manifest);  // lines "# what: value"
std::string as_json(const Manifest& manifest);

}  // namespace seiche::bench
