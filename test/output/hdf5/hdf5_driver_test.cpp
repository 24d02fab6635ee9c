// The driver that HDF5 writes through, called as HDF5 calls it: what was held back never overwrites what came later,
// and no exception leaves it.
#include <test/support/temporary_directory.hpp>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif
#include <unistd.h>
#include <seiche/output/hdf5/hdf5_calls.hpp>
#include <seiche/output/hdf5/hdf5_driver.hpp>

#include <limits>
#include <string>

namespace seiche {
namespace TEST_FILE {

class OrderedDriver : public test::InTemporaryDirectory {
 protected:
  static constexpr haddr_t length = 64;  // of the file, whose bytes are all '.', at the start of each test

  void SetUp() override {
    descriptor_ = ::open((directory / "x").c_str(), O_RDWR | O_CREAT, 0666);
    ASSERT_GE(descriptor_, 0);
    const Hdf5Handle access = ordered_file_access(descriptor_);
    file_ = H5FDopen("x", H5F_ACC_RDWR | H5F_ACC_CREAT | H5F_ACC_TRUNC, access.id(), HADDR_MAX);
    ASSERT_NE(file_, nullptr);
    set_end(length);
    ASSERT_TRUE(write(H5FD_MEM_OHDR, 0, std::string(length, '.')));
    ASSERT_TRUE(settle());
    ASSERT_EQ(on_disk(), std::string(length, '.'));
  }
  void TearDown() override {
    if (file_ != nullptr) H5FDclose(file_);
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  void set_end(haddr_t end) const { ASSERT_GE(H5FDset_eoa(file_, H5FD_MEM_DEFAULT, end), 0); }
  bool write(H5FD_mem_t kind, haddr_t at, const std::string& bytes) const {
    return write(kind, at, bytes.data(), bytes.size());
  }
  bool write(H5FD_mem_t kind, haddr_t at, const char* from, std::size_t size) const {
    return H5FDwrite(file_, kind, H5P_DEFAULT, at, size, from) >= 0;
  }
  bool settle() const { return H5FDflush(file_, H5P_DEFAULT, false) >= 0; }
  std::string read(haddr_t at, std::size_t size) const {
    std::string bytes(size, '?');
    return H5FDread(file_, H5FD_MEM_DEFAULT, H5P_DEFAULT, at, size, bytes.data()) < 0 ? "cannot be read" : bytes;
  }
  std::string on_disk() const {
    std::string bytes(1024, '?');
    const ::ssize_t size = ::pread(descriptor_, bytes.data(), bytes.size(), 0);
    bytes.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return bytes;
  }

  const Hdf5Quiet quiet_;
  int descriptor_ = -1;
  H5FD_t* file_ = nullptr;
};

TEST_F(OrderedDriver, HoldsMetadataBackToTheNextFlush) {
  ASSERT_TRUE(write(H5FD_MEM_OHDR, 8, "header"));
  EXPECT_EQ(on_disk(), std::string(length, '.'));
  EXPECT_EQ(read(6, 10), "..header..");
  ASSERT_TRUE(settle());
  EXPECT_EQ(on_disk().substr(6, 10), "..header..");
}

// Where HDF5 has given up what was there, and the room is taken by rows.
TEST_F(OrderedDriver, WhatIsHeldBackDoesNotOverwriteLaterRows) {
  ASSERT_TRUE(write(H5FD_MEM_BTREE, 16, "an index"));
  ASSERT_TRUE(write(H5FD_MEM_DRAW, 20, "rows"));
  EXPECT_EQ(read(16, 8), "an irows");
  ASSERT_TRUE(settle());
  EXPECT_EQ(on_disk().substr(16, 8), "an irows");
}

TEST_F(OrderedDriver, WhatIsHeldBackBehindAnEndThatMovedIsForgotten) {
  ASSERT_TRUE(write(H5FD_MEM_BTREE, 24, "an index"));
  ASSERT_TRUE(write(H5FD_MEM_BTREE, 40, "another one"));
  set_end(27);
  set_end(length);
  EXPECT_EQ(read(24, 30), "an " + std::string(27, '.'));
  ASSERT_TRUE(settle());
  std::string expected(length, '.');
  expected.replace(24, 3, "an ");
  EXPECT_EQ(on_disk(), expected);
}

// As where there is no memory: frames of C are no place for exceptions.
TEST_F(OrderedDriver, NoExceptionLeavesIt) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "asks for more bytes than an address can count, which the sanitizer ends before std::string throws";
#endif
  constexpr std::size_t too_much = std::numeric_limits<std::size_t>::max() / 2 + 1;
  set_end(too_much);
  const std::string few = "few bytes";
  EXPECT_NO_THROW(EXPECT_FALSE(write(H5FD_MEM_SUPER, 0, few.data(), too_much)));
  set_end(length);
  EXPECT_FALSE(settle()) << "what HDF5 has written is not all there";
  EXPECT_EQ(on_disk(), std::string(length, '.')) << "as it was at the last flush";
}

}  // namespace TEST_FILE
}  // namespace seiche
