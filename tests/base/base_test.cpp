#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/output_file.hpp"
#include "base/spec_json.hpp"
#include "base/ticks.hpp"

namespace avoidbench {
namespace {

TEST(Ticks, UsualRatesAreWholeTicks) {
  for (const double rate_hz :
       {1000.0, 500.0, 250.0, 200.0, 120.0, 100.0, 90.0, 60.0, 50.0, 30.0, 24.0, 15.0}) {
    const auto period = period_ticks(rate_hz);
    ASSERT_TRUE(period.has_value()) << rate_hz;
    EXPECT_DOUBLE_EQ(seconds(*period), 1.0 / rate_hz);
  }
  EXPECT_FALSE(period_ticks(70.0).has_value());
  EXPECT_FALSE(period_ticks(0.0).has_value());
  EXPECT_FALSE(period_ticks(72001.0).has_value());
  EXPECT_EQ(ticks(0.033), 1188);
}

TEST(Digest, IsSha256) {
  const std::string text = "abc";
  EXPECT_EQ(Digest().add_bytes(std::as_bytes(std::span(text))).hex(),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Digest, OfAloneIsThatOfSha256sum) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

/// RFC 4231, cases 1 to 3 and 6 (a key longer than a block).
TEST(Digest, HmacIsThatOfTheStandard) {
  EXPECT_EQ(hmac_sha256(std::string(20, '\x0b'), "Hi There"),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hmac_sha256("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hmac_sha256(std::string(20, '\xaa'), std::string(50, '\xdd')),
            "773ea91e36800e46854db8ebd09181a72959098b3ef8c122d9635514ced565fe");
  EXPECT_EQ(hmac_sha256(std::string(131, '\xaa'),
                        "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

TEST(Digest, KeepsNeighboursApart) {
  EXPECT_NE(Digest().add("ab").add("c").hex(), Digest().add("a").add("bc").hex());
  EXPECT_NE(Digest().add(0.0).hex(), Digest().add(-0.0).hex());
}

TEST(Digest, OfAFileIsThatOfItsBytes) {
  const auto path =
      std::filesystem::temp_directory_path() / ("digest_" + std::to_string(::getpid()));
  std::ofstream(path) << "abc";
  EXPECT_EQ(file_digest(path), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  std::filesystem::remove(path);
  EXPECT_THROW(file_digest(path), InputError);
}

TEST(SafeFileName, IsNeverAPath) {
  EXPECT_EQ(safe_file_name("dense_forest-2.v1"), "dense_forest-2.v1");
  EXPECT_EQ(safe_file_name("../../x"), "_._.._x-9cdf6a50");
  for (const std::string& bad :
       {std::string(""), std::string("."), std::string(".."), std::string("/etc/x"),
        std::string("a/b"), std::string("-rf"), std::string(".hidden"), std::string("a\0b", 3),
        std::string("\n"), std::string("\x1b[2J"), std::string("ü"), std::string(300, 'a')}) {
    const std::string name = safe_file_name(bad);
    EXPECT_NE(name, bad);
    EXPECT_LE(name.size(), 100U);
    EXPECT_EQ(name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                     "0123456789_.-"),
              std::string::npos)
        << name;
    EXPECT_NE(name.front(), '.');
    EXPECT_EQ(std::filesystem::path("folder") / name,
              (std::filesystem::path("folder") / name).lexically_normal());
  }
  EXPECT_NE(safe_file_name("a/b"), safe_file_name("a:b"));
  EXPECT_NE(safe_file_name(std::string(300, 'a')), safe_file_name(std::string(301, 'a')));
}

TEST(InputError, NamesEveryPlace) {
  const InputError error({{"a.yaml", 3, 14, "bad"}, {"a.yaml", 0, 0, "worse"}});
  EXPECT_STREQ(error.what(), "a.yaml:3:14: bad\na.yaml: worse");
}

TEST(NearestWord, FindsSlipsAndNothingElse) {
  const std::vector<std::string> words{"fov_x_deg", "poisson_radius_m", "rate_hz", "seed"};
  EXPECT_EQ(nearest_word("fov_deg", words), "fov_x_deg");
  EXPECT_EQ(nearest_word("poison_radius_m", words), "poisson_radius_m");
  EXPECT_EQ(nearest_word("sede", words), "seed");
  EXPECT_EQ(nearest_word("poisson_radius", words), "poisson_radius_m");
  EXPECT_EQ(nearest_word("colour", words), "");
  // Far by letters, but a beginning, or words that are left out.
  EXPECT_EQ(nearest_word("poi", words), "poisson_radius_m");
  EXPECT_EQ(nearest_word("po", words), "");
  EXPECT_EQ(nearest_word("radius", words), "poisson_radius_m");
  EXPECT_EQ(nearest_word("radius_m_x", words), "");
  EXPECT_EQ(did_you_mean("rate_h", words), " (did you mean rate_hz?)");
}

enum class Colour { red, green };
struct Inner {
  double width_m = 1.5;
  Colour colour = Colour::green;
};
struct Round {
  static constexpr std::string_view kind = "round";
  double radius_m = 2.0;
};
struct Square {
  static constexpr std::string_view kind = "square";
  std::array<double, 2> side_m{0.1, 1.0 / 3.0};
};
struct Outer {
  std::uint64_t seed = 0xffffffffffffffffULL;
  std::string name = "x";
  bool is_on = true;
  std::vector<Inner> inner{{}, {}};
  std::variant<Round, Square> shape = Square{};
};
template <class V, ConstOr<Inner> Spec>
void visit(V& v, Spec& s) {
  v.field("width_m", s.width_m, Range{0, 5}, "Width.");
  v.field("colour", s.colour, "Colour.");
}
template <class V, ConstOr<Round> Spec>
void visit(V& v, Spec& s) {
  v.field("radius_m", s.radius_m, "Radius.");
}
template <class V, ConstOr<Square> Spec>
void visit(V& v, Spec& s) {
  v.field("side_m", s.side_m, "Sides.");
}
template <class V, ConstOr<Outer> Spec>
void visit(V& v, Spec& s) {
  v.field("seed", s.seed, "Seed.");
  v.field("name", s.name, "Name.");
  v.field("is_on", s.is_on, "On.");
  v.field("inner", s.inner, "Parts.");
  v.variant("shape", s.shape, "Shape.");
}

}  // namespace

template <>
struct EnumText<Colour> {
  static constexpr std::pair<Colour, std::string_view> entries[] = {{Colour::red, "red"},
                                                                    {Colour::green, "green"}};
};

namespace {

TEST(SpecJson, RoundTripsEveryKindOfField) {
  Outer spec;
  spec.inner[1].colour = Colour::red;
  spec.inner[1].width_m = 0.1 + 0.2;
  const nlohmann::json json = spec_to_json(spec);
  EXPECT_EQ(json["shape"], "square");
  EXPECT_EQ(json["inner"][1]["colour"], "red");
  const Outer back = spec_from_json<Outer>(nlohmann::json::parse(json.dump()));
  EXPECT_EQ(spec_to_json(back).dump(), json.dump());
  EXPECT_EQ(back.seed, spec.seed);
  EXPECT_EQ(back.inner[1].width_m, spec.inner[1].width_m);
  EXPECT_EQ(std::get<Square>(back.shape).side_m[1], 1.0 / 3.0);
}

}  // namespace
}  // namespace avoidbench
