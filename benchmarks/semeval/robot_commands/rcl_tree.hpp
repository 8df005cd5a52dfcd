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

/// Error in the text of a tree.
struct RclError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Parses a tree; `(token: 5 7)` is not a child, but the range of its words.
/// \throws RclError
RclTree parse_rcl(std::string_view text);

/// The text of a tree without tokens; two trees mean the same if and only if their texts are equal.
std::string to_string(const RclTree& tree);

} // namespace castor::semeval
