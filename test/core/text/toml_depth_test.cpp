// How deep TOML goes is seen before it is parsed, and nothing in texts and comments is taken for depth.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <seiche/core/text/toml_depth.hpp>

#include <string>
#include <string_view>

namespace seiche {
namespace TEST_FILE {

using ::testing::HasSubstr;

std::string repeated(std::string_view text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

std::string said(const std::string& text) { return toml_depth_complaint(text).sentence; }

TEST(TomlDepth, KeysOfMoreThanSixteenPartsAreComplainedAbout) {
  const std::string sixteen = fmt::format("a{}", repeated(".a", 15)), more = sixteen + ".a";
  for (const auto& [before, after] : {std::pair("", " = 1\n"), std::pair("[", "]\n"), std::pair("[[", "]]\n"),
                                      std::pair("b = { ", " = 1 }\n"), std::pair("b = [{ ", " = 1 }]\n")}) {
    EXPECT_EQ(said(before + sixteen + after), "") << before;
    EXPECT_THAT(said(before + more + after), HasSubstr("more than 16 parts")) << before;
  }
  EXPECT_THAT(said(fmt::format("a{} = 1", repeated(" . \"b\"", 16))), HasSubstr("parts")) << "with blanks and quotes";
  EXPECT_THAT(said(fmt::format("a{} = 1", repeated(".'b'", 16))), HasSubstr("parts"));
}

TEST(TomlDepth, ListsAndTablesMoreThanSixteenDeepAreComplainedAbout) {
  for (const auto& [open, close] : {std::pair("[", "]"), std::pair("{ a = ", "}"), std::pair("[\n", "\n]")}) {
    EXPECT_EQ(said("a = " + repeated(open, 16) + "1" + repeated(close, 16) + "\n"), "") << open;
    EXPECT_THAT(said("a = " + repeated(open, 17)), HasSubstr("more than 16 deep")) << open;
  }
  EXPECT_EQ(said(repeated("[a]\n[[b]]\nc = [[1], {d = 2}]\n", 100)), "") << "what is closed is not counted";
  EXPECT_EQ(said(repeated("[a\n", 100)), "") << "a header ends with its line, closed or not";
}

TEST(TomlDepth, DotsAndBracketsInTextsAndCommentsDoNotCount) {
  const std::string many = repeated(".[{", 40);
  for (const std::string& text :
       {"# " + many + "\n", "a = \"" + many + "\"\n", "a = '" + many + "'\n",
        fmt::format("a = \"\"\"{0}\n{0}\"\"\"\n", many), fmt::format("a = '''{0}\n{0}'''\n", many),
        "a = \"\\\"" + many + "\"\n", "a = \"\"\"\\\"\"\"" + many + "\"\"\"\n",
        "a = \"\"\"x\"\"\"\"\"  # " + many + "\n", "a = ''  # " + many + "\n", "a = \"\"  # " + many + "\n"})
    EXPECT_EQ(said(text), "") << text;
  EXPECT_THAT(said("a = \"x\" # \"\nb = " + many), HasSubstr("deep")) << "a text ends where its quotes do";
  EXPECT_THAT(said("a = '\\'\nb = " + many), HasSubstr("deep")) << "single quotes take a backslash as it is";
  EXPECT_THAT(said("a = \"\"\"x\"\"\"\nb = " + many), HasSubstr("deep"));
  EXPECT_THAT(said("a = \"x\nb = " + many), HasSubstr("deep")) << "one without end ends with its line";
}

TEST(TomlDepth, DotsOfNumbersAndFormulasAreNoDotsOfKeys) {
  EXPECT_EQ(said("a = " + repeated("1.5 - ", 40) + "1\n"), "");
  EXPECT_EQ(said("a = [" + repeated("1.5, ", 40) + "]\n"), "");
  EXPECT_EQ(said("a = " + repeated("../", 40) + "out\n"), "") << "as --set gives it, without quotes";
  EXPECT_EQ(said(repeated("a.b.c = 1.5\n", 40)), "");
  EXPECT_THAT(said("a = { b = 1.5, c" + repeated(".c", 16) + " = 1 }"), HasSubstr("parts"));
  EXPECT_THAT(said("a = 1.5\nc" + repeated(".c", 16) + " = 1"), HasSubstr("parts"));
}

TEST(TomlDepth, ThePlaceIsInLinesAndCharacters) {
  const TomlComplaint complaint = toml_depth_complaint("é = 1\n\"é\" = " + repeated("[", 20));
  EXPECT_EQ(complaint.line, 2U);
  EXPECT_EQ(complaint.column, 23U);
}

}  // namespace TEST_FILE
}  // namespace seiche
