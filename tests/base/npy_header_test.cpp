#include "base/npy_header.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace avoidbench {
namespace {

/// Byte for byte what numpy.save() writes for such an array.
TEST(NpyHeader, IsNumPys) {
  const std::string header = npy_header("<f4", std::array<std::size_t, 2>{3, 50});
  const std::string about = "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 50), }";
  ASSERT_EQ(header.size(), 128u);
  EXPECT_EQ(header.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(header.substr(8, 2), std::string("\x76\x00", 2)) << "118 bytes follow";
  EXPECT_NE(npy_header("|u1", std::array<std::size_t, 1>{7}).find("'shape': (7,), }"),
            std::string::npos);
  EXPECT_EQ(header.substr(10, about.size()), about);
  EXPECT_EQ(header.substr(10 + about.size()), std::string(117 - about.size(), ' ') + '\n');
}

TEST(NpyHeader, IsAMultipleOf64Bytes) {
  for (std::size_t n = 1; n < 12; ++n) {
    const std::vector<std::size_t> shape(n, 1'000'000'000'000);
    const std::string header = npy_header("|u1", shape);
    EXPECT_EQ(header.size() % 64, 0u);
    EXPECT_EQ(header.back(), '\n');
    const std::size_t length =
        static_cast<unsigned char>(header[8]) + 256u * static_cast<unsigned char>(header[9]);
    EXPECT_EQ(header.size(), 10 + length);
  }
}

TEST(NpyHeader, IsNoLongerThanItMustBe) {
  for (std::size_t length = 1; length < 140; ++length) {
    const std::string header = npy_header(std::string(length, 'x'), std::array<std::size_t, 1>{7});
    EXPECT_EQ(header.size() % 64, 0U) << length;
    const std::size_t needed = header.find('}') + 2;  // and the end of the line
    EXPECT_GE(header.size(), needed) << length;
    EXPECT_LT(header.size(), needed + 64) << length;
    EXPECT_EQ(header.back(), '\n');
  }
}

}  // namespace
}  // namespace avoidbench
