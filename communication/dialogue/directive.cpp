#include "castor/communication/dialogue/directive.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/directive_places.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace castor::communication {

namespace {

using Reason = Uninterpretable::Reason;
using Things = std::vector<std::string>;

/// Unions, of which so many are meant; 0 for all.
struct Meant {
  Things things;
  std::int32_t number = 0;
};

Things without(Things things, const Things& others) {
  std::erase_if(things, [&](auto& x) { return std::ranges::find(others, x) != others.end(); });
  return things;
}

class StepReader {
public:
  StepReader(const LogicalForm& form, const Antecedents& antecedents, SceneKnowledge& scene)
    : form_(form), antecedents_(antecedents), scene_(scene), evaluation_(form, antecedents, scene) {
  }

  std::vector<DirectiveStep> read() {
    const auto* root = find_nominal(form_, form_.root);
    for_each_action(form_, *root, [this](auto& x) { add(x); });
    exchange();
    return std::move(steps_);
  }

private:
  const Vocabulary& vocabulary() const { return scene_.vocabulary(); }

  /// Type of the action that a verb asks for.
  std::string action_for(const std::string& verb) const {
    const auto& actions = vocabulary().meanings().actions;
    const auto known = actions.find(verb);
    if (known == actions.end())
      throw Uninterpretable{Reason::word, verb};
    return known->second;
  }

  void add(const Nominal& x) {
    if (x.sort != "action" || is_negated(x))
      throw Uninterpretable{Reason::word, x.proposition};
    DirectiveStep step;
    const bool is_same = x.proposition == "same";
    // "Push the ball and the cube to the left" has no place of its own for the ball.
    if (is_same && !steps_.empty() && steps_.back().places.empty())
      throw Uninterpretable{Reason::word, x.proposition};
    if (is_same)
      step.action = steps_.empty() ? action_for("put") : steps_.back().action;
    else
      step.action = action_for(x.proposition);
    if (is_same && dependent(form_, x, "Patient") == nullptr)
      throw Uninterpretable{Reason::word, x.proposition};
    if (const auto* destination = dependent(form_, x, "Destination"))
      read_destination(x, *destination, step);
    else
      read_without_destination(x, step);
    steps_.push_back(std::move(step));
    last_ = current_;
  }

  /// "The ball where the cube is, and the cube where the ball is": they change places.
  void exchange() {
    if (steps_.size() != 2)
      return;
    const auto goes_where = [](const DirectiveStep& x, const DirectiveStep& other) {
      return x.things.size() == 1 && x.places.size() == 1 && x.places.front().relation == "where" &&
             x.places.front().landmarks == other.things;
    };
    auto& first = steps_.front();
    if (goes_where(first, steps_.back()) && goes_where(steps_.back(), first))
      steps_ = {DirectiveStep{
        action_for("swap"), {first.things.front(), steps_.back().things.front()}, 0, {}, {}}};
  }

  // -- kinds of steps

  void read_destination(const Nominal& x, const Nominal& destination, DirectiveStep& step) {
    const auto& patient = need(x, "Patient");
    // "Get everything off the left side."
    const auto* anchor = dependent(form_, destination, "Anchor");
    if (destination.proposition == "away" && anchor != nullptr && anchor->sort == "place") {
      step.action = action_for("clear");
      return read_clearing(*anchor, step);
    }
    if (is_its_own_place(patient, destination)) {
      step.action = action_for("put-back");
      return take(one_of_like(patient), patient, step);
    }
    // "In its old place" may be that of the thing itself: who knows what was moved decides.
    const bool is_its_or_own = destination.proposition == "place-before-of" && anchor != nullptr &&
                               is_pronoun(*anchor) &&
                               vocabulary().meanings().actions.contains("put-back");
    if (is_its_or_own)
      step.action = action_for("put-back");
    else if (step.action != action_for("push"))
      step.action = action_for("put");
    auto meant = things(patient);
    if (destination.proposition == "near-each-other")
      return read_gathering(meant, step);
    Things landmarks;
    for (const auto& place : places_named(form_, destination, vocabulary())) {
      Things others;
      if (place.landmark != nullptr)
        others = landmarks_of(*place.landmark, meant.things);
      step.places.push_back({place.relation, proxies(others)});
      landmarks.insert(landmarks.end(), others.begin(), others.end());
    }
    // "Put everything next to the disc" moves all but the disc.
    if (!is_definite(patient) || is_plural(patient))
      meant.things = without(std::move(meant.things), landmarks);
    take(meant, patient, step);
  }

  /// Whether "in its old place" is the place where the thing itself was, not another one.
  bool is_its_own_place(const Nominal& patient, const Nominal& destination) {
    const auto* anchor = dependent(form_, destination, "Anchor");
    if (destination.proposition != "place-before-of" || anchor == nullptr || !is_pronoun(*anchor))
      return false;
    if (is_pronoun(patient))
      return true;
    try {
      return landmarks_of(*anchor, {}) == things_of(patient).things;
    } catch (const Uninterpretable& e) {
      if (e.what != anchor->name)
        throw;
      return true;
    }
  }

  /// "Next to each other": the others next to the first one.
  void read_gathering(const Meant& meant, DirectiveStep& step) {
    auto gathered = proxies(meant.things);
    if (meant.number > 0 && std::ssize(gathered) > meant.number)
      gathered.resize(static_cast<std::size_t>(meant.number));
    if (gathered.size() < 2 && scene_.open_questions().empty())
      throw Uninterpretable{Reason::word, "near-each-other"};
    if (gathered.empty())
      return;
    step.places.push_back({"near", {gathered.front()}});
    step.things.assign(gathered.begin() + 1, gathered.end());
  }

  void read_without_destination(const Nominal& x, DirectiveStep& step) {
    const auto* patient = dependent(form_, x, "Patient");
    if (x.proposition == "clear")
      return read_clearing(need(x, "Patient"), step);
    if (x.proposition == "sort")
      return read_sorting(x, patient, step);
    if (x.proposition == "swap")
      return read_swapping(x, step);
    if (patient == nullptr || patient->sort == "person")
      return;
    if (x.proposition == "move" || x.proposition == "remove")
      step.places.push_back({"elsewhere", {}});
    if (x.proposition == "bring")
      step.action = action_for("give");
    if (x.proposition == "put-back" && is_everything(*patient))
      step.action = action_for("restore");
    const bool tells_itself = x.proposition == "drop" || x.proposition == "put-back";
    take(tells_itself ? one_of_like(*patient) : things(*patient), *patient, step);
  }

  /// "Put everything back", but not "all of them" or "all balls".
  bool is_everything(const Nominal& phrase) const {
    return feature(phrase, "Delimitation") == "all" && phrase.relations.empty() &&
           vocabulary().is_general(phrase.proposition) && !is_pronoun(phrase) &&
           vocabulary().meanings().actions.contains("restore");
  }

  /// What is put down is held, and what is put back was moved: that tells which of several is
  /// meant.
  Meant one_of_like(const Nominal& phrase) {
    try {
      return things(phrase);
    } catch (const Uninterpretable& e) {
      if (e.reason != Reason::ambiguous)
        throw;
      return {is_pronoun(phrase) ? scene_.things() : evaluation_.described(phrase).certain, 1};
    }
  }

  void read_clearing(const Nominal& part, DirectiveStep& step) {
    const auto places = part.sort == "region" || part.sort == "conjunction"
                          ? places_named(form_, part, vocabulary())
                          : std::vector{part_named(form_, part, vocabulary())};
    if (places.size() != 1 || places.front().landmark != nullptr)
      throw Uninterpretable{Reason::word, part.proposition};
    step.places.push_back({places.front().relation, {}});
  }

  void read_sorting(const Nominal& x, const Nominal* patient, DirectiveStep& step) {
    const auto* by = dependent(form_, x, "By");
    step.by = by == nullptr ? "colour" : by->proposition;
    if (!vocabulary().kind_of_quality(step.by))
      throw Uninterpretable{Reason::word, step.by};
    Meant meant{scene_.things(), 0};
    if (patient != nullptr)
      try {
        meant = things(*patient);
      } catch (const Uninterpretable& e) {
        // "Sort them": all there are, if nothing was spoken of.
        if (!is_pronoun(*patient) || e.reason != Reason::ambiguous)
          throw;
      }
    step.things = proxies(meant.things);
  }

  void read_swapping(const Nominal& x, DirectiveStep& step) {
    const auto& patient = need(x, "Patient");
    auto both = things(patient).things;
    if (const auto* other = dependent(form_, x, "Counterpart"))
      for (auto& id : landmarks_of(*other, both))
        both.push_back(id);
    if (scene_.open_questions().empty() && both.size() != 2)
      throw Uninterpretable{both.size() < 2 ? Reason::nothing_like : Reason::ambiguous,
                            patient.name};
    step.things = proxies(both);
  }

  // -- what is meant

  const Nominal& need(const Nominal& of, const char* mode) const {
    const auto* result = dependent(form_, of, mode);
    if (result == nullptr)
      throw Uninterpretable{Reason::word, of.proposition};
    return *result;
  }

  void take(const Meant& meant, const Nominal& phrase, DirectiveStep& step) {
    if (meant.things.empty() && scene_.open_questions().empty())
      throw Uninterpretable{Reason::nothing_like, phrase.name};
    step.things = proxies(meant.things);
    step.number = meant.number < std::ssize(meant.things) ? meant.number : 0;
  }

  Things proxies(const Things& ids) const {
    Things result;
    for (const auto& id : ids) {
      auto proxy = scene_.proxy_of(id);
      result.push_back(proxy.empty() ? id : std::move(proxy));
    }
    return result;
  }

  /// Proxies of what "it" stands for, if none of them is there any more: whoever has moved the
  /// thing knows it by the proxy that it had.
  Things of_before(const Nominal& phrase) {
    const auto before = antecedents_.find(phrase.name);
    if (!is_pronoun(phrase) || before == antecedents_.end() || scene_.things().empty())
      return {};
    const bool is_there = std::ranges::any_of(scene_.things(), [&](const auto& id) {
      return std::ranges::find(before->second, scene_.proxy_of(id)) != before->second.end();
    });
    return is_there ? Things{} : before->second;
  }

  /// The things of the step before, if there is one that a pronoun can stand for.
  std::optional<Meant> of_step_before(const Nominal& phrase) const {
    if (steps_.empty() || !is_pronoun(phrase) || steps_.back().things.empty())
      return std::nullopt;
    const auto& before = last_;
    const auto count = before.number == 0 ? std::ssize(before.things) : before.number;
    if (is_plural(phrase) != (count > 1))
      return std::nullopt;
    return before;
  }

  Meant things(const Nominal& phrase) {
    auto result = things_of(phrase);
    if (!result.things.empty())
      current_ = result;
    return result;
  }

  Meant things_of(const Nominal& phrase) {
    if (auto before = of_step_before(phrase))
      return *before;
    if (phrase.sort == "conjunction")
      return all_or_one_of(phrase);
    if (phrase.sort != "thing" || vocabulary().surroundings(phrase) != nullptr)
      throw Uninterpretable{Reason::word, phrase.proposition};
    if (auto moved = of_before(phrase); !moved.empty())
      return {std::move(moved), 0};
    if (is_definite_phrase(phrase)) {
      const bool is_others = is_plural(phrase) && is_about_others(form_, phrase);
      if (is_others && !antecedents_.contains(phrase.name) && scene_.open_questions().empty())
        throw Uninterpretable{Reason::ambiguous, phrase.name};
      auto meant = evaluation_.meant(phrase);
      if (meant.size() == 1 && is_others)
        meant = all_but_those_before(phrase);
      return {std::move(meant), 0};
    }
    const auto found = evaluation_.described(phrase).best();
    if (!scene_.open_questions().empty())
      return {};
    const auto number = number_of(phrase, found.size());
    if (found.empty() || std::ssize(found) < number)
      throw Uninterpretable{Reason::nothing_like, phrase.name};
    return {found, number};
  }

  /// "The others" are several: all things, if there are no further ones of the kind spoken of.
  Things all_but_those_before(const Nominal& phrase) {
    const auto before = antecedents_.find(phrase.name);
    auto result = scene_.things();
    if (before != antecedents_.end())
      std::erase_if(result, [&](auto& id) {
        return std::ranges::find(before->second, scene_.proxy_of(id)) != before->second.end();
      });
    return result;
  }

  /// "The ball and a cube"; "the ball or the cube".
  Meant all_or_one_of(const Nominal& phrase) {
    Meant result;
    for (const auto* mode : {"First", "Next"}) {
      auto part = things_of(need(phrase, mode));
      part.things = without(std::move(part.things), result.things);
      if (part.number > 0 && std::ssize(part.things) > part.number)
        part.things.resize(static_cast<std::size_t>(part.number));
      result.things.insert(result.things.end(), part.things.begin(), part.things.end());
    }
    result.number = phrase.proposition == "or" ? 1 : 0;
    return result;
  }

  /// How many of `all` an indefinite phrase means; 0 for all.
  std::int32_t number_of(const Nominal& phrase, std::size_t all) const {
    if (const auto* quantity = dependent(form_, phrase, "Quantity")) {
      if (const auto range = number_range(*quantity))
        return static_cast<std::int32_t>(std::max<std::size_t>(range->least, 1));
      return static_cast<std::int32_t>(std::min<std::size_t>(all, 3)); // several, many
    }
    const auto delimited = feature(phrase, "Delimitation");
    if (delimited == "all" || delimited == "both")
      return 0;
    if (delimited == "none")
      throw Uninterpretable{Reason::word, phrase.proposition};

    if (delimited == "half")
      return static_cast<std::int32_t>((all + 1) / 2);
    if (delimited == "most")
      return static_cast<std::int32_t>(all / 2 + 1);
    if (!is_plural(phrase))
      return 1;
    return delimited.empty() ? 0 : static_cast<std::int32_t>(std::min<std::size_t>(all, 2));
  }

  /// "Next to the ball" is next to the other one, if a ball is to be put there.
  Things landmarks_of(const Nominal& phrase, const Things& patients) {
    try {
      if (auto before = of_step_before(phrase); before && before->things != patients)
        return before->things;
      return things_of(phrase).things;
    } catch (const Uninterpretable& e) {
      if (e.reason != Reason::ambiguous || e.what != phrase.name || is_pronoun(phrase))
        throw;
      auto others = without(evaluation_.described(phrase).certain, patients);
      if (others.size() != 1)
        throw;
      return others;
    }
  }

  const LogicalForm& form_;
  const Antecedents& antecedents_;
  SceneKnowledge& scene_;
  Evaluation evaluation_;
  std::vector<DirectiveStep> steps_;
  /// Unions that the step before was about, and those that this one is.
  Meant last_;
  Meant current_;
};

} // namespace

std::vector<DirectiveStep> steps_asked_for(const DialogueMove& move, const Antecedents& antecedents,
                                           SceneKnowledge& scene) {
  if (!move.problem.empty() || !asks_to_act(move) ||
      !is_handling(move.content, scene.vocabulary().meanings()))
    return {};
  try {
    return steps_of(move.content, antecedents, scene);
  } catch (const Uninterpretable&) {
    return {};
  }
}

std::vector<DirectiveStep> steps_of(const LogicalForm& request, const Antecedents& antecedents,
                                    SceneKnowledge& scene) {
  return StepReader{request, antecedents, scene}.read();
}

} // namespace castor::communication
