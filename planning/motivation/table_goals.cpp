#include "castor/planning/motivation/table_goals.hpp"

#include "castor/planning/motivation/table_places.hpp"
#include "castor/planning/motivation/table_words.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace castor::planning {

namespace {

using communication::DirectivePlace;
using communication::DirectiveStep;
using Things = std::vector<const TableThing*>;

TableGoal refusal(std::string words) {
  return {TableWish::refusal, {}, {}, 0, std::move(words)};
}

std::string listed(const Things& things) {
  std::string result;
  for (std::size_t i = 0; i < things.size(); ++i)
    result += (i == 0 ? "" : i + 1 == things.size() ? " and " : ", ") + things[i]->words;
  return result;
}

std::string are(const Things& things) {
  return things.size() == 1 ? " is" : " are";
}

std::string sentence(std::string words) {
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words + '.';
}

bool is_round(const TableThing& x) {
  const auto shape = x.qualities.find("shape");
  return shape != x.qualities.end() && shape->second == "sphere";
}

class GoalMaker {
public:
  GoalMaker(const DirectiveStep& step, std::span<const TableThing> table)
    : step_(step), table_(table) {
    for (const auto& proxy : step.things)
      if (const auto* x = thing(proxy))
        things_.push_back(x);
  }

  TableGoal make() {
    const auto& action = step_.action;
    if (action == "Stop")
      return {TableWish::stop, {}, {}, 0, "stop"};
    if (action == "Wait")
      return {TableWish::wait, {}, {}, 0, "wait"};
    if (action == "GoOn")
      return {TableWish::go_on, {}, {}, 0, "go on"};
    if (things_.size() < step_.things.size())
      return refusal("I do not see all of that any more.");
    if (action == "Clear")
      return clear();
    if (action == "Sort")
      return sort();
    if (action == "Swap")
      return swap();
    if (action == "PutBack")
      return put_back();
    if (action == "Undo")
      return undo();
    if (action == "Restore")
      return restore();
    if (action == "WhereWas")
      return where_was();
    if (action == "PutDown")
      return put_down();
    if (!step_.places.empty())
      return put();
    if (action == "Take")
      return each("held", "take");
    if (action == "Give")
      return give();
    return action == "Push" ? each("pushed", "push") : refusal("I do not know how to do that.");
  }

private:
  const TableThing* thing(const std::string& proxy) const {
    auto found = std::ranges::find(table_, proxy, &TableThing::proxy);
    if (found == table_.end())
      found = std::ranges::find_if(table_, [&](const TableThing& x) {
        return std::ranges::find(x.former_proxies, proxy) != x.former_proxies.end();
      });
    return found == table_.end() ? nullptr : &*found;
  }

  /// @param result a sentence without its full stop
  TableGoal goal(std::string words, std::string result) {
    if (facts_.empty())
      return refusal("There is nothing to do.");
    std::string formula = "(and";
    for (const auto& x : facts_)
      formula += ' ' + x;
    std::ranges::sort(parts_);
    parts_.erase(std::ranges::unique(parts_).begin(), parts_.end());
    return {TableWish::goal,   formula + ')',    std::move(parts_),
            places_ + 1,       std::move(words), sentence(std::move(result)),
            std::move(spots_), proxies()};
  }

  std::vector<std::string> proxies() const {
    std::vector<std::string> result;
    for (const auto* x : things_)
      result.push_back(x->proxy);
    return result;
  }

  std::string in_part(const TableThing& x, std::string part) {
    ++places_;
    parts_.push_back(part);
    return "(in-part " + x.object + ' ' + std::move(part) + ')';
  }

  /// Of "one of the balls", those that are held already, then those that come first.
  void choose() {
    if (step_.number <= 0)
      return;
    std::ranges::stable_partition(things_, [](const auto* x) { return x->is_held; });
    things_.resize(std::min(things_.size(), static_cast<std::size_t>(step_.number)));
  }

  TableGoal each(const std::string& predicate, const std::string& verb) {
    choose();
    if (predicate == "held" && things_.size() > 1)
      return refusal("I can hold one thing only.");
    for (const auto* x : things_)
      facts_.push_back('(' + predicate + ' ' + x->object + ')');
    return goal(verb + ' ' + listed(things_), predicate == "held"
                                                ? "I hold " + listed(things_) + " now"
                                                : "I have pushed " + listed(things_));
  }

  TableGoal give() {
    // "Hand it over": what it holds.
    if (step_.things.empty())
      hold_held();
    if (things_.empty())
      return refusal("I do not hold anything.");
    choose();
    // Who speaks sits in front.
    for (const auto* x : things_)
      facts_.push_back(in_part(*x, "at-hand"));
    return goal("give you " + listed(things_), "here you are: " + listed(things_));
  }

  void hold_held() {
    for (const auto& x : table_)
      if (x.is_held)
        things_.push_back(&x);
  }

  TableGoal put_down() {
    if (step_.things.empty())
      hold_held();
    std::erase_if(things_, [](const auto* x) { return !x->is_held; });
    if (things_.empty())
      return refusal(step_.things.empty() ? "I do not hold anything." : "I do not hold that.");
    for (const auto* x : things_)
      facts_.push_back(in_part(*x, "table"));
    return goal("put down " + listed(things_), "I have put down " + listed(things_));
  }

  TableGoal put_back() {
    // Of those that may be meant, the one that was moved.
    if (step_.number > 0) {
      const auto moved =
        std::ranges::find_if(things_, [](const auto* x) { return !x->waypoint_before.empty(); });
      if (moved == things_.end())
        return refusal("There is nothing to put back.");
      things_ = {*moved};
    }
    // "In its old place", where "it" may be another thing: that of this one, if it has one.
    if (things_.size() == 1 && !things_.front()->was_moved() && has_landmark_that_was_moved())
      return put();
    // "Both": those that were moved.
    if (std::ranges::any_of(things_, &TableThing::was_moved))
      std::erase_if(things_, [](const auto* x) { return !x->was_moved(); });
    for (const auto* x : things_) {
      if (x->waypoint_before.empty())
        return refusal("I do not know where " + x->words + " was before.");
      facts_.push_back("(= (pos " + x->object + ") " + x->waypoint_before + ')');
    }
    return goal("put " + listed(things_) + " back",
                listed(things_) + are(things_) + " where " + it_was() + " before");
  }

  bool has_landmark_that_was_moved() const {
    if (step_.places.empty() || step_.places.front().landmarks.size() != 1)
      return false;
    const auto* x = thing(step_.places.front().landmarks.front());
    return x != nullptr && x->was_moved();
  }

  TableGoal undo() {
    for (const auto& x : table_)
      if (!x.waypoint_before_goal.empty())
        back_to(x, x.waypoint_before_goal);
    if (things_.empty())
      return refusal("There is nothing to undo.");
    return goal("put " + listed(things_) + " back",
                listed(things_) + are(things_) + " where " + it_was() + " before");
  }

  /// Those that were moved, or all, are where they were before anything was done.
  TableGoal restore() {
    const auto asked = std::exchange(things_, {});
    for (const auto& x : table_) {
      const bool is_asked = asked.empty() || std::ranges::find(asked, &x) != asked.end();
      if (is_asked && x.was_moved() && (x.is_held || x.waypoint != x.waypoint_at_first))
        back_to(x, x.waypoint_at_first);
    }
    if (things_.empty())
      return refusal("I have moved nothing that is not where it was at first.");
    return goal("put " + listed(things_) + " back where " + it_was() + " at first",
                listed(things_) + are(things_) + " where " + it_was() + " at first");
  }

  void back_to(const TableThing& x, const std::string& waypoint) {
    things_.push_back(&x);
    facts_.push_back("(= (pos " + x.object + ") " + waypoint + ')');
  }

  std::string it_was() const { return things_.size() == 1 ? "it was" : "they were"; }

  TableGoal where_was() const {
    std::string result;
    for (const auto* x : things_)
      result +=
        (result.empty() ? "" : " ") +
        (x->was_moved() ? sentence(x->words + " was " + place_in_words(x->spot_before, *x, table_))
                        : sentence("I have not moved " + x->words));
    return {TableWish::answer, {}, {}, 0, std::move(result)};
  }

  TableGoal swap() {
    if (things_.size() != 2)
      return refusal("I can swap two things only.");
    const auto& a = *things_.front();
    const auto& b = *things_.back();
    if (a.is_held || b.is_held)
      return refusal("I cannot swap what I hold.");
    facts_ = {"(= (pos " + a.object + ") " + b.waypoint + ')',
              "(= (pos " + b.object + ") " + a.waypoint + ')'};
    return goal("swap " + listed(things_), listed(things_) + " have changed places");
  }

  /// The part's things go to the other side.
  TableGoal clear() {
    const auto& part = step_.places.front().relation;
    const auto other = words_for(opposites, part);
    if (other.empty())
      return refusal("I have nowhere else to put the things.");
    for (const auto& x : table_)
      if (!x.is_held && std::ranges::find(x.parts, part) != x.parts.end())
        facts_.push_back(in_part(x, std::string{other}));
    if (facts_.empty())
      return refusal("There is nothing " + std::string{words_for(part_words, part)} + '.');
    return goal("clear what is " + std::string{words_for(part_words, part)},
                "there is nothing " + std::string{words_for(part_words, part)} + " any more");
  }

  /// A strip of the table for each value, in the order in which their things lie already.
  TableGoal sort() {
    std::map<std::string, Things> groups;
    for (const auto* x : things_) {
      const auto value = x->qualities.find(step_.by);
      if (value == x->qualities.end() || value->second.empty() || value->second == "unknown")
        return refusal("I do not know the " + step_.by + " of " + x->words + '.');
      groups[value->second].push_back(x);
    }
    if (groups.size() < 2)
      return refusal("They are all of the same " + step_.by + '.');
    std::vector<std::pair<double, Things>> from_left;
    for (auto& [value, group] : groups) {
      double sum = 0;
      for (const auto* x : group)
        sum += x->x;
      from_left.emplace_back(sum / static_cast<double>(group.size()), std::move(group));
    }
    std::ranges::stable_sort(from_left, {}, [](const auto& x) { return x.first; });
    const auto count = std::to_string(from_left.size());
    for (std::size_t i = 0; i < from_left.size(); ++i)
      for (const auto* x : from_left[i].second)
        facts_.push_back(in_part(*x, "strip-" + std::to_string(i + 1) + "-of-" + count));
    return goal("sort the things by " + step_.by, "the things are sorted by " + step_.by + " now");
  }

  // -- put

  TableGoal put() {
    choose();
    const auto verb = (step_.action == "Push" ? "push " : "put ") + listed(things_);
    std::string where;
    for (const auto& place : step_.places) {
      if (place.relation == "where" || place.relation == "where-before")
        return put_where_another_is(place, verb);
      const auto* shift = std::ranges::find(shifts, place.relation, &Shift::relation);
      auto problem = shift != std::end(shifts) ? put_further(*shift, where)
                     : place.landmarks.empty() ? put_in_part(place, where)
                                               : put_at_landmarks(place, where);
      if (problem)
        return refusal(*problem);
    }
    return goal(verb + where, listed(things_) + are(things_) + where + " now");
  }

  /// In the place of something else, which has to leave it, or where that was before.
  TableGoal put_where_another_is(const DirectivePlace& place, const std::string& verb) {
    const auto* other = place.landmarks.size() == 1 ? thing(place.landmarks.front()) : nullptr;
    if (other == nullptr)
      return refusal(place.landmarks.size() == 1 ? "I do not see all of that any more."
                                                 : "It can be in one place only.");
    if (things_.size() > 1)
      return refusal("There is room for one thing only.");
    const auto& x = *things_.front();
    const bool was = place.relation == "where-before";
    const auto& waypoint = was ? other->waypoint_before : other->waypoint;
    if (was && waypoint.empty())
      return refusal("I do not know where " + other->words + " was before.");
    if (other->is_held && !was)
      return refusal("I hold " + other->words + ". Tell me to put it down first.");
    facts_.push_back("(= (pos " + x.object + ") " + waypoint + ')');
    ++places_;
    return goal(verb + " where " + other->words + (was ? " was" : " is"),
                x.words + " is where " + other->words + " was");
  }

  /// \returns why it is impossible
  std::optional<std::string> put_further(const Shift& shift, std::string& where) {
    for (const auto* x : things_) {
      if (x->is_held)
        return "I hold " + x->words + ": tell me where to put it.";
      TableSpot spot{"spot-of-" + x->object, x->x + shift.x, x->y + shift.y};
      for (const auto& other : table_)
        if (!other.is_held && std::ranges::find(things_, &other) == things_.end() &&
            std::hypot(other.x - spot.x, other.y - spot.y) < other.radius + x->radius)
          return sentence(other.words + " is in the way there") + " Take it away first.";
      facts_.push_back("(= (pos " + x->object + ") " + spot.name + ')');
      spots_.push_back(std::move(spot));
    }
    where += ' ' + std::string{shift.words};
    return std::nullopt;
  }

  /// \returns why it is impossible
  std::optional<std::string> put_in_part(const DirectivePlace& place, std::string& where) {
    const auto words = words_for(part_words, place.relation);
    if (words.empty())
      return "I do not know where that is: tell me a part of the table, or a thing that is there.";
    for (const auto* x : things_)
      facts_.push_back(in_part(*x, place.relation));
    where += ' ' + std::string{words};
    return std::nullopt;
  }

  std::optional<std::string> put_at_landmarks(const DirectivePlace& place, std::string& where) {
    const auto* known = std::ranges::find(relation_words, place.relation, &RelationWords::relation);
    if (known == std::end(relation_words))
      return "I cannot put things " + place.relation + " others.";
    Things landmarks;
    for (const auto& proxy : place.landmarks) {
      landmarks.push_back(thing(proxy));
      if (landmarks.back() == nullptr)
        return "I do not see all of that any more.";
    }
    for (const auto* x : things_)
      if (std::ranges::find(landmarks, x) != landmarks.end())
        return "I cannot put " + x->words + ' ' + std::string{known->words} + " itself.";
    where += ' ' + std::string{known->words} + ' ' + listed(landmarks);
    places_ += things_.size();
    if (place.relation == "between" && landmarks.size() != 2)
      return "Between two things, but not between " + std::to_string(landmarks.size()) + '.';
    if (known->predicate == "on" && (landmarks.size() > 1 || things_.size() > 1))
      return landmarks.size() > 1 ? "It can stand on one thing only."
                                  : "There is room for one thing only.";
    if (known->predicate == "on" && is_round(*landmarks.front()))
      return sentence(landmarks.front()->words + " is round: nothing stays on it");
    for (const auto* x : things_) {
      const auto head = '(' + std::string{known->predicate} + ' ' + x->object;
      if (place.relation == "between")
        facts_.push_back(head + ' ' + landmarks[0]->object + ' ' + landmarks[1]->object + ')');
      else
        for (const auto* landmark : landmarks)
          facts_.push_back(head + ' ' + landmark->object + ')');
    }
    return std::nullopt;
  }

  const DirectiveStep& step_;
  std::span<const TableThing> table_;
  Things things_;
  std::vector<std::string> facts_;
  std::vector<std::string> parts_;
  std::vector<TableSpot> spots_;
  std::size_t places_ = 0;
};

} // namespace

TableGoal goal_of(const DirectiveStep& step, std::span<const TableThing> table) {
  return GoalMaker{step, table}.make();
}

std::vector<std::string> unasked_relations(std::string_view formula) {
  std::vector<std::string> result;
  const auto note = [&](std::string_view predicate, std::string_view relation) {
    if (formula.find('(' + std::string{predicate} + ' ') == std::string_view::npos)
      result.push_back("(unasked rel-" + std::string{relation} + ')');
  };
  note("in-part", "in");
  for (const auto& x : relation_words)
    if (x.relation != "in")
      note(x.predicate, x.relation);
  return result;
}

std::string explained(std::string_view action, std::string_view reason) {
  auto result = "I cannot " + std::string{action};
  if (!reason.empty())
    result += ": " + std::string{reason};
  return result.ends_with('.') ? result : result + '.';
}

} // namespace castor::planning
