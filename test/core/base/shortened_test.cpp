// Texts of users in sentences: short, on one line, and in whole characters.
#include <gtest/gtest.h>
#include <seiche/core/base/shortened.hpp>

#include <string>

namespace seiche {
namespace TEST_FILE {

TEST(Shortened, ShortTextsStayAsTheyAre) {
  EXPECT_EQ(shortened("problem.gamma = ½γu²"), "problem.gamma = ½γu²");
  EXPECT_EQ(shortened_path("out/größe"), "out/größe");
  EXPECT_EQ(one_line("one sentence; and “another”"), "one sentence; and “another”");
}

TEST(Shortened, LongOnesAreCutBetweenCharacters) {
  EXPECT_EQ(shortened("abcdef", 3), "abc…");
  EXPECT_EQ(shortened("aéé", 2), "a…");
  EXPECT_EQ(shortened_path("folder/case.toml", 9), "…case.toml");
  EXPECT_EQ(shortened_path("éé", 3), "…é");
  const std::string line = one_line("begins" + std::string(1'000'000, 'x') + "ends");
  EXPECT_EQ(line.size(), 380U);
  EXPECT_TRUE(line.starts_with("begins") && line.ends_with("ends")) << line;
  EXPECT_TRUE(is_utf8(one_line("γ" + std::string(7, 'x') + std::string(600, '\xC3') + "γ")));
}

TEST(Shortened, NothingLeavesTheLineOrMovesTheCursor) {
  EXPECT_EQ(shortened("a\nb\tc\x1b[2Jd"), "a b c?[2Jd");
  EXPECT_EQ(shortened("a\xff\xc3"), "a??");
  EXPECT_EQ(one_line("a sentence\n  its text\n       ^"), "a sentence its text ^");
}

TEST(Shortened, WhatIsUtf8IsKnown) {
  for (const char* text : {"", "abc", "é", "…", "\xF0\x9F\x8C\x8A"}) EXPECT_TRUE(is_utf8(text)) << text;
  for (const char* text :
       {"\xff", "a\x80", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xe2\x80", "\xf4\x90\x80\x80", "\xe0\x80\xaf"})
    EXPECT_FALSE(is_utf8(text)) << text;
}

}  // namespace TEST_FILE
}  // namespace seiche
