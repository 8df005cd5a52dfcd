#include "castor/communication/dialogue/salience.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

namespace castor::communication {

namespace {

using Proxies = std::vector<std::string>;

/// Whether the robot had to ask what is meant: whoever does not answer that speaks of no other
/// thing that was spoken of before.
bool is_open(const MoveReferents& move) {
  return (!move.understood && move.referents.empty()) ||
         (move.is_unclear && std::ranges::any_of(move.referents, [](const DiscourseReferent& x) {
            return x.proxies.empty();
          }));
}

/// "Put the ball next to the cube", of which it had to ask which cube: "it" is the ball.
bool is_clear_about_first(const MoveReferents& move) {
  return !move.referents.empty() && !move.referents.front().proxies.empty();
}

/// Moves from the last one back to one after which nothing is clear.
std::vector<const MoveReferents*> recent(std::span<const MoveReferents> history) {
  std::vector<const MoveReferents*> result;
  for (auto& move : history)
    result.push_back(&move);
  std::ranges::stable_sort(result, std::ranges::greater{}, &MoveReferents::turn);
  const auto last =
    std::ranges::find_if(result, [](const auto* x) { return !x->understood || is_open(*x); });
  // What is not understood may name something.
  const bool names_something =
    last != result.end() && (!is_open(**last) || is_clear_about_first(**last));
  result.erase(last + (names_something ? 1 : 0), result.end());
  return result;
}

/// The last thing or things that were spoken of.
Proxies latest(const std::vector<const MoveReferents*>& moves, bool several) {
  for (const auto* move : moves) {
    for (auto& referent : move->referents)
      if (several ? referent.proxies.size() > 1 || (referent.is_plural && !referent.proxies.empty())
                  : referent.proxies.size() == 1 && !referent.is_plural)
        return referent.proxies;
    // "The ball" and "the cube" are "they".
    Proxies together;
    for (auto& referent : move->referents)
      if (several && referent.proxies.size() == 1)
        together.push_back(referent.proxies.front());
    if (together.size() > 1)
      return together;
  }
  return {};
}

/// The last several things that one was chosen from.
Proxies set_with(const std::vector<const MoveReferents*>& moves, const std::string& proxy) {
  for (const auto* move : moves)
    for (auto& referent : move->referents)
      if (referent.proxies.size() > 1 &&
          std::ranges::find(referent.proxies, proxy) != referent.proxies.end())
        return referent.proxies;
  return {};
}

/// The one thing that a move was about: its answer, or else all that it spoke of.
const DiscourseReferent* only_referent(const MoveReferents& move) {
  const auto& all = move.referents;
  const auto answer = std::ranges::find_if(all, &DiscourseReferent::is_answer);
  const auto* result = answer != all.end() ? &*answer : all.size() == 1 ? &all.front() : nullptr;
  return result != nullptr && result->proxies.size() == 1 ? result : nullptr;
}

/// "What is on the left? Where is the ball? Swap those two": what the last moves were about, one
/// each, if that is as many; else nothing.
Proxies latest_one_by_one(const std::vector<const MoveReferents*>& moves,
                          const NumberRange& range) {
  Proxies result;
  for (const auto* move : moves) {
    const auto* answer = only_referent(*move);
    if (answer == nullptr)
      return {};
    if (std::ranges::find(result, answer->proxies.front()) == result.end())
      result.insert(result.begin(), answer->proxies.front());
    if (is_within({result.size(), result.size()}, range) == Truth::yes)
      return result;
  }
  return {};
}

/// The last things that were spoken of that are as many as that.
Proxies latest_of_number(const std::vector<const MoveReferents*>& moves, const NumberRange& range) {
  if (auto each = latest_one_by_one(moves, range); each.size() > 1)
    return each;
  const auto fits = [&range](const Proxies& x) {
    return is_within({x.size(), x.size()}, range) == Truth::yes;
  };
  for (const auto* move : moves) {
    Proxies together;
    for (auto& referent : move->referents) {
      if (fits(referent.proxies))
        return referent.proxies;
      if (referent.proxies.size() == 1 &&
          std::ranges::find(together, referent.proxies.front()) == together.end())
        together.push_back(referent.proxies.front());
    }
    if (fits(together))
      return together;
  }
  return {};
}

/// How many things "all three" and "the two" stand for; nothing for other phrases.
std::optional<NumberRange> number_spoken_of(const LogicalForm& form, const Nominal& x) {
  const auto* quantity = dependent(form, x, "Quantity");
  const bool is_group = is_pronoun(x) || is_counted_group(form, x);
  return is_group && quantity != nullptr ? number_range(*quantity) : std::nullopt;
}

Proxies latest_of_any_number(const std::vector<const MoveReferents*>& moves) {
  for (const auto* move : moves)
    for (auto& referent : move->referents)
      if (!referent.proxies.empty())
        return referent.proxies;
  return {};
}

/// Which one of those that were spoken of last "that one" is, nobody can say.
bool is_one_of_several(const Nominal& x, const std::vector<const MoveReferents*>& moves) {
  if (is_plural(x) || moves.empty())
    return false;
  const auto& referents = moves.front()->referents;
  return !referents.empty() && referents.front().proxies.size() > 1;
}

/// "What colour is that?"
bool is_asked_for_quality(const LogicalForm& form, const Nominal& x) {
  const auto* root = find_nominal(form, form.root);
  const auto* asked = root == nullptr ? nullptr : dependent(form, *root, "Wh-Restr");
  return asked != nullptr && asked->sort == "quality" &&
         (dependent(form, *root, "Cop-Restr") == &x || dependent(form, *root, "Cop-Scope") == &x);
}

/// The last thing that was spoken of besides those.
Proxies latest_besides(const std::vector<const MoveReferents*>& moves, const Proxies& those) {
  for (const auto* move : moves)
    for (auto& referent : move->referents)
      if (referent.proxies.size() == 1 && !referent.is_plural && referent.proxies != those)
        return referent.proxies;
  return {};
}

/// "Put the ball down", "put it back": whoever knows what was done knows which ball that is.
bool is_told_by_what_was_done(const LogicalForm& form, const Nominal& x) {
  return std::ranges::any_of(form.nominals, [&](const Nominal& action) {
    const auto* to = dependent(form, action, "Destination");
    const bool is_back = to != nullptr && to->proposition == "place-before-of";
    return action.sort == "action" && dependent(form, action, "Patient") == &x &&
           (is_back ||
            (to == nullptr && (action.proposition == "drop" || action.proposition == "put-back")));
  });
}

/// Things that the last move spoke of, one by one.
Proxies last_singles(const std::vector<const MoveReferents*>& moves) {
  Proxies result;
  if (!moves.empty())
    for (const auto& x : moves.front()->referents)
      if (x.proxies.size() == 1 && !x.is_plural)
        result.push_back(x.proxies.front());
  return result;
}

/// Several things that the last move had for an answer, or spoke of together.
Proxies last_several(const std::vector<const MoveReferents*>& moves) {
  if (moves.empty())
    return {};
  const auto& all = moves.front()->referents;
  const auto answer = std::ranges::find_if(all, &DiscourseReferent::is_answer);
  if (answer != all.end())
    return answer->proxies.size() < 2 ? Proxies{} : answer->proxies;
  return latest({moves.front()}, true);
}

/// "Which one is nearest to the cube? - A ball and a disc.": "that one" is one of these.
bool has_several_answers(const std::vector<const MoveReferents*>& moves) {
  return !moves.empty() &&
         std::ranges::any_of(moves.front()->referents, [](const DiscourseReferent& x) {
           return x.is_answer && x.proxies.size() > 1;
         });
}

/// "Put the disc on the box. Now take it away from it.": the second is another thing.
bool is_place_of_other(const LogicalForm& form, const Nominal& x) {
  const auto* root = find_nominal(form, form.root);
  const auto* patient =
    root == nullptr || root->sort != "action" ? nullptr : dependent(form, *root, "Patient");
  const auto* destination = patient == nullptr ? nullptr : dependent(form, *root, "Destination");
  return destination != nullptr && dependent(form, *destination, "Anchor") == &x && patient != &x &&
         is_pronoun(*patient) && !is_plural(*patient) && !is_plural(x) &&
         destination->proposition != "place-of" && destination->proposition != "place-before-of";
}

Antecedents antecedents_in(const LogicalForm& form, const std::vector<const MoveReferents*>& moves,
                           const Vocabulary& vocabulary) {
  Antecedents result;
  for (auto& x : form.nominals) {
    Proxies found;
    if (const auto number = number_spoken_of(form, x)) {
      found = latest_of_number(moves, *number);
    } else if (x.sort == "thing" && is_about_others(form, x)) {
      found = latest_of_any_number(moves);
      if (auto all = found.size() == 1 ? set_with(moves, found.front()) : Proxies{}; !all.empty())
        result.emplace(x.name + std::string{chosen_from}, std::move(all));
    } else if (x.sort == "comparison" && dependent(form, x, "Than") == nullptr) {
      // "Is the ball the same colour?"
      found = latest(moves, false);
    } else if (is_deictic(x) || feature(x, "Recent") == "true") {
      // What is shown is not what was spoken of some time ago, nor beside an answer.
      if (is_plural(x) || !has_several_answers(moves))
        found = latest({moves.begin(), moves.begin() + (moves.empty() ? 0 : 1)}, is_plural(x));
    } else if (is_pronoun(x) || (is_anaphoric(x, vocabulary) && !is_one_of_several(x, moves))) {
      found = latest(moves, is_plural(x));
      if (is_pronoun(x) && is_place_of_other(form, x))
        if (auto other = latest_besides(moves, found); !other.empty())
          found = std::move(other);
    }
    // "Are they the same colour? What colour is that?"
    if (found.empty() && is_deictic(x) && !is_plural(x) && is_asked_for_quality(form, x))
      found = latest({moves.begin(), moves.begin() + (moves.empty() ? 0 : 1)}, true);
    if (!found.empty())
      result.emplace(x.name, std::move(found));
    if (x.sort != "thing" || is_pronoun(x) || is_plural(x) || !is_definite(x) ||
        is_about_others(form, x) || is_told_by_what_was_done(form, x))
      continue;
    if (auto singles = last_singles(moves);
        !singles.empty() && !(!feature(x, "Proximity").empty() && has_several_answers(moves)))
      result.emplace(x.name + std::string{spoken_of_last}, std::move(singles));
    if (auto several = last_several(moves); !several.empty())
      result.emplace(x.name + std::string{last_group}, std::move(several));
  }
  return result;
}

} // namespace

Antecedents antecedents_in(const DialogueMove& move, std::span<const MoveReferents> history,
                           const Vocabulary& vocabulary) {
  const auto moves = recent(history);
  auto result = antecedents_in(move.content, moves, vocabulary);
  // "Are they all red?", before anything was spoken of, is about all there is.
  const bool is_first =
    std::ranges::all_of(history, [](const auto& x) { return x.understood && x.referents.empty(); });
  if (is_first)
    for (auto& x : move.content.nominals)
      if (x.proposition == "they" && is_pronoun(x))
        result.emplace(x.name + std::string{first_spoken_of}, Proxies{});
  for (auto& alternative : move.alternatives)
    result.merge(antecedents_in(alternative, moves, vocabulary));
  return result;
}

namespace {

/// What a definite phrase means; of others, those of which it is so: "is any ball red?" speaks of
/// the red ones, if there are any.
std::vector<std::string> spoken_of(const LogicalForm& form, const Nominal& thing,
                                   Evaluation& evaluation) {
  if (is_definite(thing))
    return evaluation.meant(thing);
  const auto* root = find_nominal(form, form.root);
  if (root->sort == "ascription" && dependent(form, *root, "Cop-Restr") == &thing &&
      dependent(form, *root, "Wh-Restr") == nullptr && !is_negated(*root))
    if (auto so = evaluation.answers(*root, thing).best(); !so.empty())
      return so;
  return evaluation.described(thing).best();
}

} // namespace

std::vector<DiscourseReferent> referents_of(const DialogueMove& move,
                                            const Antecedents& antecedents, SceneKnowledge& scene) {
  std::vector<DiscourseReferent> result;
  auto& form = move.content;
  Evaluation evaluation{form, antecedents, scene};
  const auto* root = find_nominal(form, form.root);
  // Of two questions the answer to the second is what is spoken of next.
  if (const auto* second = root == nullptr ? nullptr : dependent(form, *root, "Next");
      second != nullptr && dependent(form, *second, "Wh-Restr") != nullptr)
    root = second;
  const auto* asked = root == nullptr ? nullptr : dependent(form, *root, "Wh-Restr");
  auto add = [&](const Nominal& phrase, const std::vector<std::string>& things, bool plural) {
    DiscourseReferent referent{phrase.name, phrase.proposition, plural, {}, &phrase == asked};
    for (auto& id : things)
      referent.proxies.push_back(scene.proxy_of(id));
    result.push_back(std::move(referent));
  };
  if (asked != nullptr && (asked->sort == "thing" || asked->sort == "entity"))
    try {
      auto things = evaluation.answers(*root, *asked).best();
      add(*asked, things, things.size() > 1);
    } catch (const Uninterpretable&) {
      asked = nullptr;
    }
  for (const auto* thing : things_spoken_of(form, scene.vocabulary())) {
    // "It" is not the robot's own hand.
    if (thing == asked || feature(*thing, "Whose") == "yours")
      continue;
    try {
      add(*thing, spoken_of(form, *thing, evaluation), is_plural(*thing));
    } catch (const Uninterpretable&) {
      add(*thing, {}, is_plural(*thing));
    }
  }
  if (move.mention) {
    DialogueMove named;
    named.content = *move.mention;
    // What may be one of several is not what "it" is next.
    auto mentioned = referents_of(named, {}, scene);
    std::erase_if(mentioned, [](const DiscourseReferent& x) {
      return x.proxies.empty() || (!x.is_plural && x.proxies.size() > 1);
    });
    std::ranges::move(mentioned, std::back_inserter(result));
  }
  return result;
}

namespace {

void rename_all(Proxies& proxies, const RenamedThings& renamed) {
  for (auto& x : proxies)
    if (const auto now = renamed.find(x); now != renamed.end())
      x = now->second;
}

} // namespace

void rename(MoveReferents& move, const RenamedThings& renamed) {
  for (auto& x : move.referents)
    rename_all(x.proxies, renamed);
}

void rename(Antecedents& antecedents, const RenamedThings& renamed) {
  for (auto& [name, proxies] : antecedents)
    rename_all(proxies, renamed);
}

void note_chosen(MoveReferents& request, const std::vector<std::string>& things) {
  const auto is_choice = [&](const DiscourseReferent& x) {
    return x.proxies.size() > things.size() && std::ranges::all_of(things, [&](auto& thing) {
             return std::ranges::find(x.proxies, thing) != x.proxies.end();
           });
  };
  const auto left_open = std::ranges::find_if(request.referents, is_choice);
  if (things.empty() || left_open == request.referents.end())
    return;
  auto all = *left_open;
  all.is_plural = true;
  left_open->proxies = things;
  left_open->is_plural = things.size() > 1;
  request.referents.push_back(std::move(all));
}

std::vector<PronounReferents> to_entry(const Antecedents& antecedents) {
  std::vector<PronounReferents> result;
  for (auto& [nominal, proxies] : antecedents)
    result.push_back({nominal, proxies});
  return result;
}

Antecedents from_entry(const std::vector<PronounReferents>& pronouns) {
  Antecedents result;
  for (auto& x : pronouns)
    result.emplace(x.nominal, x.proxies);
  return result;
}

} // namespace castor::communication
