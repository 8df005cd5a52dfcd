#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::communication::test {

/// What a reply says, as a person would take it who listens for what matters only.
struct ReadReply {
  enum class Kind {
    yes,
    no,
    /// "I do not know."
    unknown,
    /// "Ok."
    accepted,
    /// "I do not see a ball."
    not_seen,
    /// "Which ball do you mean?"
    asked_back,
    /// "There are two balls.", "It is red."
    statement,
    not_understood,
    /// Nothing that the reader understands.
    strange,
  };

  /// "There is a small red ball."
  struct Described {
    std::string colour;
    /// Empty for "thing".
    std::string shape;
    std::string size;
  };

  Kind kind = Kind::strange;
  /// The first sentence says what there is.
  bool is_existence = false;
  /// How many there are, if it says so by a number.
  std::optional<std::size_t> number;
  bool is_at_least = false;
  /// What there is, or what it is: what has an indefinite article.
  std::vector<Described> described;
  /// The words for colours, sizes and shapes in "it is ...".
  std::vector<std::string> ascribed;
  /// "It is not ...".
  bool is_denied = false;
  /// All that has an article, such as what a place is told by.
  std::vector<Described> mentioned;
  /// The words that something is said to be.
  std::vector<std::string> colours;
  std::vector<std::string> shapes;
  std::vector<std::string> sizes;
};

ReadReply read_reply(std::string_view text);

} // namespace castor::communication::test
