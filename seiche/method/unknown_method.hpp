#pragma once

#include <seiche/core/base/error.hpp>
#include <seiche/method/methods.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace seiche {

// Names the nearest one, or for a method of other programs, as rk4, the one that does its work here.
Error unknown_method(std::string_view name, const std::vector<std::string>& allowed = method_names());

}  // namespace seiche
