// Set-up mistakes are thrown as one sentence: the value, what is allowed, and the nearest valid name. Beside it stand
// its parts.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

// For those who say it in other words: a value stands at a place and under a key of a case file, and in Python it is an
// argument.
struct ErrorParts {
  std::string place = {};     // "case.toml:3:5" or "--set method.h=0"; empty where the sentence says enough
  std::string sentence = {};  // what() is "place: sentence", or the sentence alone
  std::string key = {};       // that the sentence begins with: "method.h"; or empty
  // Of an unknown name: "method", "seisv" and "seisav", or no nearest one.
  std::string kind = {}, name = {}, nearest = {};
  std::vector<std::string> allowed = {};
};

class Error : public std::runtime_error {
 public:
  explicit Error(ErrorParts parts);
  explicit Error(std::string_view sentence) : Error(ErrorParts{.sentence = std::string(sentence)}) {}

  template <class... Args>
    requires(sizeof...(Args) > 0)
  explicit Error(fmt::format_string<Args...> format, Args&&... args)
      : Error(ErrorParts{.sentence = fmt::format(format, std::forward<Args>(args)...)}) {}

  const ErrorParts& parts() const { return *parts_; }
  Error at(std::string_view place) const;   // the same, with its place
  Error under(std::string_view key) const;  // the same, with the key if the sentence begins with it

 private:
  std::shared_ptr<const ErrorParts> parts_;  // shared, so that a copy cannot fail
};

// The name closest to `wanted` by edit distance (transpositions count one), or "" if none is near. To a name of one or
// two letters only one of the same letters is near: Q to q, xu to ux, hh to h.
std::string nearest_name(std::string_view wanted, const std::vector<std::string>& names);

// "unknown method 'seisv'; did you mean 'seisav'? Allowed: avf, sav, …"
Error unknown_name(std::string_view what, std::string_view wanted, const std::vector<std::string>& names);

}  // namespace seiche
