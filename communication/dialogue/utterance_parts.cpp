#include "castor/communication/dialogue/utterance_parts.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor::communication {

std::vector<std::string> words_between(const std::vector<std::string>& words, std::size_t begin,
                                       std::size_t end) {
  return {std::next(words.begin(), static_cast<std::ptrdiff_t>(begin)),
          std::next(words.begin(), static_cast<std::ptrdiff_t>(end))};
}

std::string written(const std::vector<std::string>& words) {
  std::string result;
  for (const auto& word : words) {
    if (word == "n't" && result.ends_with("can"))
      result.pop_back();
    const bool is_joined = word == "," || word == "n't" || word.starts_with('\'');
    result += (result.empty() || is_joined ? "" : " ") + (word == "i" ? std::string{"I"} : word);
  }
  while (result.ends_with(',') || result.ends_with(' '))
    result.pop_back();
  return result;
}

DialogueMove move_of(const PackedLogicalForm& form, const Lexicon& lexicon) {
  DialogueMove result;
  take_readings(form, result);
  take_requests(result, lexicon.meanings());
  return result;
}

bool asks_for_handling(const PackedLogicalForm& form, const Lexicon& lexicon) {
  const auto move = move_of(form, lexicon);
  return move.type == DialogueMoveType::action_directive &&
         is_handling(move.content, lexicon.meanings());
}

bool is_handling_verb(const std::string& word, const Lexicon& lexicon) {
  return lexicon.meanings().actions.contains(word) && lexicon.meanings().handling.contains(word);
}

bool begins_with_handling(const std::vector<std::string>& words, const Lexicon& lexicon) {
  const auto first = std::ranges::find_if(words, [](const auto& x) {
    return !is_among(x, {"and", "then", "please", "now", "so", "but"});
  });
  return first != words.end() &&
         std::ranges::any_of(lexicon.find(*first), [&](std::uint32_t number) {
           const auto& entry = lexicon.entry(number);
           const auto& category = lexicon.categories()[entry.category];
           return lexicon.symbols().text(category.result.name) == "s" &&
                  is_handling_verb(entry.predicate, lexicon);
         });
}

bool is_prohibition(const PackedLogicalForm& form, const Lexicon& lexicon) {
  const auto move = move_of(form, lexicon);
  const auto* root = find_nominal(move.content, move.content.root);
  return move.type == DialogueMoveType::action_directive && root != nullptr &&
         root->sort == "action" && forbids(*root);
}

std::optional<LogicalForm> thing_said(const PackedLogicalForm& form) {
  auto said = unpack(form, form.readings.front().id).front();
  const auto& root = *find_nominal(said, said.root);
  return root.sort == "thing" && !is_pronoun(root) ? std::optional{std::move(said)} : std::nullopt;
}

} // namespace castor::communication
