// What came of an ensemble as a whole: how many members ended how, and what to say of it.
#pragma once

#include <seiche/ensemble/ensemble.hpp>

#include <cstdint>
#include <string>

namespace seiche {

struct EnsembleOutcome {
  explicit EnsembleOutcome(const EnsembleResult& result);

  std::int64_t succeeded, failed, interrupted, replaced, drifted;
  std::int64_t holds, violated, not_promised;  // a law that was kept up to a failure is none of these
  std::string message;
  bool is_written = true;  // is all on disk?

  void fail_to_write(const std::string& reason);
  RunReport::Status status() const;  // failed, if one member is
  bool is_remarkable() const;        // is there anything in the message that nobody should miss?
  std::string law() const;           // "" where every member failed and none broke a law
};

}  // namespace seiche
