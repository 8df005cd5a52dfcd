#pragma once

#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// A sentence said to the robot, and its answer.
struct Sentence {
  /// Id of the entry that says it.
  std::string id;
  std::string text;
  /// Index of its statement in the workload.
  std::size_t statement = 0;
  /// Time at which it was last said; nothing if it could not be said.
  std::optional<Timestamp> said = {};
  int times_said = 0;
  bool is_answered = false;
  /// The robot did not understand it and said so, or asked back.
  bool apologised = false;
  /// Time of the answer; nothing if there is none, or its time is unknown.
  std::optional<Timestamp> answered = {};

  /// Time from the sentence to its answer, if known.
  std::optional<Timestamp> answer_time() const;
};

/// The sentences of a workload, in its order.
class Sentences {
public:
  /// Adds a sentence to be said; returns its index.
  std::size_t add(std::string text, std::size_t statement);

  void said(std::size_t place, Timestamp at);

  /// Records an utterance of the robot. Only the first answer to a sentence counts.
  /// @param utterance the id of the sentence that it is a reply to; others are ignored
  /// @param at nothing if unknown
  void answer(std::string_view utterance, bool apologises, std::optional<Timestamp> at);

  /// Indices of the sentences that were said and not answered; their entries may be lost.
  std::vector<std::size_t> unanswered() const;

  const std::vector<Sentence>& all() const { return sentences_; }

private:
  std::vector<Sentence> sentences_;
};

/// One line for each sentence that was not answered, or later than `within`; empty if there are
/// none.
std::string answers_missing(const std::vector<Sentence>& sentences,
                            std::optional<Timestamp> within);

} // namespace castor::faults
