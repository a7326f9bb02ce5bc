#include "weights_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <stdexcept>

#include "make_weights.hpp"
#include "network.hpp"

namespace agile {
namespace {

using test::file_bytes;
using test::write_bytes;
using test::WrittenTensors;
using ::testing::AllOf;
using ::testing::HasSubstr;

const test::Widths kSmall{
    .convolutions = {2, 3, 2, 1, 2}, .image = 3, .state1 = 2, .state2 = 3, .head1 = 4, .head2 = 2};

/// A file that goes with the test.
class WeightsFiles : public ::testing::Test {
 protected:
  WeightsFiles()
      : folder_(std::filesystem::temp_directory_path() /
                ("weights_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~WeightsFiles() override { std::filesystem::remove_all(folder_); }

  /// What a network says to a file of these bytes; nothing where it takes it.
  std::string refusal(const std::string& bytes) {
    write_bytes(folder_ / "small.safetensors", bytes);
    return refusal_of(folder_ / "small.safetensors");
  }

  static std::string refusal_of(const std::filesystem::path& file) {
    try {
      Network network(file);
      network.run(std::vector<std::uint8_t>(std::size_t{kImageHeight} * kImageWidth, 9),
                  std::vector<float>(kInputs, 0.5F));
      return "";
    } catch (const std::runtime_error& error) {
      // Whatever it is, the message names the file and says what to do.
      EXPECT_THAT(error.what(), AllOf(HasSubstr("weights " + file.string() + ": "),
                                      HasSubstr("; use the file that comes with the planner")));
      return error.what();
    }
  }

  std::filesystem::path folder_;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(Half, IsExactInSinglePrecision) {
  for (std::uint32_t i = 0; i < 0x10000U; ++i) {
    const auto half = static_cast<std::uint16_t>(i);
    const float value = from_half(half);
    ASSERT_EQ(std::signbit(value), (half & 0x8000U) != 0U) << i;
    if ((half & 0x7C00U) == 0x7C00U) {
      ASSERT_EQ(std::isnan(value), (half & 0x3FFU) != 0U) << i;
      ASSERT_EQ(std::isinf(value), (half & 0x3FFU) == 0U) << i;
    } else {
      ASSERT_EQ(static_cast<double>(value), test::half_value(half)) << i;
      ASSERT_EQ(test::to_half(static_cast<double>(value)), half) << i;  // the tests' own
    }
  }
}

TEST_F(WeightsFiles, GivesTensorsAsTheyWereWritten) {
  const WrittenTensors tensors = test::make_weights(1, kSmall);
  write_bytes(folder_ / "file", file_bytes(tensors));
  WeightsFile file(folder_ / "file");
  for (const auto& tensor : tensors) {
    const Tensor read = file.take(tensor.name, std::vector<std::size_t>(tensor.shape.size(), 0));
    EXPECT_EQ(read.shape, tensor.shape);
    ASSERT_EQ(read.values.size(), tensor.halves.size());
    for (std::size_t i = 0; i < read.values.size(); ++i) {
      ASSERT_EQ(static_cast<double>(read.values[i]), test::half_value(tensor.halves[i]));
    }
  }
  file.check_all_taken();
}

TEST_F(WeightsFiles, TakesASpacedHeaderAndOtherMetadata) {
  const WrittenTensors tensors = test::make_weights(1, kSmall);
  const std::string header = replaced(test::header_of(tensors), R"({"format":)",
                                      R"({"training": "3 rounds \u00e9", "format":)");
  EXPECT_EQ(refusal(test::join_file(header + "   ", test::data_of(tensors))), "");
}

TEST_F(WeightsFiles, RefusesATruncatedOne) {
  const WrittenTensors tensors = test::make_weights(1, kSmall);
  const std::string whole = file_bytes(tensors);
  const std::size_t data = 8 + test::header_of(tensors).size();
  ASSERT_EQ(refusal(whole), "");
  for (std::size_t length = 0; length < data; length += length < 16 ? 1 : 7) {
    ASSERT_THAT(refusal(whole.substr(0, length)), HasSubstr("is truncated")) << length;
  }
  std::size_t boundary = data;
  for (const auto& tensor : tensors) {
    for (const int by : {-1, 0, 1}) {
      const std::size_t length = boundary + static_cast<std::size_t>(by + 1) - 1;
      ASSERT_THAT(refusal(whole.substr(0, length)), HasSubstr("truncated")) << length;
    }
    boundary += 2 * tensor.halves.size();
  }
  ASSERT_EQ(boundary, whole.size());
  EXPECT_THAT(refusal(whole.substr(0, boundary - 1)), HasSubstr("truncated"));
  EXPECT_THAT(refusal(whole + "x"), HasSubstr("goes on behind its last tensor"));
}

TEST_F(WeightsFiles, RefusesWrongHeaders) {
  const WrittenTensors tensors = test::make_weights(1, kSmall);
  const std::string header = test::header_of(tensors), data = test::data_of(tensors);
  struct Case {
    std::string what, by, message;
  };
  // conv1.weight: [2,1,5,5] from 0 to 100; conv1.bias: [2] to 104.
  const std::vector<Case> cases{
      {header, "", "is not a JSON object"},
      {header, "[]", "is not a JSON object"},
      {header, std::string(100000, '['), "is not a JSON object"},
      {header, "{}", "does not give the format"},
      {"agile/1", "agile/2", "does not give the format"},
      {R"("agile/1")", "1", "does not give the format"},
      {R"({"format":"agile/1"})", "3", "does not give the format"},
      {"}}", "}", "is not a JSON object"},
      {"conv1", "conv\xFF", "is not a JSON object"},
      {"F16", "F32", R"("conv1.weight" has the dtype "F32" instead of F16)"},
      {"F16", "BF16", R"(has the dtype "BF16" instead of F16)"},
      {R"("F16")", "16", "has a dtype that is no text"},
      {"dtype", "type", "lacks dtype, shape or data_offsets"},
      {"shape", "form", "lacks dtype, shape or data_offsets"},
      {"[2,1,5,5]", "[2,1,5]", "has 100 bytes, and its shape [2, 1, 5] takes 20"},
      {"[2,1,5,5]", "[1,2,5,5]", R"("conv1.weight" has the shape [1, 2, 5, 5], which should be)"},
      {"[2,1,5,5]", "[50]", "[1…4096, 1, 5, 5]"},
      {"[2,1,5,5]", "[2,1,5,-5]", "a shape that is no list of sizes"},
      {"[2,1,5,5]", "[2,1,5,5.0]", "a shape that is no list of sizes"},
      {"[2,1,5,5]", "7", "a shape that is no list of sizes"},
      {"[2,1,5,5]", "[4294967296,4294967296,5,5]", "a shape that is no list of sizes"},
      {"[2,1,5,5]", "[2,1,5,9223372036854775813]", "a shape that is no list of sizes"},
      {"[2,1,5,5]", "[2,1,5,18446744073709551617]", "a shape that is no list of sizes"},
      {"[2,1,5,5]", "[1,1,1,1,1,1,1,1,50]", "a shape that is no list of sizes"},
      {"[2,1,5,5]", "[0,18446744073709551615]", "a shape that is no list of sizes"},
      {"[2,1,5,5]", "[]", "has 100 bytes, and its shape [] takes 2"},
      {"[0,100]", "[0]", "data_offsets that are not two offsets"},
      {"[0,100]", "[-100,0]", "data_offsets that are not two offsets"},
      {"[0,100]", "[0.0,100]", "data_offsets that are not two offsets"},
      {"[0,100]", R"("0100")", "data_offsets that are not two offsets"},
      {"[0,100]", "[100,0]", "ends before it begins"},
      {"[0,100]", "[2,102]", "no tensor has the data at byte 0"},
      {"[100,104]", "[98,102]", "two of its tensors overlap at byte 98"},
      {"[100,104]", "[0,4]", "overlap"},
      {"[100,104]", "[100,18446744073709551615]", "ends at byte 18446744073709551615 of"},
      {"[100,104]", "[18446744073709551612,18446744073709551615]", "ends at byte"},
      {"[100,104]", "[100,103]", "has 3 bytes, and its shape [2] takes 4"},
      {"conv1.bias", "conv1.weight", "no tensor has the data at byte 0"},
      {"conv2.bias", "conv2.BIAS", R"("conv2.bias" is missing)"},
      {"out.weight", R"(\n\u0000)", R"("out.weight" is missing)"},
      {R"({"__meta)", R"({"\n":{"dtype":"F16","shape":[0],"data_offsets":[0,0]},"__meta)",
       R"(tensor "\n" is none of this network's)"},
      {R"({"__meta)", "{\"" + std::string(500, 'x') + R"(":1,"__meta)", "xxx…\" lacks dtype"},
  };
  for (const Case& one : cases) {
    const std::string changed = replaced(header, one.what, one.by);
    EXPECT_THAT(refusal(test::join_file(changed, data)), HasSubstr(one.message)) << one.by;
  }
  for (const unsigned bit : {20U, 31U, 32U, 62U, 63U}) {  // 2^20 itself: the length is more
    std::string bytes = test::join_file(header, data);
    bytes[bit / 8U] = static_cast<char>(bytes[bit / 8U] | static_cast<char>(1U << bit % 8U));
    EXPECT_THAT(refusal(bytes), HasSubstr("it is no safetensors file")) << bit;
  }
  EXPECT_THAT(refusal(std::string(8, '\xFF') + header), HasSubstr("18446744073709551615 bytes"));
}

TEST_F(WeightsFiles, RefusesLayersThatDoNotFitTogether) {
  const auto expect = [&](const test::Widths& widths, auto change, const std::string& message) {
    WrittenTensors tensors = test::make_weights(1, widths);
    change(tensors);
    EXPECT_THAT(refusal(file_bytes(tensors)), HasSubstr(message));
  };
  const auto reshape = [](std::size_t number, const std::vector<std::size_t>& shape) {
    return [=](WrittenTensors& tensors) {
      tensors[number].halves.resize(
          std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()));
      tensors[number].shape = shape;
    };
  };
  expect(kSmall, reshape(0, {2, 1, 3, 3}), R"("conv1.weight" has the shape [2, 1, 3, 3])");
  expect(kSmall, reshape(1, {3}), R"("conv1.bias" has the shape [3], which should be [2])");
  expect(kSmall, reshape(2, {3, 1, 3, 3}), "should be [1…4096, 2, 3, 3]");
  expect(kSmall, reshape(2, {0, 2, 3, 3}), "should be [1…4096, 2, 3, 3]");
  expect(kSmall, reshape(12, {2, 21}), "should be [1…4096, 22]");
  expect(kSmall, reshape(16, {4, 5}), "should be [1…4096, 6]");
  expect(kSmall, reshape(20, {92, 2}), "should be [93, 2]");
  expect(kSmall, reshape(20, {93, 3}), "should be [93, 2]");
  expect(
      kSmall, [](WrittenTensors& tensors) { tensors.pop_back(); }, R"("out.bias" is missing)");
  expect(
      kSmall, [](WrittenTensors& tensors) { tensors.clear(); }, R"("conv1.weight" is missing)");
  expect(
      kSmall,
      [](WrittenTensors& tensors) {
        tensors.push_back({"more", {1}, {0}});
      },
      R"("more" is none of this network's)");
  test::Widths wide = kSmall;
  wide.head1 = 4097;
  expect(
      wide, [](WrittenTensors&) {}, R"("head1.weight" has the shape [4097, 6])");
}

TEST_F(WeightsFiles, RefusesWeightsThatAreNotFinite) {
  WrittenTensors tensors = test::make_weights(1, kSmall);
  for (auto& tensor : tensors) {
    for (const std::uint16_t wrong :
         {std::uint16_t{0x7C00}, std::uint16_t{0xFC00}, std::uint16_t{0x7C01},
          std::uint16_t{0xFE00}, std::uint16_t{0x7FFF}}) {
      const std::uint16_t before = tensor.halves.back();
      tensor.halves.back() = wrong;
      EXPECT_THAT(refusal(file_bytes(tensors)),
                  HasSubstr("tensor \"" + tensor.name + "\" has a weight that is not finite, at " +
                            std::to_string(tensor.halves.size() - 1)));
      tensor.halves.back() = before;
    }
  }
}

TEST_F(WeightsFiles, RefusesWhatIsNoRegularFile) {
  EXPECT_THAT(refusal_of(folder_), HasSubstr("is a folder"));
  EXPECT_THAT(refusal_of(folder_ / "none"), HasSubstr("No such file or directory"));
  EXPECT_THAT(refusal_of(folder_ / "none" / "none"), HasSubstr("can't be opened"));
  EXPECT_THAT(refusal_of("/dev/zero"), HasSubstr("is not a regular file"));
  const auto pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal_of(pipe), HasSubstr("is not a regular file"));
  std::filesystem::create_symlink(pipe, folder_ / "link");
  EXPECT_THAT(refusal_of(folder_ / "link"), HasSubstr("is not a regular file"));
  EXPECT_THAT(refusal(""), HasSubstr("it has 0 bytes"));
  std::filesystem::resize_file(folder_ / "small.safetensors", (64ULL << 20U) + 1);  // a hole
  EXPECT_THAT(refusal_of(folder_ / "small.safetensors"), HasSubstr("more than 64 MiB"));
}

TEST_F(WeightsFiles, MutatedOnesAreRefusedOrNetworks) {
  const WrittenTensors tensors = test::make_weights(1, kSmall);
  const std::string whole = file_bytes(tensors);
  const std::size_t header = 8 + test::header_of(tensors).size();
  const std::string digits = "0123456789-[]{},:\"eE.";
  planning::Random random(7);
  const auto below = [&](std::size_t count) {
    return static_cast<std::size_t>(random.bits() % count);
  };
  int refused = 0, taken = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = whole;
    const std::size_t changes = 1 + below(4), reach = below(3) == 0 ? whole.size() : header;
    for (std::size_t k = 0; k < changes; ++k) {
      const std::size_t at = below(std::min(reach, bytes.size())), kind = below(8);
      if (kind == 0) {
        bytes.erase(at, 1 + below(3));
      } else if (kind == 1) {
        bytes.insert(at, 1, digits[below(digits.size())]);
      } else if (kind < 5 && at >= 8) {
        bytes.at(at) = digits[below(digits.size())];
      } else {
        bytes.at(at) = static_cast<char>(below(256));
      }
    }
    (refusal(bytes).empty() ? taken : refused) += 1;
  }
  EXPECT_GT(refused, 1500);
  EXPECT_GT(taken, 50);
}

}  // namespace
}  // namespace agile
