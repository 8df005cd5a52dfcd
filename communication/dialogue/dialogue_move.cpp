#include "castor/communication/dialogue/dialogue_move.hpp"

#include "castor/communication/dialogue/clause_parts.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// Readings beyond the first few are hardly ever meant.
constexpr std::size_t max_alternatives = 5;

/// "A ball?", "red things?", but not "robot?", who is spoken to.
bool is_indefinite(const LogicalForm& form, const Nominal& x) {
  const auto delimitation = feature(x, "Delimitation");
  return dependent(form, x, "Selection") == nullptr && x.sort == "thing" &&
         x.proposition != "one" && x.proposition != "robot" && !is_pronoun(x) &&
         (delimitation.empty() || delimitation == "existential");
}

/// "The disc is orange?" asks whether it is, "a disc?" is a question too.
LogicalForm as_question(LogicalForm statement) {
  for (auto& x : statement.nominals)
    if (x.name == statement.root) {
      if (is_clause(statement, x) && feature(x, "Mood").empty())
        x.features.push_back({"Mood", "int"});
      else if (is_indefinite(statement, x))
        x.features.push_back({std::string{said_as_question}, "true"});
    }
  return statement;
}

/// "Can you take the ball?" asks for that, if there is an action that the verb asks for.
LogicalForm as_request(LogicalForm form, const WordMeanings& meanings) {
  auto* root = find_nominal(form, form.root);
  const auto* actor =
    root == nullptr || root->sort != "action" ? nullptr : dependent(form, *root, "Actor");
  const auto modality = actor == nullptr ? std::string_view{} : feature(*root, "Modality");
  const bool is_asked = (modality == "can" || modality == "will" || modality == "should") &&
                        actor->proposition == "you" && !is_negated(*root) &&
                        root->proposition != "reach" &&
                        meanings.actions.contains(root->proposition);
  if (is_asked) {
    std::erase_if(root->features, [](auto& x) { return x.name == "Mood" || x.name == "Modality"; });
    root->features.push_back({"Mood", "imp"});
  }
  return form;
}

/// "In a row", "on each other": how several things stand.
bool is_formation(const Nominal& x) {
  return x.sort == "region" &&
         (is_arrangement(x.proposition) || x.proposition == "stacked-together");
}

/// "Put the ball and the cube in a row at the back": a request says how things are to stand, rather
/// than that they do.
LogicalForm with_formation_as_destination(LogicalForm form) {
  const auto* root = find_nominal(form, form.root);
  const auto* to =
    root == nullptr || root->sort != "action" ? nullptr : dependent(form, *root, "Destination");
  if (to == nullptr)
    return form;
  const std::string place = to->name;
  std::string formation;
  for (auto& x : form.nominals)
    if (x.sort == "thing")
      std::erase_if(x.relations, [&](const NominalRelation& relation) {
        const auto* where = find_nominal(form, relation.dependent);
        const bool is_meant =
          relation.mode == "Location" && where != nullptr && is_formation(*where);
        if (is_meant)
          formation = relation.dependent;
        return is_meant;
      });
  if (formation.empty())
    return form;
  const std::string both = "formation-at-place";
  for (auto& relation : find_nominal(form, form.root)->relations)
    if (relation.mode == "Destination")
      relation.dependent = both;
  form.nominals.push_back(
    {both, "conjunction", "and", {}, {{"First", formation}, {"Next", place}}});
  return form;
}

} // namespace

bool is_verbless(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  if (root != nullptr && root->sort == "conjunction")
    root = dependent(form, *root, "First");
  return root != nullptr && feature(*root, "Verbless") == "true";
}

bool is_clause(const LogicalForm& form, const Nominal& x) {
  if (x.sort == "conjunction") {
    const auto* first = dependent(form, x, "First");
    return first != nullptr && is_clause(form, *first);
  }
  return x.sort == "ascription" || x.sort == "existence" || x.sort == "perception" ||
         x.sort == "action";
}

DialogueMoveType dialogue_move_type(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  if (root == nullptr)
    return DialogueMoveType::none;
  if (root->sort == "greeting")
    return DialogueMoveType::opening;
  if (root->sort == "closing")
    return DialogueMoveType::closing;
  // "Why did you take the ball?"
  if (root->sort == "small-talk" || !feature(*root, "Asks").empty())
    return DialogueMoveType::small_talk;
  if (root->sort == "marker") {
    if (root->proposition == "yes" || root->proposition == "ok")
      return DialogueMoveType::accept;
    return root->proposition == "no" ? DialogueMoveType::reject : DialogueMoveType::none;
  }
  // "The number of triangles?"
  const bool is_owned_quality =
    root->sort == "quality" && dependent(form, *root, "Owner") != nullptr;
  if (is_owned_quality || dependent(form, *root, "Wh-Restr") != nullptr)
    return DialogueMoveType::question_w;
  const auto mood = feature(*root, "Mood");
  if (mood == "int")
    return DialogueMoveType::question_yn;
  if (mood == "imp")
    return DialogueMoveType::action_directive;
  const bool is_statement = mood == "ind" || (mood.empty() && is_clause(form, *root));
  return is_statement ? DialogueMoveType::assertion : DialogueMoveType::none;
}

void take_readings(const PackedLogicalForm& form, DialogueMove& move) {
  // "If the ball is red, ..."
  const bool is_question = form.text.ends_with('?') || (form.sequel && form.sequel->is_conditional);
  // "The ball on the left?"
  const bool is_asked = is_question && std::ranges::any_of(form.readings, [&](const Reading& x) {
                          const auto said = unpack(form, x.id);
                          return said.size() == 1 && !is_verbless(said.front());
                        });
  std::vector<LogicalForm> readings;
  for (auto& reading : form.readings) {
    auto said = unpack(form, reading.id);
    if (said.size() != 1)
      continue;
    said.front() = reunited(std::move(said.front()));
    if (is_asked && is_verbless(said.front()))
      continue;
    if (is_question)
      said.front() = as_question(std::move(said.front()));
    readings.push_back(with_formation_as_destination(std::move(said.front())));
  }
  if (readings.empty())
    return;
  move.type = dialogue_move_type(readings.front());
  move.content = std::move(readings.front());
  const auto others = std::min(readings.size() - 1, max_alternatives);
  for (std::size_t i = 1; i <= others; ++i)
    move.alternatives.push_back(std::move(readings[i]));
}

void take_requests(DialogueMove& move, const WordMeanings& meanings) {
  if (meanings.actions.empty() || move.content.nominals.empty())
    return;
  move.content = as_request(std::move(move.content), meanings);
  for (auto& x : move.alternatives)
    x = as_request(std::move(x), meanings);
  const auto is_request = [&](const LogicalForm& x) {
    return dialogue_move_type(x) == DialogueMoveType::action_directive &&
           !action_asked_for(x, meanings).empty() && !is_verbless(x);
  };
  // "You may touch the ball" does not ask for a state: "may you touch it".
  const auto& sort = find_nominal(move.content, move.content.root)->sort;
  const bool asks_for_state = sort == "ascription" || sort == "existence";
  if (dialogue_move_type(move.content) != DialogueMoveType::action_directive || asks_for_state)
    if (const auto meant = std::ranges::find_if(move.alternatives, is_request);
        meant != move.alternatives.end()) {
      std::swap(move.content, *meant);
      // The likeliest of the others is first.
      std::rotate(move.alternatives.begin(), meant, std::next(meant));
    }
  move.type = dialogue_move_type(move.content);
  if (move.type == DialogueMoveType::action_directive)
    move.action = action_asked_for(move.content, meanings);
}

std::string said_back(const DialogueMove& move) {
  std::string taken;
  std::string left_out;
  for (auto& x : move.corrections)
    if (x.meant.empty())
      left_out += (left_out.empty() ? "I leave out '" : ", '") + x.word + '\'';
    else
      taken += (taken.empty() ? "I take '" : ", '") + x.word + "' for '" + x.meant + '\'';
  if (!taken.empty())
    taken += '.';
  if (!left_out.empty())
    taken += (taken.empty() ? "" : " ") + left_out + '.';
  if (move.partial && !move.partial->lacks_place && !move.partial->left_out.empty())
    taken +=
      (taken.empty() ? "" : " ") + ("I do not understand \"" + move.partial->left_out) + "\".";
  return taken;
}

namespace {

/// "Could you recite a poem?": the verb, if it is not known; else empty.
std::string unknown_deed(const std::string& text, const std::vector<std::string>& unknown) {
  const auto words = words_of(text);
  auto word = std::ranges::find_if_not(words, [](const auto& x) {
    return is_among(x, {"please", "can", "could", "would", "will", "you", "now",  "then",
                        "just",   "so",  "and",   "robot", ",",    "i",   "want", "to",
                        "kindly", "ok",  "like",  "need",  "'d",   "let", "'s"});
  });
  if (word == words.end() || std::next(word) == words.end() ||
      std::ranges::find(unknown, *word) == unknown.end())
    return {};
  const bool has_object =
    is_among(*std::next(word), {"the", "a", "an", "this", "that", "these", "those", "my", "your",
                                "me", "it", "them", "us", "both", "all", "his", "her", "some"});
  return has_object ? *word : std::string{};
}

/// "Hand me the small screwdriver": whether the unknown word is the noun of a thing, an English
/// word.
bool names_missing_thing(const std::string& text, const std::string& unknown) {
  constexpr std::ptrdiff_t most_adjectives = 2;
  const auto words = words_of(text);
  const auto noun = std::ranges::find(words, unknown);
  if (noun == words.end() || !is_english_word(unknown))
    return false;
  const auto next = std::next(noun);
  const bool ends_phrase =
    next == words.end() ||
    is_among(*next, {",",    "and",  "please", "to",     "on",     "in",     "at",
                     "into", "onto", "next",   "beside", "behind", "near",   "from",
                     "for",  "now",  "then",   "over",   "under",  "between"});
  const auto begin =
    noun - words.begin() <= most_adjectives ? words.begin() : noun - most_adjectives - 1;
  const bool has_article = std::any_of(begin, noun, [](const auto& x) {
    return is_among(x, {"the", "a", "an", "my", "your", "this", "that", "some", "any"});
  });
  return ends_phrase && has_article;
}

std::string does_not_see(const std::string& noun) {
  const bool is_plural = noun.ends_with('s') && !noun.ends_with("ss");
  const std::string article = is_plural ? "any " : begins_with_vowel(noun) ? "an " : "a ";
  return "I do not see " + article + noun + ", or do not know " + (is_plural ? "them" : "it") +
         " by that name.";
}

} // namespace

std::string problem_of(const PackedLogicalForm& form, const WordMeanings& meanings) {
  std::string text = "I do not understand that";
  if (form.unparsable.empty())
    return text + '.';
  std::vector<std::string> unknown;
  for (const auto& x : form.unparsable)
    if (x.reason.ends_with("is not known") && std::ranges::find(unknown, x.text) == unknown.end())
      unknown.push_back(x.text);
  if (const auto deeds = meanings.replies.find("deeds"); deeds != meanings.replies.end())
    if (const auto verb = unknown_deed(form.text, unknown); !verb.empty())
      return "I do not know how to " + verb + ". " + deeds->second;
  if (unknown.size() == 1 && names_missing_thing(form.text, unknown.front()))
    return does_not_see(unknown.front());
  const auto& problem = form.unparsable.front();
  if (unknown.empty())
    text += ": " + problem.reason;
  else
    text += unknown.size() == 1 ? ": I do not know the word " : ": I do not know the words ";
  for (std::size_t i = 0; i < unknown.size(); ++i)
    text += (i == 0 ? "\"" : i + 1 == unknown.size() ? " and \"" : ", \"") + unknown[i] + '"';
  if (unknown.size() < 2 && !problem.suggestions.empty())
    return text + "; do you mean '" + problem.suggestions.front() + "'?";
  return text + (unknown.empty() ? "." : ". Please say it in other words.");
}

std::string action_asked_for(const LogicalForm& request, const WordMeanings& meanings) {
  const auto* root = find_nominal(request, request.root);
  const auto known =
    root == nullptr ? meanings.actions.end() : meanings.actions.find(root->proposition);
  return known == meanings.actions.end() ? std::string{} : known->second;
}

} // namespace castor::communication
