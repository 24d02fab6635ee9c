#include <seiche/core/base/error.hpp>
#include <seiche/core/simd/thread_count.hpp>

#include <thread>

namespace seiche {

void require_thread_count(int threads) {
  if (threads > most_threads) throw Error("threads = {} must be ≤ {}", threads, most_threads);
}

std::string note_on_threads(int threads) {
  constexpr int many_per_core = 4;
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());  // 0: not known
  if (cores == 0 || threads <= many_per_core * cores) return "";
  return fmt::format("{} threads take turns on {} core{}, which is slower than one thread for each", threads, cores,
                     cores == 1 ? "" : "s");
}

}  // namespace seiche
