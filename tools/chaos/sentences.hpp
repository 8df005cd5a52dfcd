#pragma once

#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// A sentence that is said to the robot, and what became of it.
struct Sentence {
  /// Of the entry that it is said with.
  std::string id;
  std::string text;
  /// Which statement of the workload it comes from.
  std::size_t statement = 0;
  /// When it was said last; nothing if it could not be said.
  std::optional<Timestamp> said = {};
  int times_said = 0;
  bool is_answered = false;
  /// The robot did not understand it and said so, or asked back.
  bool apologised = false;
  /// Nothing if there is an answer, and nobody saw it come.
  std::optional<Timestamp> answered = {};

  /// How long the answer took, if that is known.
  std::optional<Timestamp> answer_time() const;
};

/// What a workload has said, in its order.
class Sentences {
public:
  /// A sentence that is to be said: its place.
  std::size_t add(std::string text, std::size_t statement);

  void said(std::size_t place, Timestamp at);

  /// The robot has said something. Only the first answer to a sentence counts.
  /// @param utterance the id of the sentence that it is a reply to; others are ignored
  /// @param at nothing if nobody knows
  void answer(std::string_view utterance, bool apologises, std::optional<Timestamp> at);

  /// Places of those that were said and not answered, whose entries may be lost.
  std::vector<std::size_t> unanswered() const;

  const std::vector<Sentence>& all() const { return sentences_; }

private:
  std::vector<Sentence> sentences_;
};

/// Lines of text about sentences that were not answered, or later than `within`; empty if there
/// are none.
std::string answers_missing(const std::vector<Sentence>& sentences,
                            std::optional<Timestamp> within);

} // namespace castor::faults
