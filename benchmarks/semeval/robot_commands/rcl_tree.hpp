#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace castor::semeval {

/// A tree of the Robot Commands Language of SemEval-2014 task 6, as in
///
///     (event: (action: take) (entity: (color: red) (type: cube)))
///
/// A tree has a value or children.
struct RclTree {
  std::string label;
  std::string value;
  std::vector<RclTree> children;
  /// The words that it was annotated with, counted from 1; both 0 if there are none.
  int first_token = 0;
  int last_token = 0;

  /// The first child with this label; null if there is none.
  const RclTree* child(std::string_view wanted) const;

  /// The value of the first child with this label; empty if there is none.
  std::string_view value_of(std::string_view wanted) const;
};

/// What is wrong with the text of a tree.
struct RclError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads a tree; `(token: 5 7)` is no child, but says which words the tree is from.
/// \throws RclError
RclTree parse_rcl(std::string_view text);

/// Without tokens; two trees mean the same if and only if they look the same.
std::string to_string(const RclTree& tree);

} // namespace castor::semeval
