#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// What an utterance means that is not understood but like the lexicon's examples of one meaning:
/// "blue ball belongs on the cube's left" is "put the blue ball to the left of the cube".
class LikelyMeaning {
public:
  LikelyMeaning(Parser& parser, const std::vector<std::string>& words);
  ~LikelyMeaning();

  /// If it is much like them. The form has a correction, so that it is said back what the utterance
  /// was taken for.
  std::optional<PackedLogicalForm> likely();

  /// If it is less like them, too. The form of a request is `partial`: it is only done if the
  /// speaker agrees.
  std::optional<PackedLogicalForm> possible();

  /// Whether it is like remarks, which ask for nothing: "I need somewhere to roll my dough".
  /// \param is_alone whether it is all that is said: words that nobody knows change no request then
  bool is_remark(bool is_alone);

  /// "I would prefer the green cube up there": is no remark.
  bool is_wish();

  /// The words that name things, if only these do, and are no pronoun.
  std::optional<std::vector<std::string>> name();

  /// What they say.
  std::optional<LogicalForm> mention();

private:
  class Search;
  std::unique_ptr<Search> search_;
};

/// With the thing that another part of the utterance names in the place of "it", unless one is
/// named before the pronoun.
std::vector<std::string> with_thing_of(Parser& parser, std::vector<std::string> words,
                                       const std::vector<std::string>& other);

} // namespace castor::communication
