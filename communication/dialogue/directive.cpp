#include "castor/communication/dialogue/directive.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/directive_places.hpp"
#include "castor/communication/dialogue/directive_sequence.hpp"
#include "castor/communication/dialogue/directive_things.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/stacks.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/numerals.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using Reason = Uninterpretable::Reason;
using Things = std::vector<std::string>;
using Meant = MeantThings;

/// "Do not touch it", "leave it alone": what it is not to do with a thing at all.
bool is_about_touching(std::string_view verb) {
  constexpr std::array<std::string_view, 9> verbs{"touch", "move",  "take",   "push",  "put",
                                                  "hold",  "reach", "remove", "forbid"};
  return std::ranges::find(verbs, verb) != verbs.end();
}

/// Where a thing is not.
constexpr std::string_view opposite_side = "opposite-side";

/// What things are put in a row by.
bool is_measure(std::string_view by) {
  return by.starts_with("height") || by.starts_with("width") || by.starts_with("volume");
}

/// A triangle is a ring of three.
bool is_formation(std::string_view relation) {
  return is_arrangement(relation) || relation == "in-triangle";
}

class StepReader {
public:
  StepReader(const LogicalForm& form, const Antecedents& antecedents, SceneKnowledge& scene)
    : form_(form), scene_(scene), meant_(form, antecedents, scene) {}

  std::vector<DirectiveStep> read() {
    const auto* root = find_nominal(form_, form_.root);
    for (const auto& x : form_.nominals)
      if (x.sort == "conjunction" && is_negated(x) && feature(x, "Mood") == "imp")
        throw Uninterpretable{Reason::word, x.proposition};
    for_each_action(form_, *root, [this](auto& x) { add(x); });
    return taken_together(std::move(steps_), form_, vocabulary());
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
    if (x.sort != "action")
      throw Uninterpretable{Reason::word, x.proposition};
    // "Do not take the ball and put it down": it is not clear how far "not" goes.
    if (was_negated_ && !is_negated(x))
      throw Uninterpretable{Reason::word, "not"};
    // "If it is small, take it, otherwise leave it alone."
    if (const auto* otherwise = dependent(form_, x, "Otherwise")) {
      const auto& condition = need(x, "Condition");
      const auto truth = meant_.evaluation().clause(condition);
      if (truth == Truth::no && scene_.open_questions().empty()) {
        meant_.note_clause(condition);
        return add(*otherwise);
      }
    }
    if (is_why_others_take_back(x))
      return;
    check_clauses(x);
    DirectiveStep step;
    if (forbids(x)) {
      if (!read_prohibition(x, step))
        return;
      was_negated_ = is_negated(x);
    } else if (is_permission(x)) {
      step.action = action_for("allow");
      take(meant_.things(need(x, "Patient")), need(x, "Patient"), step);
    } else
      read_request(x, step);
    // "Leave the balls alone and move the others. Now the balls as well", "now you may move it
    // there".
    const bool allows = feature(x, "Allows") == "true" || feature(x, "Permission") == "true";
    if (allows && !is_permission(x) && !step.things.empty() && step.number == 0 &&
        vocabulary().meanings().actions.contains("allow"))
      steps_.push_back({action_for("allow"), step.things, 0, {}, std::string{by_the_way}});
    do_first(x, step);
    steps_.push_back(std::move(step));
    meant_.end_step(!steps_.back().things.empty());
  }

  /// "I liked it better before, undo that" asks for that once.
  bool is_why_others_take_back(const Nominal& x) const {
    return feature(x, "Implied") == "true" &&
           std::ranges::any_of(form_.nominals, [&](const Nominal& other) {
             return other.sort == "action" && feature(other, "Implied").empty() &&
                    is_among(other.proposition, {"undo", "put-back", "restore"});
           });
  }

  /// "Give me the balls, beginning with the red one": that one first, and then the others.
  void do_first(const Nominal& x, DirectiveStep& step) {
    const auto* first = dependent(form_, x, "Leftmost");
    const bool is_row =
      !step.by.empty() || std::ranges::any_of(step.places, [](const DirectivePlace& place) {
        return is_formation(place.relation);
      });
    if (first == nullptr || is_row || step.number != 0 || step.things.size() < 2)
      return;
    const auto named = meant_.proxies(meant_.landmarks_of(*first, {}));
    if (named.size() != 1 || std::erase(step.things, named.front()) == 0)
      throw Uninterpretable{Reason::nothing_like, first->name};
    auto alone = step;
    alone.things = named;
    steps_.push_back(std::move(alone));
  }

  void read_request(const Nominal& x, DirectiveStep& step) {
    const bool is_same = x.proposition == "same";
    // "Give me the ball, and do the same with the cube."
    if (feature(x, "Repeats") == "true" && !steps_.empty() && steps_.back().places.empty() &&
        is_among(steps_.back().action, {action_for("give"), action_for("put-back")})) {
      step.action = steps_.back().action;
      return take(meant_.things(need(x, "Patient")), need(x, "Patient"), step);
    }
    // "Push the ball and the cube to the left" has no place of its own for the ball.
    if (is_same && !steps_.empty() && steps_.back().places.empty())
      throw Uninterpretable{Reason::word, x.proposition};
    if (is_same)
      step.action = steps_.empty() ? action_for("put") : steps_.back().action;
    else
      step.action = action_for(x.proposition);
    if (is_same && dependent(form_, x, "Patient") == nullptr)
      throw Uninterpretable{Reason::word, x.proposition};
    const auto* destination = x.proposition == "sort" ? nullptr : destination_of(x);
    if (destination != nullptr)
      read_destination(x, *destination, step);
    else
      read_without_destination(x, step);
  }

  /// "Get the ball out of the way" gives it to nobody.
  const Nominal* destination_of(const Nominal& x) const {
    const auto* recipient = dependent(form_, x, "Recipient");
    const bool is_place = recipient != nullptr && recipient->sort == "place" &&
                          recipient->proposition != "here" && recipient->proposition != "home";
    const auto* anchor = is_place ? dependent(form_, *recipient, "Anchor") : nullptr;
    if (is_place && (anchor == nullptr || anchor->sort == "place"))
      return recipient;
    return dependent(form_, x, "Destination");
  }

  /// "If the ball is on the left, ...", "because it is in my way, ...".
  void check_clauses(const Nominal& x) {
    if (const auto* reason = dependent(form_, x, "Reason"))
      meant_.note_clause(*reason);
    const auto* condition = dependent(form_, x, "Condition");
    if (condition == nullptr)
      return;
    const auto truth = meant_.evaluation().clause(*condition);
    if (truth != Truth::yes && scene_.open_questions().empty())
      throw Uninterpretable{truth == Truth::no ? Reason::not_so : Reason::unknown, condition->name};
    meant_.note_clause(*condition);
  }

  // -- what is not to be done

  /// \returns false if it says nothing of its own: "... and move nothing else"
  bool read_prohibition(const Nominal& x, DirectiveStep& step) {
    const auto& patient = need(x, "Patient");
    const auto* destination = dependent(form_, x, "Destination");
    step.action = action_for("forbid");
    // "Do not put anything on the box."
    if (destination != nullptr) {
      const auto delimited = feature(patient, "Delimitation");
      const bool is_anything =
        (delimited == "any" || delimited == "none") && vocabulary().is_general(patient.proposition);
      // "Do not stack anything, just ...": nothing is stacked without need.
      if (is_anything && destination->proposition == "on-each-other" && is_part_of_several())
        return false;
      const auto places = places_named(form_, *destination, vocabulary());
      if (!is_anything || places.size() != 1 || places.front().relation != "on" ||
          places.front().landmark == nullptr)
        throw Uninterpretable{Reason::word, x.proposition};
      step.places.push_back({"on", {}});
      take(meant_.things(*places.front().landmark), *places.front().landmark, step);
      return true;
    }
    if (!is_about_touching(x.proposition))
      throw Uninterpretable{Reason::word, x.proposition};
    // Nothing else is moved without need.
    if (is_about_others(form_, patient) && is_part_of_several())
      return false;
    auto meant = meant_.things(patient);
    // "Any ball" is all of them here.
    meant.number = 0;
    take(meant, patient, step);
    return true;
  }

  bool is_part_of_several() const { return find_nominal(form_, form_.root)->sort == "conjunction"; }

  /// "You may touch the ball again."
  bool is_permission(const Nominal& x) const {
    const bool is_alone = dependent(form_, x, "Destination") == nullptr;
    return x.proposition == "allow" || (x.proposition == "touch" && is_alone) ||
           (feature(x, "Permission") == "true" && x.proposition == "move" && is_alone);
  }

  // -- kinds of steps

  void read_destination(const Nominal& x, const Nominal& destination, DirectiveStep& step) {
    const auto& patient = need(x, "Patient");
    // "Get everything off the left side."
    const auto* anchor = dependent(form_, destination, "Anchor");
    if (destination.proposition == "away" && anchor != nullptr && anchor->sort == "place") {
      // "The things" are those that are there.
      const bool is_all_there = is_plural(patient) && vocabulary().is_general(patient.proposition);
      if (!is_everything(patient) && !is_all_there)
        return read_away_from_part(patient, *anchor, step);
      step.action = action_for("clear");
      return read_clearing(*anchor, step);
    }
    if (is_its_own_place(patient, destination)) {
      step.action = action_for("put-back");
      return take(meant_.one_of_like(patient), patient, step);
    }
    // "In its old place" may be that of the thing itself: who knows what was moved decides.
    const bool is_its_or_own = destination.proposition == "place-before-of" && anchor != nullptr &&
                               is_pronoun(*anchor) &&
                               vocabulary().meanings().actions.contains("put-back");
    if (is_its_or_own)
      step.action = action_for("put-back");
    else if (step.action != action_for("push"))
      step.action = action_for("put");
    auto meant = meant_.things(patient);
    // "Take the largest thing on the left" says which, if it is on the left.
    const bool is_bare_one = patient.proposition == "one" && patient.relations.empty();
    if (x.proposition == "take-to" && !is_pronoun(patient) &&
        (is_bare_one || are_in_part(meant, destination)))
      throw Uninterpretable{Reason::word, destination.proposition};
    // "Take the tower apart": what stands on something comes onto the table.
    if (destination.proposition == "apart" && is_tower(patient) && meant.things.size() > 1) {
      meant.things.erase(meant.things.begin());
      step.places.push_back({"table", {}});
      return take(meant, patient, step);
    }
    if (destination.proposition == "near-each-other")
      return read_gathering(meant, step);
    if (destination.proposition == "on-each-other")
      return read_stacking(patient, meant_.in_stacking_order(patient, x, std::move(meant)), step);
    if (is_formation(destination.proposition))
      return read_arrangement(x, meant, destination, step);
    if (destination.proposition == "gap")
      return read_gap(meant, x, step);
    if (destination.sort == "conjunction")
      for (const auto& [how, where] : {std::pair{"First", "Next"}, std::pair{"Next", "First"}}) {
        const auto& arrangement = need(destination, how);
        if (arrangement.proposition == "near-each-other")
          return read_gathering_at(meant, need(destination, where), step);
        if (is_formation(arrangement.proposition)) {
          read_arrangement(x, meant, arrangement, step);
          read_places(need(destination, where), meant, step);
          return;
        }
      }
    const auto landmarks = read_places(destination, meant, step);
    meant_.note_landmarks(landmarks);
    if (landmarks.size() == 1 && step.places.front().relation == "on")
      meant_.note_stack(landmarks.front());
    // "A cube on each side of the disc" are two.
    if (step.places.front().relation == "both-sides" && meant.number == 1 &&
        meant.things.size() > 1)
      meant.number = 2;
    // "Put everything next to the disc" moves all but the disc.
    if (!is_definite(patient) || is_plural(patient))
      meant.things = all_but(std::move(meant.things), landmarks);
    take(meant, patient, step);
  }

  /// Whether all of them are on that side of the table.
  bool are_in_part(const Meant& meant, const Nominal& part) const {
    // "To the left" is where it is to go.
    if (part.sort != "region" || !feature(part, "Of").empty() ||
        dependent(form_, part, "Anchor") != nullptr)
      return false;
    constexpr double middle = 0.08;
    return std::ranges::all_of(meant.things, [&](const std::string& id) {
      const auto at = scene_.place_in_view(id);
      const auto& side = part.proposition;
      return at && ((side == "left" && at->x < 0) || (side == "right" && at->x > 0) ||
                    (side == "front" && at->y < 0) || (side == "back" && at->y > 0) ||
                    (side == "centre" && std::hypot(at->x, at->y) < middle));
    });
  }

  /// \returns the landmarks of the places
  Things read_places(const Nominal& destination, const Meant& meant, DirectiveStep& step) {
    Things result;
    for (const auto& place : places_named(form_, destination, vocabulary())) {
      Things others;
      if (place.landmark != nullptr)
        others = landmarks_of(place, meant);
      step.places.push_back(
        {place.relation == opposite_side ? side_opposite_to(meant) : place.relation,
         meant_.proxies(others), place.distance});
      result.insert(result.end(), others.begin(), others.end());
    }
    return result;
  }

  /// "The ball to the left of the cube, and the disc to the right of it": of the cube.
  Things landmarks_of(const PlacePhrase& place, const Meant& meant) {
    const auto& before = meant_.landmarks_before();
    const bool is_parallel = !steps_.empty() && steps_.back().places.size() == 1 &&
                             opposite_of(steps_.back().places.front().relation) == place.relation;
    if (is_parallel && before.size() == 1 && is_pronoun(*place.landmark) &&
        !is_plural(*place.landmark))
      return before;
    return meant_.landmarks_of(*place.landmark, meant.things);
  }

  /// "On the other side of the table", of a thing.
  std::string side_opposite_to(const Meant& meant) const {
    const auto place =
      meant.things.empty() ? std::nullopt : scene_.place_in_view(meant.things.front());
    return place && place->x < 0 ? "right" : "left";
  }

  /// "Together on the left": the first one is put there, and the others next to it.
  void read_gathering_at(const Meant& meant, const Nominal& where, DirectiveStep& step) {
    read_gathering(meant, step);
    if (step.things.empty())
      return;
    DirectiveStep first{step.action, step.places.front().landmarks, 0, {}, {}};
    read_places(where, meant, first);
    step.places.insert(step.places.end(), first.places.begin(), first.places.end());
    steps_.push_back(std::move(first));
  }

  /// "Move the ball away from the edge": not everything that is there.
  void read_away_from_part(const Nominal& patient, const Nominal& part, DirectiveStep& step) {
    const auto from = part_named(form_, part, vocabulary());
    if (from.landmark != nullptr)
      throw Uninterpretable{Reason::word, part.proposition};
    step.action = action_for("put");
    step.places.push_back({part_away_from(from.relation), {}});
    take(meant_.things(patient), patient, step);
  }

  /// Whether "in its old place" is the place where the thing itself was, not another one.
  bool is_its_own_place(const Nominal& patient, const Nominal& destination) {
    const auto* anchor = dependent(form_, destination, "Anchor");
    if (destination.proposition != "place-before-of" || anchor == nullptr || !is_pronoun(*anchor))
      return false;
    if (is_pronoun(patient))
      return true;
    try {
      return meant_.landmarks_of(*anchor, {}) == meant_.things_of(patient).things;
    } catch (const Uninterpretable& e) {
      if (e.what != anchor->name)
        throw;
      return true;
    }
  }

  /// "Next to each other": the others next to the first one.
  void read_gathering(const Meant& meant, DirectiveStep& step) {
    auto gathered = meant_.proxies(meant.things);
    if (meant.number > 0 && std::ssize(gathered) > meant.number)
      gathered.resize(static_cast<std::size_t>(meant.number));
    if (gathered.size() < 2 && scene_.open_questions().empty())
      throw Uninterpretable{Reason::word, "near-each-other"};
    if (gathered.empty())
      return;
    step.places.push_back({"near", {gathered.front()}});
    step.things.assign(gathered.begin() + 1, gathered.end());
  }

  /// Each on the one before.
  void read_stacking(const Nominal& patient, const Meant& meant, DirectiveStep& step) {
    // "A tower of three blocks" is of the best of them.
    if (meant.number > 0 && meant.number < std::ssize(meant.things)) {
      Meant some = meant;
      some.things.resize(static_cast<std::size_t>(meant.number));
      some.number = 0;
      return read_stacking(patient, some, step);
    }
    const auto stacked = meant_.proxies(meant.things);
    if (stacked.size() < 2 && scene_.open_questions().empty())
      throw Uninterpretable{Reason::word, "on-each-other"};
    if (!meant.things.empty())
      meant_.note_stack(meant.things.front());
    for (std::size_t i = 1; i < stacked.size(); ++i) {
      DirectiveStep next{step.action, {stacked[i]}, 0, {{"on", {stacked[i - 1]}}}, {}};
      if (i + 1 < stacked.size())
        steps_.push_back(std::move(next));
      else
        step = std::move(next);
    }
  }

  /// "Leave 3 cm between the cubes": the second that far from the first.
  void read_gap(const Meant& meant, const Nominal& x, DirectiveStep& step) {
    const auto two = meant_.proxies(meant.things);
    if (two.size() != 2 && scene_.open_questions().empty())
      throw Uninterpretable{Reason::word, "between"};
    if (two.size() != 2)
      return;
    step.things = {two.back()};
    step.places.push_back(
      {"near", {two.front()}, metres_of_centimetres(need(x, "Gap").proposition)});
  }

  void read_arrangement(const Nominal& x, const Meant& meant, const Nominal& destination,
                        DirectiveStep& step) {
    const auto& wanted = destination.proposition;
    const bool is_triangle = wanted == "in-triangle";
    const bool are_too_few = meant.things.size() < 2 || (is_triangle && meant.things.size() != 3);
    if (are_too_few && scene_.open_questions().empty())
      throw Uninterpretable{Reason::word, wanted};
    const auto in_order =
      wanted.starts_with("in-row") ? meant_.from_left(x, meant.things) : std::nullopt;
    step.places.push_back({in_order ? "in-row-as-named" : is_triangle ? "in-ring" : wanted, {}});
    step.things = meant_.proxies(in_order.value_or(meant.things));
    step.number = meant.number < std::ssize(meant.things) ? meant.number : 0;
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
    const bool tells_itself = x.proposition == "drop" || x.proposition == "put-back" ||
                              x.proposition == "how-far-moved" || x.proposition == "where-was";
    const auto meant = tells_itself ? meant_.one_of_like(*patient) : meant_.things(*patient);
    take(meant, *patient, step);
    if (x.proposition == "how-tall" && is_tower(*patient) && step.things.size() > 1)
      step.by = as_tower;
    // "How far is the ball from the cube?"
    if (const auto* other = dependent(form_, x, "Counterpart"))
      for (auto& id : meant_.proxies(meant_.landmarks_of(*other, meant.things)))
        step.things.push_back(std::move(id));
  }

  /// "Put everything back", but not "all of them" or "all balls".
  bool is_everything(const Nominal& phrase) const {
    return feature(phrase, "Delimitation") == "all" && phrase.relations.empty() &&
           vocabulary().is_general(phrase.proposition) && !is_pronoun(phrase) &&
           vocabulary().meanings().actions.contains("restore");
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
    // "By size, biggest first."
    constexpr std::string_view down = "-down";
    if (by != nullptr && is_measure(step.by)) {
      const auto* order = dependent(form_, *by, "Order");
      const auto& first = order == nullptr ? *by : *order;
      const bool is_down = first.proposition.ends_with("down");
      if (step.by.ends_with(down))
        step.by.resize(step.by.size() - down.size());
      step.by += is_down != (feature(first, "End") == "right") ? down : "";
    }
    if (!is_measure(step.by) && !vocabulary().kind_of_quality(step.by))
      throw Uninterpretable{Reason::word, step.by};
    Meant meant{scene_.things(), 0};
    if (patient != nullptr)
      try {
        meant = meant_.things(*patient);
      } catch (const Uninterpretable& e) {
        // "Sort them": all there are, if nothing was spoken of.
        if (!is_pronoun(*patient) || e.reason != Reason::ambiguous)
          throw;
      }
    step.things = meant_.proxies(meant.things);
    const auto* destination = dependent(form_, x, "Destination");
    if (destination == nullptr)
      return;
    // Groups of a colour have no place together.
    if (!is_measure(step.by))
      throw Uninterpretable{Reason::word, destination->proposition};
    for (const auto& place : places_named(form_, *destination, vocabulary())) {
      if (place.landmark != nullptr)
        throw Uninterpretable{Reason::word, destination->proposition};
      step.places.push_back({place.relation, {}});
    }
  }

  void read_swapping(const Nominal& x, DirectiveStep& step) {
    const auto& patient = need(x, "Patient");
    auto both = meant_.things(patient).things;
    if (const auto* other = dependent(form_, x, "Counterpart"))
      for (auto& id : meant_.landmarks_of(*other, both))
        both.push_back(id);
    if (scene_.open_questions().empty() && both.size() != 2)
      throw Uninterpretable{both.size() < 2 ? Reason::nothing_like : Reason::ambiguous,
                            patient.name};
    step.things = meant_.proxies(both);
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
    step.things = meant_.proxies(meant.things);
    step.number = meant.number < std::ssize(meant.things) ? meant.number : 0;
  }

  const LogicalForm& form_;
  SceneKnowledge& scene_;
  DirectiveThings meant_;
  std::vector<DirectiveStep> steps_;
  bool was_negated_ = false;
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
