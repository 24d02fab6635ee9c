#include <seiche/driver/last_words.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/final_state.hpp>

#include <utility>

namespace seiche {

LastWords::LastWords(Folder folder, const Simulation& simulation, Summary summary)
    : folder_(std::move(folder)), simulation_(simulation), summary_(std::move(summary)) {}

void LastWords::write(const RunReport& report) {
  std::string failure;
  try {
    write_final_state(folder_, [this](const auto& take) { join_values(simulation_, take); });
  } catch (const Error& error) {
    failure = error.what();
  }
  const std::string summary = summary_(report);
  write_file(folder_, "summary.json", summary);
  written_ = summary;
  if (!failure.empty()) throw Error("{}", failure);
}

void LastWords::correct(const RunReport& report) {
  const std::string now = summary_(report);
  if (now == written_) return;
  try {
    write_file(folder_, "summary.json", now);
    written_ = now;
  } catch (const Error&) {
    remove_file(folder_, "summary.json");
    written_.clear();
  }
}

}  // namespace seiche
