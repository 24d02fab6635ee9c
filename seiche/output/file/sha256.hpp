// SHA-256, by which a file is known to be the one that it was; as sha256sum prints it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace seiche {

std::string sha256(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& file);  // throws Error where it cannot be read

using FileHashes = std::map<std::string, std::string>;  // by the name of the file

}  // namespace seiche
