#include "castor/communication/dialogue/proposals.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/small_talk.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

/// The feature of the root of a move that declines what was proposed.
constexpr std::string_view declines = "Declines";

bool is_of_several(const LogicalForm& request) {
  const auto* root = find_nominal(request, request.root);
  const auto* things = root == nullptr ? nullptr : dependent(request, *root, "Patient");
  return things != nullptr && (is_plural(*things) || things->sort == "conjunction");
}

Response asked_back(std::string text) {
  return {RhetoricalRelation::clarification_question, {}, std::move(text), {}};
}

} // namespace

Response proposal(const PartialRequest& request, const LogicalForm& content) {
  if (request.lacks_place) {
    const std::string question =
      is_of_several(content) ? "Where shall I put them?" : "Where shall I put it?";
    return asked_back(request.words.empty()
                        ? question
                        : "I understand that I shall " + request.words + " somewhere, but not \"" +
                            request.left_out + "\". " + question);
  }
  auto result = asked_back(request.words.empty() ? "Shall I do that?"
                                                 : "Do you mean \"" + request.words + "\"?");
  result.proposes = true;
  return result;
}

std::string proposal_of(const std::vector<std::string>& deeds) {
  std::string result = "Shall I ";
  for (std::size_t i = 0; i < deeds.size(); ++i)
    result += (i == 0 ? "" : i + 1 == deeds.size() ? " and then " : ", ") + deeds[i];
  return result + '?';
}

namespace {

bool is_go_on(const LogicalForm& said) {
  const auto* root = find_nominal(said, said.root);
  return root != nullptr && root->sort == "action" && root->proposition == "go-on";
}

} // namespace

bool is_agreement(const DialogueMove& move) {
  // "Right" is a side, too.
  const auto agrees = [](const LogicalForm& said) {
    return dialogue_move_type(said) == DialogueMoveType::accept || is_go_on(said);
  };
  return agrees(move.content) || std::ranges::any_of(move.alternatives, agrees);
}

bool says_to_go_ahead(const DialogueMove& move) {
  const auto says_so = [](const LogicalForm& said) {
    const auto* root = find_nominal(said, said.root);
    const bool is_yes = root != nullptr && root->sort == "marker" && root->proposition == "yes";
    return is_yes || is_go_on(said);
  };
  return says_so(move.content) || std::ranges::any_of(move.alternatives, says_so);
}

bool is_refusal(const DialogueMove& move) {
  return move.type == DialogueMoveType::reject || small_talk_topic(move.content) == "thanks";
}

DialogueMove as_refusal_of_proposal(DialogueMove move) {
  if (auto* root = find_nominal(move.content, move.content.root))
    root->features.push_back({std::string{declines}, "true"});
  move.type = DialogueMoveType::reject;
  move.alternatives.clear();
  return move;
}

bool is_refusal_of_proposal(const LogicalForm& content) {
  const auto* root = find_nominal(content, content.root);
  return root != nullptr && feature(*root, declines) == "true";
}

} // namespace castor::communication
