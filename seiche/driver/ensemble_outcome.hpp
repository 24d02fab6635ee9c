// What came of an ensemble as a whole: how many members ended how, and what to say of it.
#pragma once

#include <seiche/ensemble/ensemble.hpp>

#include <cstdint>
#include <string>

namespace seiche {

struct EnsembleOutcome {
  explicit EnsembleOutcome(const EnsembleResult& result);

  std::int64_t succeeded, failed, interrupted, replaced, drifted;
  std::int64_t holds, violated, not_promised;  // a law kept up to a failure counts in none of these
  std::string message;
  bool is_written = true;  // false: a file could not be written

  void fail_to_write(const std::string& reason);
  RunReport::Status status() const;  // failed, if one member is
  bool is_remarkable() const;        // members failed, broke a law, drifted or had steps replaced, or files are missing
  std::string law() const;           // "" where every member failed and none broke a law
};

}  // namespace seiche
