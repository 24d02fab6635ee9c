// What stands in for libFuzzer: every file of the folders, and then so many random changes of them, the same in every
// run. Without coverage to guide it, but with the same sanitizers.
//   fuzz_formula [CHANGES] FOLDER…
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr unsigned seed = 20;
constexpr std::size_t longest = 4096;

void feed(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

// Bytes changed, removed, doubled, and a piece of another input put in.
std::string changed(std::string input, const std::vector<std::string>& corpus, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t times = 1 + below(4); times > 0; --times) {
    const std::size_t at = below(input.size() + 1);
    const std::size_t length = below(std::min<std::size_t>(input.size() - at, 16) + 1);
    switch (below(4)) {
      case 0:
        if (at < input.size()) input[at] = static_cast<char>(random() % 128);
        break;
      case 1: input.erase(at, length); break;
      case 2: input.insert(at, input.substr(at, length)); break;
      default: {
        const std::string& other = corpus[below(corpus.size())];
        input.insert(at, other.substr(below(other.size()), 1 + below(24)));
      }
    }
  }
  input.resize(std::min(input.size(), longest));
  return input;
}

}  // namespace

int main(int count, char** arguments) {
  long changes = 0;
  std::vector<std::string> corpus;
  for (int i = 1; i < count; ++i) {
    const std::filesystem::path folder = arguments[i];
    if (!std::filesystem::is_directory(folder)) {
      changes = std::atol(arguments[i]);
      continue;
    }
    using Entries = std::filesystem::directory_iterator;
    std::vector<std::filesystem::path> paths(Entries(folder), Entries{});
    std::sort(paths.begin(), paths.end());  // the same changes everywhere
    for (const std::filesystem::path& path : paths) {
      std::ifstream file(path, std::ios::binary);
      corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
  }
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no input in the folders given\n", arguments[0]);
    return 2;
  }
  for (const std::string& input : corpus) feed(input);
  std::mt19937 random(seed);
  for (long i = 0; i < changes; ++i) feed(changed(corpus[random() % corpus.size()], corpus, random));
  std::printf("%zu inputs of the corpus and %ld changes of them: nothing broke\n", corpus.size(), changes);
}
