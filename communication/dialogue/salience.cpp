#include "castor/communication/dialogue/salience.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

namespace castor::communication {

std::string antecedent_of(const Nominal& pronoun, std::span<const MoveReferents> history) {
  const bool is_plural = feature(pronoun, "Number") == "pl";
  const MoveReferents* latest = nullptr;
  const DiscourseReferent* result = nullptr;
  for (auto& move : history) {
    if (latest != nullptr && move.turn <= latest->turn)
      continue;
    for (auto& referent : move.referents)
      if (referent.proxies.size() == 1 && referent.is_plural == is_plural) {
        latest = &move;
        result = &referent;
        break;
      }
  }
  return result == nullptr ? std::string{} : result->proxies.front();
}

} // namespace castor::communication
