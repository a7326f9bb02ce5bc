#include "yaml/yaml_tree.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/random.hpp"
#include "support/input_error_message.hpp"
#include "support/mutated.hpp"

namespace avoidbench {
namespace {

std::string parse_problems(const std::string& text) {
  return test::message_of([&] { parse_yaml(text, "f.yaml"); });
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
  EXPECT_NE(parse_problems("a: x: y\n").find("f.yaml:1:5: not valid YAML: "), std::string::npos);
  EXPECT_EQ(parse_problems("a: 1\n b: 2\n").substr(0, 8), "f.yaml:2");
  EXPECT_EQ(parse_problems("a: *nothing\n").substr(0, 12), "f.yaml:1:4: ");
}

TEST(YamlTree, SyntaxErrorsSayWhatTheyAre) {
  const std::string start = "not valid YAML: ";
  EXPECT_EQ(parse_problems("a: [1, 2\nb: 3\n"),
            "f.yaml:1:4: " + start + "'[' is never closed by ']'");
  EXPECT_EQ(parse_problems("a: 1\nb: {c: [1, 2], d: é\n"),
            "f.yaml:2:4: " + start + "'{' is never closed by '}'");
  EXPECT_EQ(parse_problems("a: é[, {b: [1, 2}]\n").find("f.yaml:1:"), 0U);
  EXPECT_EQ(parse_problems("a: [1, {b: 2]}\n"),
            "f.yaml:1:13: " + start + "']' where '}' is expected for the '{' of line 1, column 8");
  EXPECT_EQ(parse_problems("a:\n\tb: 1\n"),
            "f.yaml:2:1: " + start + "a tab indents this line; YAML allows only spaces");
  EXPECT_EQ(parse_problems("a: 1\nb: [2, \"no end]\nc: 2\n"),
            "f.yaml:2:8: " + start + "the quote \" is never closed");
  EXPECT_EQ(parse_problems("a: &x [1\n"), "f.yaml:1:7: " + start + "'[' is never closed by ']'");
  // What quotes, comments and plain words hold is no bracket.
  EXPECT_EQ(parse_problems("a: 'it''s [' # {\nb: x[1\nc: \"\\\"[\"\nd: 1\n e: 2\n").find("bracket"),
            std::string::npos);
  EXPECT_EQ(parse_problems("a: 'it''s [' # {\nb: x[1\nc: \"\\\"[\"\nd: 1\n e: 2\n").find("never"),
            std::string::npos);
}

TEST(YamlTree, TakesUtf8Only) {
  EXPECT_EQ(parse_problems("a: 1\nb: \"é M\xfcller\"\n"),
            "f.yaml:2:8: byte 0xfc is not UTF-8, ü in Latin-1: save the file as UTF-8");
  EXPECT_EQ(parse_problems("a: \xc3"),
            "f.yaml:1:4: byte 0xc3 is not UTF-8, Ã in Latin-1: save the "
            "file as UTF-8");
  EXPECT_EQ(parse_problems("\xff\xfe"
                           "a"),
            "f.yaml:1:1: byte 0xff is not UTF-8, ÿ in Latin-1: save the file as UTF-8");
  EXPECT_EQ(parse_yaml("a: é–😀\n", "f.yaml").find("a")->scalar, "é–😀");
}

TEST(YamlTree, MergeKeysPutMappingsIn) {
  const YamlNode root = parse_yaml(
      "a: &a {n: 1, m: 2}\nb: &b {n: 3, k: 4}\nc: {<<: *a, m: 5}\nd: {<<: [*a, *b]}\n"
      "e: {\"<<\": 6}\n",
      "f.yaml");
  const auto value = [&](const char* block, const char* key) {
    return root.find(block)->find(key)->scalar;
  };
  EXPECT_EQ(value("c", "n"), "1");
  EXPECT_EQ(value("c", "m"), "5");  // what stands there itself wins
  EXPECT_EQ(root.find("c")->find("<<"), nullptr);
  EXPECT_EQ(root.find("c")->find("n")->line, 1);
  EXPECT_EQ(value("d", "n"), "1");  // the first of several
  EXPECT_EQ(value("d", "k"), "4");
  EXPECT_EQ(root.find("c")->keys.size(), 2U);  // none twice
  EXPECT_EQ(root.find("d")->keys.size(), 3U);
  EXPECT_EQ(root.find("d")->items.size(), 3U);
  EXPECT_EQ(value("e", "<<"), "6");  // in quotes a key as any other
  EXPECT_EQ(parse_problems("a: {<<: 3}\n"),
            "f.yaml:1:9: <<: expected a mapping, as in `<<: *anchor`, found \"3\"");
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
  EXPECT_EQ(parse_problems("a: &a [*a]\n"), "f.yaml:1:8: an alias within its own anchor");
}

TEST(YamlTree, UnreadableFiles) {
  EXPECT_EQ(test::message_of([] { read_yaml("/nowhere/f.yaml"); }),
            "/nowhere/f.yaml: no such file");
  EXPECT_EQ(test::message_of([] { read_yaml("/tmp"); }), "/tmp: is a folder, not a file");
  EXPECT_EQ(test::message_of([] { read_yaml("/dev/zero"); }),
            "/dev/zero: is a device, not a regular file: write its output to a file first");
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
    try {
      parse_yaml(test::mutated(good, 6, special, random), "f.yaml");
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
