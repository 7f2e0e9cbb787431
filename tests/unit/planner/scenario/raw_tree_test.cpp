#include "planner/scenario/detail/raw_tree.hpp"

#include <gtest/gtest.h>

namespace swallowtail::planner::detail {
namespace {

TEST(RawTree, KeepsLinesKeysAndOrder) {
  const RawTree tree = parse_raw_tree("a: 1\nb:\n  - x\n  - \"y\"\nc: {d: [2, 3], e: ~}\n");
  ASSERT_TRUE(tree.ok) << tree.error;
  ASSERT_EQ(tree.root.keys, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(tree.root.key_lines, (std::vector<int>{1, 2, 5}));
  EXPECT_EQ(tree.root.items[1].items[1].line, 4);
  EXPECT_TRUE(tree.root.items[1].items[1].quoted);
  EXPECT_FALSE(tree.root.items[1].items[0].quoted);
  EXPECT_EQ(tree.root.items[2].items[1].kind, RawNode::Kind::kNull);
}

TEST(RawTree, KeepsAKeyThatStandsTwice) {
  const RawTree tree = parse_raw_tree("a: 1\na: 2\n");
  ASSERT_TRUE(tree.ok);
  EXPECT_EQ(tree.root.keys.size(), 2u);
}

TEST(RawTree, SaysOnWhichLineTheTextIsNoYaml) {
  const RawTree tree = parse_raw_tree("a: 1\nb: [1, 2\nc: 3\n");
  EXPECT_FALSE(tree.ok);
  EXPECT_GE(tree.error_line, 2);
  EXPECT_FALSE(tree.error.empty());
}

TEST(RawTree, RefusesEmptyAndBinaryText) {
  EXPECT_FALSE(parse_raw_tree("").ok);
  EXPECT_FALSE(parse_raw_tree(std::string("a: \0b", 5)).ok);
}

TEST(RawTree, RefusesDeepNestingInsteadOfRunningOutOfStack) {
  EXPECT_FALSE(parse_raw_tree(std::string(40, '[') + std::string(40, ']')).ok);
  EXPECT_FALSE(parse_raw_tree(std::string(100'000, '[')).ok);
  EXPECT_FALSE(parse_raw_tree(std::string(100'000, '{')).ok);
  EXPECT_TRUE(parse_raw_tree(std::string(20, '[') + std::string(20, ']')).ok);
}

TEST(RawTree, RefusesManyNodes) {
  std::string text = "[";
  for (int i = 0; i < 200'001; ++i) text += "1,";
  EXPECT_FALSE(parse_raw_tree(text + "]").ok);
}

TEST(RawTree, RefusesAMapAsKey) { EXPECT_FALSE(parse_raw_tree("{{a: 1}: 2}").ok); }

TEST(RawTree, ShowsValuesShortenedOnOneLine) {
  const RawTree tree = parse_raw_tree("[\"a\\nb\", " + std::string(100, 'z') + ", [1], {}, ~]");
  ASSERT_TRUE(tree.ok) << tree.error;
  EXPECT_EQ(shown(tree.root.items[0]), "\"a b\"");
  EXPECT_EQ(shown(tree.root.items[1]).size(), 60u + std::string("…").size());
  EXPECT_EQ(shown(tree.root.items[2]), "(a list of 1)");
  EXPECT_EQ(shown(tree.root.items[3]), "(a map)");
  EXPECT_EQ(shown(tree.root.items[4]), "(nothing)");
}

}  // namespace
}  // namespace swallowtail::planner::detail
