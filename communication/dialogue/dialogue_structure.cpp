#include "castor/communication/dialogue/dialogue_structure.hpp"

namespace castor::communication {

DialogueTurn connected(DialogueTurn turn, std::span<const DialogueTurn> before) {
  if (before.empty())
    return turn;
  auto& last = before.back();
  const bool is_asked_back =
    last.speaker != turn.speaker && last.relation == RhetoricalRelation::clarification_question;
  if (turn.type == DialogueMoveType::accept || turn.type == DialogueMoveType::reject) {
    turn.relation = turn.type == DialogueMoveType::accept ? RhetoricalRelation::acceptance
                                                          : RhetoricalRelation::correction;
    turn.to = last.contribution;
  } else if (is_asked_back && turn.type == DialogueMoveType::none) {
    turn.relation = RhetoricalRelation::clarification;
    turn.to = last.contribution;
  } else if (turn.type == DialogueMoveType::opening || turn.type == DialogueMoveType::closing)
    turn.relation = RhetoricalRelation::greeting;
  return turn;
}

} // namespace castor::communication
