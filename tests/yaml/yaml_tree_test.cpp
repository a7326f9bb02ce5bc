#include "yaml/yaml_tree.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/random.hpp"
#include "support/problems.hpp"

namespace avoidbench {
namespace {

std::string parse_problems(const std::string& text) {
  return problems_of([&] { parse_yaml(text, "f.yaml"); });
}

TEST(YamlTree, KeepsTextKindsAndPlaces) {
  const YamlNode root = parse_yaml("a: 1\nb:\n  - x\n  - \"2\"\nc: {d: ~}\n", "f.yaml");
  ASSERT_EQ(root.kind, YamlNode::Kind::mapping);
  ASSERT_EQ(root.items.size(), 3U);
  EXPECT_EQ(root.find("a")->scalar, "1");
  EXPECT_EQ(root.find("a")->line, 1);
  EXPECT_EQ(root.find("a")->column, 4);
  const YamlNode& list = *root.find("b");
  ASSERT_EQ(list.kind, YamlNode::Kind::list);
  EXPECT_EQ(list.items[1].line, 4);
  EXPECT_EQ(list.items[1].column, 5);
  EXPECT_FALSE(list.items[0].is_quoted);
  EXPECT_TRUE(list.items[1].is_quoted);
  EXPECT_EQ(root.find("c")->find("d")->kind, YamlNode::Kind::null);
  EXPECT_EQ(root.find("e"), nullptr);
}

TEST(YamlTree, ExpandsAliasesAtTheirOwnPlace) {
  const YamlNode root = parse_yaml("a: &x {n: 3}\nb: *x\n", "f.yaml");
  EXPECT_EQ(root.find("b")->find("n")->scalar, "3");
  EXPECT_EQ(root.find("b")->line, 2);
}

TEST(YamlTree, SyntaxErrorsHaveAPlace) {
  EXPECT_EQ(parse_problems("a: [1, 2\nb: 3\n").substr(0, 12), "f.yaml:2:2: ");
  EXPECT_NE(parse_problems("a: [1, 2\nb: 3\n").find("not valid YAML: "), std::string::npos);
  EXPECT_EQ(parse_problems("a: 1\n b: 2\n").substr(0, 8), "f.yaml:2");
  EXPECT_EQ(parse_problems("a: *nothing\n").substr(0, 12), "f.yaml:1:4: ");
}

TEST(YamlTree, RefusesWhatHasTwoMeanings) {
  EXPECT_EQ(parse_problems("a: 1\nb: 2\na: 3\n"),
            "f.yaml:3:1: a: this key is given twice, first in line 1");
  EXPECT_EQ(parse_problems("[1, 2]: 3\n"), "f.yaml:1:1: a key must be text, found a list");
  EXPECT_EQ(parse_problems("a: 1\n---\nb: 2\n"), "f.yaml:3:1: a second document; one is expected");
  EXPECT_EQ(parse_problems(""), "f.yaml: the document is empty");
  EXPECT_EQ(parse_problems("# nothing\n"), "f.yaml: the document is empty");
}

TEST(YamlTree, RefusesWhatIsTooDeepOrTooLarge) {
  EXPECT_EQ(parse_problems(std::string(65, '[') + std::string(65, ']')),
            "f.yaml:1:65: nested deeper than 64 levels");
  EXPECT_NE(parse_problems(std::string(100000, '[')), "");
  EXPECT_NE(parse_problems(std::string(100000, '{')), "");
  std::string laughs = "a0: &a0 [ha, ha, ha, ha, ha, ha, ha, ha, ha, ha]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string name = "a" + std::to_string(i), last = "*a" + std::to_string(i - 1);
    laughs += name + ": &" + name + " [" + last;
    for (int k = 0; k < 9; ++k) laughs += ", " + last;
    laughs += "]\n";
  }
  EXPECT_NE(parse_problems(laughs).find("more than 100000 values, aliases expanded"),
            std::string::npos);
  // 2 MB of text that few aliases would make 100 GB.
  std::string long_text = "a: &a " + std::string(2'000'000, 'x') + "\nb: [*a";
  for (int i = 0; i < 49'000; ++i) long_text += ", *a";
  EXPECT_NE(parse_problems(long_text + "]\n").find("more than 20 MB of text, aliases expanded"),
            std::string::npos);
  EXPECT_EQ(parse_problems("a: &a [*a]\n"), "f.yaml:1:8: an alias within what it stands for");
}

TEST(YamlTree, UnreadableFiles) {
  EXPECT_EQ(problems_of([] { read_yaml("/nowhere/f.yaml"); }), "/nowhere/f.yaml: no such file");
  EXPECT_EQ(problems_of([] { read_yaml("/tmp"); }), "/tmp: is a folder, not a file");
  EXPECT_EQ(problems_of([] { read_yaml("/dev/zero"); }),
            "/dev/zero: is a device, not a regular file: write what it gives to a file first");
}

/// Bytes of a good document changed, removed, repeated at random: an answer or an InputError,
/// nothing else.
TEST(YamlTree, MutatedDocumentsNeverCrash) {
  const std::string good =
      "sweep: forest  # name\nmaps: {generator: forest, area_m: [40, 40]}\naxes:\n  \"wind.mean\": "
      "[0, 4]\n"
      "list:\n- &x {a: 1}\n- *x\n- |\n  block\n- >-\n  folded\n- ! tag\n- 'single'\n? key\n: "
      "value\n";
  const std::string special =
      "{}[],:&*!|>'\"%@`#?- \n\t~\\\0\xff\xc3"
      "a0";
  RandomStream random = stream(1, "yaml mutations");
  int accepted = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = good;
    const std::uint64_t changes = 1 + random.below(6);
    for (std::uint64_t i = 0; i < changes && !text.empty(); ++i) {
      const std::size_t place = random.below(text.size());
      const std::uint64_t what = random.below(4);
      const std::size_t length = 1 + random.below(8);
      if (what == 0) text[place] = special[random.below(special.size())];
      if (what == 1) text.erase(place, length);
      if (what == 2) text.insert(place, text.substr(place, length));
      if (what == 3) text.insert(place, 1, special[random.below(special.size())]);
    }
    try {
      parse_yaml(text, "f.yaml");
      ++accepted;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace avoidbench
