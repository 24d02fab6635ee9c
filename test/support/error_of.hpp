// The sentence with which something is refused.
#pragma once

#include <seiche/core/base/error.hpp>

#include <string>

namespace seiche::test {

// What the Error says that `action` throws, or "" where it throws none.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace seiche::test
