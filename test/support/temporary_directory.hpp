// A directory of its own for each test, removed when the test ends.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace seiche::test {

class InTemporaryDirectory : public testing::Test {
 public:
  ~InTemporaryDirectory() override { std::filesystem::remove_all(directory); }

 protected:
  InTemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "seiche_test_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory " + name);
    directory = name;
  }

  std::filesystem::path directory;
};

}  // namespace seiche::test
