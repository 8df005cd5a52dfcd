#pragma once

#include "castor/communication/types.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace castor::communication {

/// What is to be said.
struct Sentence {
  LogicalForm content;
  /// Said if the lexicon has no words for the content; without nominals for nothing.
  LogicalForm simpler = {};
};

/// What is to be said in reply to a dialogue move.
struct Response {
  RhetoricalRelation relation = RhetoricalRelation::narration;
  std::vector<Sentence> sentences;
  /// Instead of them, what the lexicon has no words for.
  std::string text;
  /// Nominal of a clarification question; empty if there is none.
  std::string asked_about;
  /// The reading of the move that is replied to: 0 for its content, 1 for the first alternative.
  std::size_t reading = 0;
  /// Whether it is asked if a request is to be done.
  bool proposes = false;
};

/// \param simpler said if there are no words for the content
inline Response answer(LogicalForm content, LogicalForm simpler = {}) {
  return {RhetoricalRelation::answer, {{std::move(content), std::move(simpler)}}, {}, {}};
}

} // namespace castor::communication
