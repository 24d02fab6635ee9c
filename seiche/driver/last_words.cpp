#include <seiche/driver/last_words.hpp>

#include <seiche/core/error.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/final_state.hpp>

#include <algorithm>

namespace seiche {
namespace {

std::uint64_t room_for_state(Index unknowns) {
  constexpr std::uint64_t least = 1U << 15U, most = 1U << 24U, of_a_number = 25;
  return std::min(least + of_a_number * static_cast<std::uint64_t>(unknowns), most);
}

}  // namespace

LastWords::LastWords(const Folder& folder, const Simulation& simulation, Summary summary)
    : folder_(folder),
      simulation_(simulation),
      summary_(std::move(summary)),
      reserve_(folder, ReserveFile::of_a_summary + room_for_state(simulation.problem().size())) {}

void LastWords::write(const RunReport& report) {
  reserve_.release_most();
  std::string failure;
  try {
    write_final_state(folder_, simulation_.physical());
  } catch (const Error& error) {
    failure = error.what();
  }
  written_ = summary_(report);
  write_file(folder_, "summary.json", written_);
  if (!failure.empty()) throw Error("{}", failure);
}

void LastWords::correct(const RunReport& report) {
  const std::string now = summary_(report);
  if (now == written_) return;
  reserve_.release();
  try {
    write_file(folder_, "summary.json", now);
    written_ = now;
  } catch (const Error&) {
    remove_file(folder_, "summary.json");
  }
}

}  // namespace seiche
