// Input that is meant to do harm, or has come to: refused in one short line, before anything is computed.
#include <test/support/hostile_input.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <thread>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::HostileInput;
using test::market;
using test::repeated;
using Result = test::Cli::Result;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(HostileInput, KeysListsAndTablesWithoutEndAreRefusedBeforeTheyAreParsed) {
  const std::string key = fmt::format("a{}", repeated(".a", deep));
  for (const std::string& text : {key + " = 1\n", "[" + key + "]\n", "[[" + key + "]]\n", "b = { " + key + " = 1 }\n"})
    EXPECT_THAT(refused_case(text), HasSubstr("a key has more than 16 parts"));
  for (const std::string open : {"[", "{ a = ", "{ a = [", "[\n"})
    EXPECT_THAT(refused_case("[problem]\ngamma = " + repeated(open, deep)), HasSubstr("more than 16 deep"));
  write_case();
  EXPECT_THAT(refused_in_a_line("run case.toml --out out --set problem." + key + "=1"),
              HasSubstr("more than 16 parts"));
  EXPECT_THAT(refused_in_a_line("run case.toml --out out --set 'problem.gamma={" + key + "=1}'"),
              HasSubstr("more than 16 parts"));
  EXPECT_THAT(refused_in_a_line("run case.toml --out out --set 'problem.gamma=" + repeated("[", deep) + "'"),
              HasSubstr("more than 16 deep"));
}

TEST_F(HostileInput, APipeInThePlaceOfAFileOfARunIsNotWaitedFor) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --out whole --quiet").exit, 0);
  for (const char* name : {"case.toml", "energy.csv", "solution.h5", "final.txt", "summary.json"}) {
    fs::remove_all(directory / "out");
    fs::copy(directory / "whole", directory / "out");
    fs::remove(directory / "out" / name);
    ASSERT_EQ(mkfifo((directory / "out" / name).c_str(), 0600), 0);
    for (const char* command : {"audit out", "plot out"}) {
      if (std::string(command) == "plot out" && std::string(name) == "final.txt") continue;  // not read
      const Result result = seiche(command, "timeout 20");
      EXPECT_EQ(result.exit, 2) << command << name << result.err;
      expect_one_line(result.err, command);
    }
  }
}

TEST_F(HostileInput, WhatHasNoEndOrNoWriterIsNoCaseFile) {
  const auto said = [this](const std::string& arguments) {
    const Result result = seiche(arguments, "timeout 20");
    EXPECT_EQ(result.exit, 2) << arguments;
    expect_one_line(result.err, arguments);
    return result.err;
  };
  ASSERT_EQ(mkfifo((directory / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(said("check pipe"), HasSubstr("is a pipe or a device"));
  EXPECT_THAT(said("check /dev/zero"), HasSubstr("is a pipe or a device"));
  EXPECT_THAT(said("check - </dev/zero"), HasSubstr("more than 16 MB"));
  EXPECT_THAT(said("check /dev/stdin </dev/zero"), HasSubstr("more than 16 MB"));
  write("large.toml", std::string((std::size_t{16} << 20U) + 1, '\n'));
  EXPECT_THAT(said("check large.toml"), HasSubstr("more than 16 MB"));
  write_case("initial = { file = \"pipe\" }");
  EXPECT_THAT(said("check case.toml"), HasSubstr("is not a file"));
}

TEST_F(HostileInput, WhatHasNoWriterIsNoCheckpoint) {
  write_case();
  std::filesystem::create_directory(directory / "out");
  std::filesystem::copy_file(directory / "case.toml", directory / "out/case.toml");
  ASSERT_EQ(mkfifo((directory / "out/checkpoint.seiche").c_str(), 0600), 0);
  const Result resumed = seiche("resume out", "timeout 20");
  EXPECT_EQ(resumed.exit, 2);
  EXPECT_THAT(resumed.err, HasSubstr("is not a file"));
}

TEST_F(HostileInput, WhatTheShellOpensIsReadAsBefore) {
  write_case();
  EXPECT_EQ(seiche("check /dev/stdin", "cat case.toml |").exit, 0);
  EXPECT_EQ(seiche("check -", "cat case.toml |").exit, 0);
  EXPECT_EQ(seiche("check /dev/stdin <case.toml").exit, 0);
  if (std::system("bash -c true 2>/dev/null") != 0) GTEST_SKIP() << "no bash";
  EXPECT_EQ(seiche("", "bash -c 'exec \"$0\" check <(cat case.toml)'").exit, 0);
}

TEST_F(HostileInput, MoreThanAThousandThreadsAreRefusedAndManyToACoreAreNoted) {
  write_case();
  for (const std::string command : {"run case.toml --out out", "spectrum case.toml"})
    EXPECT_THAT(refused_in_a_line(command + " --threads 65536"), HasSubstr("1024")) << command;
  write("ensemble.toml", text("case.toml") + "[ensemble]\nmembers = 9\nperturb_initial = 0.1\n");
  EXPECT_THAT(refused_in_a_line("run ensemble.toml --out out --threads 1025"),
              HasSubstr("'1025' is no whole number from 1 to 1024"));
  const std::string few = seiche("run case.toml --out few --threads 2").err;
  EXPECT_THAT(few, Not(HasSubstr("take turns")));
  const Result many = seiche("run case.toml --out many --threads 1024");
  EXPECT_EQ(many.exit, 0) << many.err;
  if (std::thread::hardware_concurrency() < 256) {
    EXPECT_THAT(many.err, HasSubstr("seiche: 1024 threads take turns on "));
    EXPECT_THAT(seiche("run ensemble.toml --out members --threads 1024").err, HasSubstr("take turns on "));
  }
}

TEST_F(HostileInput, SizesOfMatricesAreComparedBeforeTheirEntriesAreRead) {
  write_matrices(market + "2 2 1\nx y z\n", market + "4 4 1\nx y z\n");
  EXPECT_THAT(refused_in_a_line("run case.toml --out out"), HasSubstr("problem.S is 4 × 4 but problem.M is 2 × 2"));
  write_matrices(market + "2 3 1\nx y z\n");
  EXPECT_THAT(refused_in_a_line("run case.toml --out out"), HasSubstr("problem.M is 2 × 3 and must be square"));
}

TEST_F(HostileInput, AMatrixOfEmptyRowsIsRefusedBeforeItTakesMemory) {
  for (const std::string rows : {"50000000", "100000000", "2000000000"}) {
    write_matrices(fmt::format("{0}{1} {1} 1\n1 1 1\n", market, rows));
    EXPECT_THAT(refused_in_a_line("check case.toml"),
                AnyOf(HasSubstr("nearly all rows are empty"), HasSubstr("needs at least")));
  }
}

TEST_F(HostileInput, EntriesAtOnePlaceAddUpAndThatIsSaid) {
  write_matrices(market + "2 2 3\n1 1 1\n2 2 1\n1 1 1\n");
  EXPECT_THAT(seiche("run case.toml --out out").err,
              HasSubstr("seiche: problem.M: M.mtx has several entries at one place, which add up"));
  write_matrices(market + "2 2 2\n1 1 1\n2 2 1\n");
  EXPECT_THAT(seiche("run case.toml --out out").err, Not(HasSubstr("several entries")));
}

TEST_F(HostileInput, TwoSignsAreNotANumber) {
  write_matrices(market + "2 2 2\n1 1 +-1\n2 2 1\n");
  EXPECT_THAT(refused_in_a_line("check case.toml"), HasSubstr("M.mtx:3: '+-1' is not a number"));
  write_matrices(market + "2 2 2\n1 1 +1\n2 2 1\n");
  EXPECT_EQ(seiche("check case.toml").exit, 0);
  write("z.txt", "+-0.05" + repeated(" 1", 15) + "\n");
  write_case("initial = { file = \"z.txt\" }");
  EXPECT_THAT(refused_in_a_line("check case.toml"), HasSubstr("z.txt:1: '+-0.05' is not a finite number"));
}

TEST_F(HostileInput, NamesThatAreNoUtf8AreRefusedBeforeTheRun) {
  write_case();
  const std::string byte = "\xff";
  EXPECT_THAT(refused_in_a_line("run case.toml --out 'bad" + byte + "'"),
              AllOf(HasSubstr("output folder"), HasSubstr("UTF-8")));
  EXPECT_FALSE(fs::exists(directory / ("bad" + byte)));
  fs::copy_file(directory / "case.toml", directory / ("case" + byte + ".toml"));
  EXPECT_THAT(refused_in_a_line("run 'case" + byte + ".toml' --out out"),
              AllOf(HasSubstr("case file"), HasSubstr("UTF-8")));
  write("z" + byte, repeated("1\n", 16));
  EXPECT_THAT(refused_in_a_line("run case.toml --out out --set 'problem.initial={file=\"z" + byte + "\"}'"),
              AllOf(HasSubstr("initial"), HasSubstr("UTF-8")));
  EXPECT_THAT(refused_in_a_line("check case.toml --set 'output.directory=bad" + byte + "'"),
              AllOf(HasSubstr("output.directory"), HasSubstr("UTF-8")));
  EXPECT_EQ(seiche("run case.toml --quiet --out größe").exit, 0);
  EXPECT_EQ(seiche("audit größe").exit, 0);
}

TEST_F(HostileInput, LinksThatLeadInCirclesAreNamedWithTheReason) {
  fs::create_symlink("b", directory / "a");
  fs::create_symlink("a", directory / "b");
  for (const std::string command : {"check a", "run a --out out", "audit a", "plot a"}) refused_in_a_line(command);
  EXPECT_THAT(refused("check a"), HasSubstr("Too many levels of symbolic links"));
  write_case("initial = { file = \"a\" }");
  EXPECT_THAT(refused_in_a_line("check case.toml"), HasSubstr("Too many levels of symbolic links"));
  write_case();
  EXPECT_THAT(refused_in_a_line("run case.toml --out a/x"), HasSubstr("Too many levels of symbolic links"));
}

}  // namespace TEST_FILE
}  // namespace seiche
