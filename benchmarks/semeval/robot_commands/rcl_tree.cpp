#include "castor/benchmarks/semeval/robot_commands/rcl_tree.hpp"

#include <algorithm>
#include <charconv>

namespace castor::semeval {

namespace {

/// Deeper nesting than any command has.
constexpr int max_depth = 100;

class RclReader {
public:
  explicit RclReader(std::string_view text) : text_(text) {
    // nop
  }

  RclTree read() {
    auto tree = read_tree(0);
    if (!next().empty())
      throw RclError("something follows the tree");
    return tree;
  }

private:
  /// A parenthesis or a word; empty at the end.
  std::string_view next() {
    const auto begin = std::min(text_.find_first_not_of(" \t\r\n"), text_.size());
    text_.remove_prefix(begin);
    auto length = std::min(text_.find_first_of(" \t\r\n()"), text_.size());
    if (length == 0 && !text_.empty())
      length = 1;
    const auto word = text_.substr(0, length);
    text_.remove_prefix(length);
    return word;
  }

  RclTree read_tree(int depth) {
    if (depth > max_depth)
      throw RclError("the tree is nested too deeply");
    if (next() != "(")
      throw RclError("expected \"(\"");
    RclTree tree;
    tree.label = next();
    if (tree.label.size() < 2 || tree.label.back() != ':')
      throw RclError("expected a label with a colon, not \"" + tree.label + "\"");
    tree.label.pop_back();
    for (;;) {
      const auto rest = text_;
      const auto word = next();
      if (word == ")")
        return tree;
      if (word.empty())
        throw RclError("a parenthesis is not closed");
      if (word != "(") {
        if (tree.label == "token")
          read_token(word, tree);
        else
          tree.value = word;
        continue;
      }
      text_ = rest;
      auto child = read_tree(depth + 1);
      if (child.label != "token") {
        tree.children.push_back(std::move(child));
      } else {
        tree.first_token = child.first_token;
        tree.last_token = child.last_token;
      }
    }
  }

  static void read_token(std::string_view word, RclTree& tree) {
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size())
      throw RclError("tokens are numbers");
    if (tree.first_token == 0)
      tree.first_token = number;
    tree.last_token = number;
  }

  std::string_view text_;
};

} // namespace

const RclTree* RclTree::child(std::string_view wanted) const {
  const auto place = std::find_if(children.begin(), children.end(),
                                  [wanted](const RclTree& tree) { return tree.label == wanted; });
  return place == children.end() ? nullptr : &*place;
}

std::string_view RclTree::value_of(std::string_view wanted) const {
  const auto* found = child(wanted);
  return found == nullptr ? std::string_view() : std::string_view(found->value);
}

RclTree parse_rcl(std::string_view text) {
  return RclReader(text).read();
}

std::string to_string(const RclTree& tree) {
  std::string text = "(" + tree.label + ":";
  if (!tree.value.empty())
    text += " " + tree.value;
  for (const auto& child : tree.children)
    text += " " + to_string(child);
  return text + ")";
}

} // namespace castor::semeval
