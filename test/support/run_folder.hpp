// A folder with one run of the program in it.
#pragma once

#include <test/support/error_of.hpp>
#include <test/support/paths.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <seiche/figure/html.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace seiche::test {

// Python with what draws the pictures of a run.
inline bool can_draw() {
  static const bool found = std::system(
                                "python3 -c 'import matplotlib, h5py' 2>/dev/null || "
                                "/usr/bin/python3 -c 'import matplotlib, h5py' 2>/dev/null") == 0;
  return found;
}

class RunFolder : public InTemporaryDirectory {
 protected:
  // The exit code of the program, whose words go to said.txt.
  int seiche(const std::string& arguments, const std::string& before = "") const {
    const std::string command =
        before + " '" + test::program_path() + "' " + arguments + " >'" + (directory / "said.txt").string() + "' 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string said() const { return text_of(directory / "said.txt"); }
  std::filesystem::path out() const { return directory / "out"; }
  void run(const std::string& problem, const std::string& settings = "") const {
    std::ofstream(directory / "case.toml") << "[problem]\nname = \"" << problem
                                           << "\"\n[method]\nh = \"1/32\"\n[time]\nend = 0.5\n[output]\n"
                                              "snapshot_every = 1\nledger = \"on\"\n";
    ASSERT_EQ(seiche("run '" + (directory / "case.toml").string() + "' --quiet --out '" + out().string() + "'" +
                     (settings.empty() ? "" : " --set " + settings)),
              0)
        << said();
  }
  std::string report() const { return text_of(out() / "report.html"); }

  // Every one of them is on the disk, is not empty, and is in the report with both grounds.
  void expect_drawn(const std::set<std::string>& stems) const {
    const std::string page = report();
    for (const std::string& stem : stems) {
      for (const char* suffix : {"", "_dark"}) {
        const std::filesystem::path png = out() / "figures" / (stem + suffix + ".png");
        ASSERT_TRUE(std::filesystem::exists(png)) << png;
        EXPECT_GT(read_png(png).width, 900U) << png;
        EXPECT_GT(std::filesystem::file_size(png), 8000U) << png << " shows something";
        EXPECT_THAT(page, testing::HasSubstr(read_png(png).data_uri));
      }
      EXPECT_THAT(page, testing::HasSubstr("figures/" + stem + ".png"));
    }
    std::size_t drawn = 0;
    for (const auto& entry : std::filesystem::directory_iterator(out() / "figures"))
      drawn += entry.path().extension() == ".png";
    EXPECT_EQ(drawn, 2 * stems.size());
    EXPECT_THAT(page, testing::Not(testing::HasSubstr("not drawn")));
  }
};

}  // namespace seiche::test
