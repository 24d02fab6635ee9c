// Files appear whole or not at all, and numbers survive them to the last bit.
#include <test/support/error_of.hpp>
#include <test/support/temporary_directory.hpp>

#include <seiche/output/energy_trace.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/file/sha256.hpp>
#include <seiche/output/final_state.hpp>
#include <seiche/output/progress.hpp>
#include <seiche/output/summary.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::error_of;
using testing::HasSubstr;

class Output : public test::InTemporaryDirectory {
 protected:
  std::string text(const char* name) const {
    std::ifstream in(directory / name);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
  }
  std::vector<std::string> lines(const char* name) const {
    std::ifstream in(directory / name);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
};

// Doubles that a shorter form would change.
const std::vector<double> awkward = {
    0.1, 1.0 / 3, -2.2250738585072014e-308, 5e-324, 1.7976931348623157e308, 1.0000000000000002, 123456789.12345679,
    -0.0};

TEST_F(Output, AFileIsThereOnlyAfterCommit) {
  const fs::path path = directory / "x.txt";
  AtomicFile file(path);
  file.write("whole");
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(text("x.txt"), "whole");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory), {}), 1) << "nothing temporary is left";
}

TEST_F(Output, WithoutCommitTheEarlierFileStays) {
  write_file(directory / "x.txt", "before");
  { AtomicFile(directory / "x.txt").write("half of somethi"); }
  EXPECT_EQ(text("x.txt"), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory), {}), 1);
}

// Below a regular file nothing can be written, not even by root.
TEST_F(Output, AnUnwritablePlaceIsNamedWithTheReason) {
  write_file(directory / "file", "");
  const fs::path below = directory / "file" / "out";
  for (const std::string& message :
       {error_of([&] { make_directory(below); }), error_of([&] { AtomicFile file(below / "x"); }),
        error_of([&] { make_directory(directory / "file"); })}) {
    EXPECT_THAT(message, HasSubstr((directory / "file").string()));
    EXPECT_THAT(message, HasSubstr(std::strerror(ENOTDIR)));
  }
  EXPECT_THAT(error_of([&] { AtomicFile file(directory / "none" / "x"); }), HasSubstr(std::strerror(ENOENT)));
}

// As the largest size that files may have.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(Output, AFullDiskIsAnErrorAndNotSilence) {
  const SmallDisk disk(2);
  const std::string message = error_of([&] {
    AtomicFile file(directory / "x");
    file.write("text");
    file.commit();
  });
  EXPECT_THAT(message, HasSubstr(std::strerror(EFBIG)));
  EXPECT_TRUE(fs::is_empty(directory));
}

TEST_F(Output, ATableOnAFullDiskKeepsTheLinesThatHadRoom) {
  const SmallDisk disk(8);
  AtomicFile file(directory / "x");
  file.write("one\ntwo\nthree\n");
  EXPECT_THAT(error_of([&] { file.commit_lines(); }), HasSubstr(std::strerror(EFBIG)));
  EXPECT_EQ(text("x"), "one\ntwo\n");
}

TEST_F(Output, LinksThatWaitUnderTemporaryNamesAreNotFollowed) {
  write_file(directory / "victim", "precious");
  fs::create_symlink(directory / "victim", directory / "x.partial");
  write_file(directory / "x", "new");
  EXPECT_EQ(text("victim"), "precious");
  EXPECT_EQ(text("x"), "new");
  EXPECT_FALSE(fs::is_symlink(directory / "x"));
}

TEST_F(Output, AFileThatWasReplacedMeanwhileIsNotTakenForOurs) {
  AtomicFile file(directory / "x");
  file.write("ours");
  fs::remove(directory / "x.partial");
  std::ofstream(directory / "x.partial") << "theirs";
  EXPECT_THAT(error_of([&] { file.commit(); }), HasSubstr("removed or replaced"));
  EXPECT_FALSE(fs::exists(directory / "x"));
  EXPECT_EQ(text("x.partial"), "theirs");
}

TEST_F(Output, AFolderThatIsReplacedIsLeftAlone) {
  const fs::path run = directory / "run", other = directory / "other";
  for (const fs::path& made : {run, other}) fs::create_directory(made);
  const Folder folder(run);
  const FolderLock lock(folder);
  AtomicFile begun(folder, "table");
  begun.write("ours");
  EXPECT_TRUE(folder.is_at_its_path());
  fs::rename(run, directory / "moved");
  fs::create_directory_symlink(other, run);
  EXPECT_FALSE(folder.is_at_its_path());
  begun.commit();
  write_file(folder, "last", "words");
  EXPECT_TRUE(fs::is_empty(other));
  EXPECT_EQ(text("moved/table"), "ours");
  EXPECT_EQ(text("moved/last"), "words");
}

TEST_F(Output, WhereTheLockIsGoneNothingGetsAName) {
  const Folder folder(directory);
  const FolderLock lock(folder);
  AtomicFile begun(folder, "table");
  fs::remove(directory / ".seiche.lock");
  const FolderLock of_another_run{Folder(directory)};
  write_file(directory / "last", "of the other");
  EXPECT_THAT(error_of([&] { begun.commit(); }), HasSubstr("its names may be those of another run"));
  EXPECT_THAT(error_of([&] { write_file(folder, "last", "of the first"); }), HasSubstr(directory.string()));
  EXPECT_EQ(text("last"), "of the other");
  write_file(directory / "other.partial", "of the other");
  { const PartialPath never_opened(folder, "other"); }
  EXPECT_EQ(text("other.partial"), "of the other");
  EXPECT_TRUE(fs::exists(directory / ".seiche.lock"));
}

// As on a file system that tells only then that there was no room.
TEST_F(Output, AFileThatCannotBeClosedIsNotThere) {
  AtomicFile file(directory / "x");
  for (const auto& open : fs::directory_iterator("/proc/self/fd")) {
    std::error_code gone;
    if (fs::read_symlink(open.path(), gone) == fs::canonical(directory) / "x.partial") {
      ASSERT_EQ(::close(std::stoi(open.path().filename().string())), 0);
    }
  }
  EXPECT_THAT(error_of([&] { file.commit(); }), HasSubstr(std::strerror(EBADF)));
  EXPECT_FALSE(fs::exists(directory / "x"));
}

TEST_F(Output, TheFinalStateReadsBackToTheLastBit) {
  write_final_state(Folder(directory), [&](const auto& take) { take(awkward); });
  const std::vector<std::string> read = lines("final.txt");
  ASSERT_EQ(read.size(), awkward.size());
  for (std::size_t i = 0; i < awkward.size(); ++i) {
    EXPECT_EQ(std::strtod(read[i].c_str(), nullptr), awkward[i]) << read[i];
  }
  EXPECT_EQ(read[0], "0.1") << "as few digits as tell it from all others";
  EXPECT_EQ(read[5], "1.0000000000000002");
}

TEST_F(Output, TheEnergyTraceHasAColumnForTheModifiedEnergyOnlyWhereThereIsOne) {
  for (const bool modified : {false, true}) {
    EnergyTrace trace(Folder(directory), modified);
    const State state{.z = {}, .t = 0.25, .n = 1};
    trace.observe(state, {.H = 0.1, .modified = 1.0 / 3});
    trace.finish({});
    EXPECT_EQ(lines("energy.csv"), (modified ? std::vector<std::string>{"t,H,H_modified", "0.25,0.1,0.3333333333333333"}
                                             : std::vector<std::string>{"t,H", "0.25,0.1"}));
  }
}

TEST_F(Output, ManyRowsGoToTheDiskInLargePieces) {
  AtomicFile file(directory / "x");
  std::set<std::uintmax_t> sizes;
  for (int i = 0; i < 20000; ++i) {
    file.write("0.1,0.2,0.3\n");
    sizes.insert(fs::file_size(directory / "x.partial"));
  }
  EXPECT_EQ(sizes.size(), 1U + 20000 * 12 / (1U << 16U)) << "of 64 kB each";
}

TEST(Summary, HasTheKeysOfTheInterfaceInTheirOrder) {
  RunReport report;
  report.has_modified_energy = true;
  report.message = "said \"so\"\n";
  const RunIdentity run{.problem = "klein_gordon", .method = "seisav", .backend = "modal", .h = 1.0 / 256};
  const auto json = nlohmann::ordered_json::parse(summary_json(run, report));
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  EXPECT_EQ(keys, (std::vector<std::string>{"status", "message", "problem", "method", "backend", "h", "steps", "t",
                                            "energy", "counts", "wall_seconds", "finished", "versions"}));
  EXPECT_EQ(
      json["energy"].dump(),
      R"({"initial":0.0,"final":0.0,"max_increase":0.0,"modified":{"initial":0.0,"final":0.0,"max_increase":0.0},)"
      R"("law":"not promised"})");
  EXPECT_EQ(
      json["counts"].dump(),
      R"({"gradients":0,"potentials":0,"scalar_iterations":0,"fallbacks":0,"replaced":0,"widened":0,"halved":0})");
  EXPECT_EQ(json["h"], 0.00390625);
  EXPECT_EQ(json["message"], "said \"so\"\n");
}

TEST_F(Output, ASha256IsThatOfSha256sum) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");  // FIPS 180-4
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  std::string bytes;
  for (unsigned i = 0; i < 300000; ++i) bytes.push_back(static_cast<char>(i * i % 251));
  write_file(directory / "bytes", bytes);
  EXPECT_EQ(sha256_of_file(directory / "bytes"), sha256(bytes));
  const std::string call =
      "cd '" + directory.string() + "' && command -v sha256sum >where && sha256sum bytes >sum 2>/dev/null";
  if (std::system(call.c_str()) != 0) GTEST_SKIP() << "no sha256sum";
  EXPECT_EQ(lines("sum").front(), sha256(bytes) + "  bytes");
  EXPECT_THAT(error_of([&] { sha256_of_file(directory / "none"); }), HasSubstr("none cannot be read"));
}

TEST(Summary, NotANumberBecomesNullSoThatEveryReaderOfJsonAcceptsIt) {
  RunReport report;
  report.energy.initial = std::numeric_limits<double>::quiet_NaN();
  report.energy.final = std::numeric_limits<double>::infinity();
  report.message = "\xff is no UTF-8";
  const auto json = nlohmann::json::parse(summary_json({}, report));
  EXPECT_TRUE(json["energy"]["initial"].is_null());
  EXPECT_TRUE(json["energy"]["final"].is_null());
  EXPECT_TRUE(json["energy"]["modified"].is_null()) << "the method has none";
}

TEST(Progress, NeverAsksForARecordAndDrawsAtMostTenTimesASecond) {
  std::FILE* terminal = std::tmpfile();
  ASSERT_TRUE(terminal);
  setenv("NO_COLOR", "1", 1);
  Progress progress(terminal, 1e9);
  State state;
  const auto begin = std::chrono::steady_clock::now();
  const auto size = [&] {
    std::fflush(terminal);
    return std::ftell(terminal);
  };
  int bars = 0;
  for (long before = 0; bars < 3;) {
    ++state.n;
    EXPECT_FALSE(progress.is_due(state, false));
    if (size() == before) continue;
    before = size();
    ++bars;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_LE(bars, 10 * seconds + 1);
  progress.finish({});
  std::rewind(terminal);
  std::string drawn(1 << 16, '\0');
  drawn.resize(std::fread(drawn.data(), 1, drawn.size(), terminal));
  std::fclose(terminal);
  const auto returns = std::count(drawn.begin(), drawn.end(), '\r');
  EXPECT_EQ(returns, 3 + 2) << "three bars and the two that wipe the last one";
  EXPECT_THAT(drawn, HasSubstr("steps/s"));
  EXPECT_EQ(drawn.find('\x1b'), std::string::npos) << "NO_COLOR is honoured";
}

}  // namespace TEST_FILE
}  // namespace seiche
