#include "planner/scenario/detail/raw_tree.hpp"

#include <sstream>
#include <stdexcept>
#include <utility>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

namespace swallowtail::planner::detail {
namespace {

constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxNodes = 200'000;
constexpr std::size_t kMaxShown = 60;

struct Refused : std::runtime_error {
  Refused(const YAML::Mark& mark, const char* rule) : std::runtime_error(rule), line(mark.line + 1) {}
  int line;
};

/// Builds the tree from yaml-cpp's events, which carry the marks that its nodes lose.
class Builder final : public YAML::EventHandler {
 public:
  RawNode root;
  int documents = 0;

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents > 1) throw Refused(mark, "must be one YAML document");
  }
  void OnDocumentEnd() override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw Refused(mark, "aliases are not allowed");
  }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(make(RawNode::Kind::kNull, mark, "", anchor), mark);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    RawNode node = make(RawNode::Kind::kScalar, mark, tag, anchor);
    node.quoted = tag == "!";
    node.scalar = value;
    add(std::move(node), mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(make(RawNode::Kind::kList, mark, tag, anchor), mark);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(make(RawNode::Kind::kMap, mark, tag, anchor), mark);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    RawNode node;
    bool has_key = false;  // of a map: the next node is a value
  };

  RawNode make(RawNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != 0) throw Refused(mark, "anchors are not allowed");
    if (!tag.empty() && tag != "?" && tag != "!") throw Refused(mark, "tags are not allowed");
    if (++nodes_ > kMaxNodes) throw Refused(mark, "has too many values");
    RawNode node;
    node.kind = kind;
    node.line = mark.line + 1;
    return node;
  }

  void open(RawNode node, const YAML::Mark& mark) {
    if (!stack_.empty() && stack_.back().node.kind == RawNode::Kind::kMap && !stack_.back().has_key) {
      throw Refused(mark, "a key must be a word");
    }
    if (stack_.size() >= kMaxDepth) throw Refused(mark, "is nested too deeply");
    stack_.push_back({std::move(node)});
  }

  void close() {
    RawNode node = std::move(stack_.back().node);
    stack_.pop_back();
    place(std::move(node));
  }

  void add(RawNode node, const YAML::Mark& mark) {
    if (!stack_.empty() && stack_.back().node.kind == RawNode::Kind::kMap && !stack_.back().has_key) {
      if (node.kind == RawNode::Kind::kNull) throw Refused(mark, "a key must be a word");
      stack_.back().node.keys.push_back(std::move(node.scalar));
      stack_.back().node.key_lines.push_back(node.line);
      stack_.back().has_key = true;
      return;
    }
    place(std::move(node));
  }

  void place(RawNode node) {
    if (stack_.empty()) {
      root = std::move(node);
      return;
    }
    stack_.back().has_key = false;
    stack_.back().node.items.push_back(std::move(node));
  }

  std::vector<Open> stack_;
  std::size_t nodes_ = 0;
};

RawTree failure(int line, std::string rule) {
  RawTree tree;
  tree.ok = false;
  tree.error_line = line;
  tree.error = std::move(rule);
  return tree;
}

}  // namespace

RawTree parse_raw_tree(const std::string& text) {
  if (text.find('\0') != std::string::npos) return failure(1, "must be text");
  Builder builder;
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const Refused& e) {
    return failure(e.line, e.what());
  } catch (const YAML::Exception& e) {
    return failure(e.mark.line + 1, "must be YAML (" + e.msg + ")");
  } catch (const std::exception& e) {
    return failure(1, std::string("must be YAML (") + e.what() + ")");
  }
  if (builder.documents == 0) return failure(1, "must not be empty");
  RawTree tree;
  tree.root = std::move(builder.root);
  return tree;
}

std::string shown(const RawNode& node) {
  switch (node.kind) {
    case RawNode::Kind::kNull:
      return "(nothing)";
    case RawNode::Kind::kMap:
      return "(a map)";
    case RawNode::Kind::kList:
      return "(a list of " + std::to_string(node.items.size()) + ")";
    case RawNode::Kind::kScalar:
      break;
  }
  std::string text = node.scalar.substr(0, kMaxShown);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  if (node.scalar.size() > kMaxShown) text += "…";
  return node.quoted || text.empty() ? "\"" + text + "\"" : text;
}

}  // namespace swallowtail::planner::detail
