#include "config/field_reader.hpp"

#include <gtest/gtest.h>

#include <clocale>

#include "support/input_error_message.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace sample {

enum class Color { red, green };

struct Lens {
  double focal_m = 0.05;
  std::array<double, 3> offset_m{1.0, 2.0, 3.0};
};
struct Round {
  static constexpr std::string_view kind = "round";
  double radius_m = 1.0;
};
struct Square {
  static constexpr std::string_view kind = "square";
  double side_m = 2.0;
};
struct Camera {
  double fov_x_deg = 90.0;
  std::int64_t width_px = 320;
  std::uint64_t seed = 1;
  bool is_on = true;
  std::string name = "eye";
  Color color = Color::red;
  Lens lens;
  std::vector<Lens> spares;
  std::variant<Round, Square> shape;
};

template <class Visitor, ConstOr<Lens> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("focal_m", s.focal_m, Range{0.01, 1}, "Focal length.");
  v.field("offset_m", s.offset_m, Range{-5, 5}, "Offset.");
}
template <class Visitor, ConstOr<Round> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("radius_m", s.radius_m, Range{0, 10}, "Radius.");
}
template <class Visitor, ConstOr<Square> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("side_m", s.side_m, Range{0, 10}, "Side.");
}
template <class Visitor, ConstOr<std::variant<Round, Square>> Spec>
void visit(Visitor& v, Spec& s) {
  v.variant("outline", s, "Outline.");
}
template <class Visitor, ConstOr<Camera> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("fov_x_deg", s.fov_x_deg, Range{10, 170}, "Field of view.");
  v.field("width_px", s.width_px, Range{8, 4096}, "Width.");
  v.field("seed", s.seed, "Seed.");
  v.field("is_on", s.is_on, "On.");
  v.field("name", s.name, "Name.");
  v.field("color", s.color, "Color.");
  v.field("lens", s.lens, "Lens.");
  v.field("spares", s.spares, "Spare lenses.");
  v.variant("outline", s.shape, "Outline.");
}

}  // namespace sample

template <>
struct EnumText<sample::Color> {
  static constexpr std::pair<sample::Color, std::string_view> entries[] = {
      {sample::Color::red, "red"}, {sample::Color::green, "green"}};
};

namespace {

using sample::Camera;

void read_camera(const std::string& text, const std::string& path, Camera& camera,
                 Reading& reading) {
  nlohmann::json value = spec_to_json(camera);
  read_block({parse_yaml(text, "f.yaml"), path, reading}, field_tree("", camera, ""), value);
  camera = spec_from_json<Camera>(value);
}

Camera read_ok(const std::string& text) {
  Camera camera;
  Reading reading;
  read_camera(text, "sensor", camera, reading);
  EXPECT_EQ(test::joined(reading.problems), "") << text;
  return camera;
}

std::string problems(const std::string& text) {
  Camera camera;
  Reading reading;
  read_camera(text, "sensor", camera, reading);
  return test::joined(reading.problems);
}

TEST(YamlReader, ReadsEveryType) {
  const Camera camera = read_ok(
      "fov_x_deg: 75.5\nwidth_px: 64\nseed: 18446744073709551615\nis_on: false\nname: \"12\"\n"
      "color: green\nlens: {focal_m: 1e-1, offset_m: [-1, 0, +2.5]}\n"
      "spares: [{focal_m: 0.2}, {}]\noutline: square\nside_m: 3\n");
  EXPECT_EQ(camera.fov_x_deg, 75.5);
  EXPECT_EQ(camera.width_px, 64);
  EXPECT_EQ(camera.seed, 18446744073709551615U);
  EXPECT_FALSE(camera.is_on);
  EXPECT_EQ(camera.name, "12");
  EXPECT_EQ(camera.color, sample::Color::green);
  EXPECT_EQ(camera.lens.focal_m, 0.1);
  EXPECT_EQ(camera.lens.offset_m, (std::array<double, 3>{-1.0, 0.0, 2.5}));
  ASSERT_EQ(camera.spares.size(), 2U);
  EXPECT_EQ(camera.spares[0].focal_m, 0.2);
  EXPECT_EQ(camera.spares[1].focal_m, 0.05);
  EXPECT_EQ(std::get<sample::Square>(camera.shape).side_m, 3.0);
}

TEST(YamlReader, KeysNotGivenKeepTheirValues) {
  Camera camera;
  camera.fov_x_deg = 33.0;
  camera.shape = sample::Square{4.0};
  Reading reading;
  read_camera("width_px: 16\nside_m: 5\n", "", camera, reading);
  EXPECT_TRUE(reading.problems.empty());
  EXPECT_EQ(camera.fov_x_deg, 33.0);
  EXPECT_EQ(std::get<sample::Square>(camera.shape).side_m, 5.0);
}

TEST(YamlReader, WholeNumbersMayBeWrittenWithAPointOrExponent) {
  EXPECT_EQ(read_ok("width_px: 1e3").width_px, 1000);
  EXPECT_EQ(read_ok("width_px: 64.0").width_px, 64);
}

TEST(YamlReader, EachProblemHasItsPlaceAndReason) {
  const std::pair<const char*, const char*> cases[] = {
      {"fov_x_deg: 190", "f.yaml:1:12: sensor.fov_x_deg: 190 is outside [10, 170]"},
      {"fov_x_deg: wide", "f.yaml:1:12: sensor.fov_x_deg: expected a number, found \"wide\""},
      {"fov_x_deg: \"90\"", "f.yaml:1:12: sensor.fov_x_deg: expected a number, found \"90\""},
      {"fov_x_deg:", "f.yaml:1:1: sensor.fov_x_deg: expected a number, found nothing"},
      {"fov_x_deg: [90]", "f.yaml:1:12: sensor.fov_x_deg: expected a number, found a list"},
      {"fov_x_deg: {a: 1}", "f.yaml:1:12: sensor.fov_x_deg: expected a number, found a mapping"},
      {"fov_x_deg: 90deg", "f.yaml:1:12: sensor.fov_x_deg: expected a number, found \"90deg\""},
      {"fov_x_deg: 0x5A", "f.yaml:1:12: sensor.fov_x_deg: expected a number, found \"0x5A\""},
      {"fov_x_deg: 90,5", "f.yaml:1:12: sensor.fov_x_deg: expected a number, found \"90,5\""},
      {"fov_x_deg: nan", "f.yaml:1:12: sensor.fov_x_deg: expected a finite number, found \"nan\""},
      {"fov_x_deg: .nan",
       "f.yaml:1:12: sensor.fov_x_deg: expected a finite number, found \".nan\""},
      {"fov_x_deg: -.inf",
       "f.yaml:1:12: sensor.fov_x_deg: expected a finite number, found \"-.inf\""},
      {"fov_x_deg: inf", "f.yaml:1:12: sensor.fov_x_deg: expected a finite number, found \"inf\""},
      {"fov_x_deg: 1e999", "f.yaml:1:12: sensor.fov_x_deg: 1e999 is too large or too small"},
      {"width_px: 64.5", "f.yaml:1:11: sensor.width_px: expected a whole number, found \"64.5\""},
      {"width_px: 4", "f.yaml:1:11: sensor.width_px: 4 is outside [8, 4096]"},
      {"width_px: 99999999999999999999",
       "f.yaml:1:11: sensor.width_px: 99999999999999999999 is too large"},
      {"seed: -1", "f.yaml:1:7: sensor.seed: -1 is below 0"},
      {"is_on: yes", "f.yaml:1:8: sensor.is_on: expected true or false, found \"yes\""},
      {"name: [a]", "f.yaml:1:7: sensor.name: expected text, found a list"},
      {"color: gren",
       "f.yaml:1:8: sensor.color: \"gren\" is not one of red, green (did you mean green?)"},
      {"color: [red]", "f.yaml:1:8: sensor.color: expected one of red, green, found a list"},
      {"lens: 5", "f.yaml:1:7: sensor.lens: expected a mapping (name: value), found \"5\""},
      {"lens: {focal_m: 2}", "f.yaml:1:17: sensor.lens.focal_m: 2 is outside [0.01, 1]"},
      {"lens: {offset_m: [1, 2]}",
       "f.yaml:1:18: sensor.lens.offset_m: expected a list of 3 values, found 2"},
      {"lens: {offset_m: 1}",
       "f.yaml:1:18: sensor.lens.offset_m: expected a list of 3 values, found \"1\""},
      {"lens: {offset_m: [1, 2, 9]}", "f.yaml:1:25: sensor.lens.offset_m[2]: 9 is outside [-5, 5]"},
      {"spares: [{}, {focal: 1}]",
       "f.yaml:1:15: sensor.spares[1].focal: unknown key (did you mean focal_m?)"},
      {"spares: {}", "f.yaml:1:9: sensor.spares: expected a list, found a mapping"},
      {"fov_deg: 90",
       "f.yaml:1:1: sensor.fov_deg: unknown key for outline round (did you mean fov_x_deg?)"},
      {"lens: {zebra: 1}", "f.yaml:1:8: sensor.lens.zebra: unknown key (known: focal_m, offset_m)"},
      {"outline: sqare",
       "f.yaml:1:10: sensor.outline: \"sqare\" is not one of round, square (did you mean square?)"},
      {"outline: square\nradius_m: 1",
       "f.yaml:2:1: sensor.radius_m: unknown key for outline square (a key of outline round)"},
      {"- 1", "f.yaml:1:1: sensor: expected a mapping (name: value), found a list"},
  };
  for (const auto& [text, expected] : cases) {
    // What is known is listed after some messages; the beginning is what matters here.
    EXPECT_EQ(problems(text).substr(0, std::string(expected).size()), expected) << text;
    EXPECT_EQ(problems(text).find('\n'), std::string::npos) << text;
  }
}

TEST(YamlReader, AllProblemsAtOnce) {
  EXPECT_EQ(problems("fov_x_deg: 190\nwidth_px: x\nlens:\n  focal_m: 7\n"),
            "f.yaml:1:12: sensor.fov_x_deg: 190 is outside [10, 170]\n"
            "f.yaml:2:11: sensor.width_px: expected a whole number, found \"x\"\n"
            "f.yaml:4:12: sensor.lens.focal_m: 7 is outside [0.01, 1]");
}

TEST(YamlReader, NumbersDoNotDependOnTheLocale) {
  const char* const before = std::setlocale(LC_ALL, nullptr);
  const std::string saved = before != nullptr ? before : "C";
  for (const char* locale : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, locale) != nullptr) break;
  }
  EXPECT_EQ(read_ok("fov_x_deg: 75.5").fov_x_deg, 75.5);
  EXPECT_EQ(number_text(75.5), "75.5");
  std::setlocale(LC_ALL, saved.c_str());
}

TEST(YamlReader, ListsAndRangesAreAxesWhereAskedFor) {
  Camera camera;
  Reading reading;
  reading.lists_are_axes = true;
  read_camera(
      "fov_x_deg: {from: 60, to: 90, count: 4}\nwidth_px: [16, 32]\n"
      "lens: {focal_m: {from: 0.1, to: 0.5, step: 0.2}, offset_m: [[0, 0, 0], [1, 1, 1]]}\n",
      "s", camera, reading);
  ASSERT_EQ(test::joined(reading.problems), "");
  ASSERT_EQ(reading.axes.size(), 4U);
  EXPECT_EQ(reading.axes[0].path, "s.fov_x_deg");
  EXPECT_EQ(nlohmann::json(reading.axes[0].values).dump(), "[60.0,70.0,80.0,90.0]");
  EXPECT_EQ(nlohmann::json(reading.axes[1].values).dump(), "[16,32]");
  EXPECT_EQ(nlohmann::json(reading.axes[2].values).dump(), "[0.1,0.3,0.5]");
  EXPECT_EQ(reading.axes[2].path, "s.lens.focal_m");
  EXPECT_EQ(nlohmann::json(reading.axes[3].values).dump(), "[[0.0,0.0,0.0],[1.0,1.0,1.0]]");
  EXPECT_EQ(camera.fov_x_deg, 60.0);  // the first value of each
  EXPECT_EQ(camera.width_px, 16);
}

TEST(YamlReader, ProblemsOfAxes) {
  const std::pair<const char*, const char*> cases[] = {
      {"fov_x_deg: []",
       "f.yaml:1:12: s.fov_x_deg: expected at least one value, found an empty list"},
      {"fov_x_deg: [60, 200]", "f.yaml:1:17: s.fov_x_deg: 200 is outside [10, 170]"},
      {"fov_x_deg: [60, 60.0]", "f.yaml:1:17: s.fov_x_deg: 60.0 is given twice"},
      {"fov_x_deg: {from: 60, to: 90}",
       "f.yaml:1:12: s.fov_x_deg: a range has either 'count' or 'step'"},
      {"fov_x_deg: {from: 60, count: 3}", "f.yaml:1:12: s.fov_x_deg: the range lacks 'to'"},
      {"fov_x_deg: {from: 60, to: 90, count: 1}",
       "f.yaml:1:38: s.fov_x_deg.count: expected a whole number of at least 2, found 1"},
      {"fov_x_deg: {from: 60, to: 90, step: -1}",
       "f.yaml:1:37: s.fov_x_deg.step: leads away from 'to'"},
      {"fov_x_deg: {from: 60, to: 90, step: 0}", "f.yaml:1:37: s.fov_x_deg.step: must not be 0"},
      {"fov_x_deg: {from: 60, to: 60, step: 0}", "f.yaml:1:37: s.fov_x_deg.step: must not be 0"},
      {"fov_x_deg: {from: 60, to: 90, step: 0.001}",
       "f.yaml:1:12: s.fov_x_deg: the range has more than 10000 values"},
      {"fov_x_deg: {from: 60, till: 90, count: 3}",
       "f.yaml:1:23: s.fov_x_deg.till: unknown key of a range; a range is {from, to, count} or "
       "{from, to, step}"},
      {"width_px: {from: 8, to: 9, count: 3}",
       "f.yaml:1:11: s.width_px: expected a whole number, found \"8.5\""},
  };
  for (const auto& [text, expected] : cases) {
    Camera camera;
    Reading reading;
    reading.lists_are_axes = true;
    read_camera(text, "s", camera, reading);
    EXPECT_EQ(test::joined(reading.problems), expected) << text;
  }
}

TEST(NumberText, ReadsBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3.0, 8.54858e-6, 1e-12, 36000.0, 1e22, -2.5, 0.0}) {
    YamlNode node;
    node.kind = YamlNode::Kind::scalar;
    node.scalar = number_text(value);
    EXPECT_EQ(number_of(node), value);
  }
  EXPECT_EQ(number_text(100000.0), "100000");
  EXPECT_EQ(number_text(0.001), "0.001");
}

}  // namespace
}  // namespace avoidbench
