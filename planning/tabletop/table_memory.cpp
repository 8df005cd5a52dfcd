#include "castor/planning/tabletop/table_memory.hpp"

#include "castor/planning/continual/object_name.hpp"
#include "castor/planning/tabletop/goal_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace castor::planning {

namespace {

using spatial::GroundPoint;
using spatial::WantedPlace;

/// A thing that is so far from its waypoint was moved by somebody, metres.
constexpr double moved_distance = 0.04;

/// Something stood there before; that is not free any more if another thing is nearer, metres.
constexpr double least_room = 0.03;

/// What is that high appears so much farther away, of its height: a camera above the table's front.
constexpr double shift_by_height = 0.6;

constexpr std::size_t most_former_proxies = 16;

constexpr std::size_t most_remembered_moves = 64;

constexpr std::string_view choosing = "reposition-";

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> predicates{
  {{"left", "wp-left-of"},
   {"right", "wp-right-of"},
   {"front", "wp-front-of"},
   {"back", "wp-back-of"},
   {"near", "wp-near"},
   {"away", "wp-away-from"},
   {"between", "wp-between"},
   {"on", "wp-on"}}};

double distance(const GroundPoint& a, const GroundPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

std::string quality(const ThingOnTable& x, std::string_view kind) {
  const auto found = x.qualities.find(kind);
  return found == x.qualities.end() ? std::string{} : found->second;
}

bool look_alike(const ThingOnTable& a, const ThingOnTable& b) {
  return quality(a, "colour") == quality(b, "colour") && quality(a, "shape") == quality(b, "shape");
}

/// Of "(wp-in place-4 elsewhere)".
std::string_view part_of(std::string_view fact) {
  const auto begin = fact.rfind(' ') + 1;
  return fact.substr(begin, fact.size() - begin - 1);
}

/// A waypoint is there.
std::vector<std::string> facts_of(const std::string& waypoint, const WantedPlace& place) {
  if (place.landmarks.empty())
    return {"(wp-in " + waypoint + ' ' + place.relation + ')'};
  const auto known =
    std::ranges::find_if(predicates, [&](const auto& x) { return x.first == place.relation; });
  if (known == predicates.end())
    return {};
  std::vector<std::string> result;
  const auto tell = [&](const auto& landmarks) {
    std::string fact = '(' + std::string{known->second} + ' ' + waypoint;
    for (const auto& name : landmarks)
      fact += ' ' + name;
    result.push_back(fact + ')');
  };
  tell(place.landmarks);
  if (place.relation == "between")
    tell(std::vector<std::string>(place.landmarks.rbegin(), place.landmarks.rend()));
  return result;
}

} // namespace

TableMemory::TableMemory(std::string agent, std::map<std::string, std::string> nouns)
  : agent_(std::move(agent)), nouns_(std::move(nouns)) {
  // nop
}

TableMemory::Thing* TableMemory::find(std::string_view name) {
  const auto found = std::ranges::find(things_, name, &Thing::name);
  return found == things_.end() ? nullptr : &*found;
}

const TableMemory::Thing* TableMemory::thing(std::string_view name) const {
  const auto found = std::ranges::find(things_, name, &Thing::name);
  return found == things_.end() ? nullptr : &*found;
}

const TableMemory::Thing* TableMemory::with_id(std::string_view id) const {
  const auto found = std::ranges::find_if(things_, [&](const Thing& x) { return x.seen.id == id; });
  return found == things_.end() ? nullptr : &*found;
}

void TableMemory::see_as(Thing& known, const ThingOnTable& seen) {
  auto& former = known.former_proxies;
  if (known.seen.proxy != seen.proxy) {
    std::erase(former, seen.proxy);
    former.push_back(known.seen.proxy);
    if (former.size() > most_former_proxies)
      former.erase(former.begin());
  }
  known.seen = seen;
}

/// It is moved away from where it is.
void TableMemory::leave(Thing& x) {
  if (std::exchange(is_unmoved_, false))
    for (auto& y : things_)
      y.waypoint_before_goal.clear();
  if (x.waypoint_before_goal.empty())
    x.waypoint_before_goal = x.waypoint;
  if (x.waypoint_at_first.empty())
    x.waypoint_at_first = x.waypoint;
  x.has_returned = false;
  const bool is_carried = x.name == carried_;
  const bool is_on_its_way = is_carried && has_carried_left_;
  if (!is_on_its_way)
    x.waypoint_before = x.waypoint;
  has_carried_left_ = has_carried_left_ || is_carried;
  // What was taken is put down by the same move.
  if (!x.is_held && !is_on_its_way) {
    ++history_.moves;
    history_.remembered.push_back({x.name, words(x), because_});
    if (history_.remembered.size() > most_remembered_moves)
      history_.remembered.erase(history_.remembered.begin());
  }
  x.on.clear();
}

std::string TableMemory::new_waypoint(GroundPoint place) {
  auto name = "place-" + std::to_string(next_waypoint_++);
  waypoints_[name] = place;
  return name;
}

/// What is seen of it looks otherwise while it is a part of a stack.
void TableMemory::keep_form(Thing& x, const ThingOnTable& before) {
  x.seen.radius = before.radius;
  x.seen.height = before.height;
  x.seen.lengths = before.lengths;
  x.seen.qualities = before.qualities;
}

/// Vision may take a thing that stands on another, or a part of one, for something new: of the
/// colour of one of the stack, and where that appears from above its front.
void TableMemory::see_stacks(std::vector<const ThingOnTable*>& others, std::set<std::string>& seen,
                             const std::set<std::string>& loaded) {
  for (auto& base : things_) {
    if (!loaded.contains(base.name) || !base.on.empty() || base.is_held)
      continue;
    std::vector<Thing*> stack{&base};
    for (std::size_t i = 0; i < stack.size(); ++i)
      for (auto& x : things_)
        if (x.on == stack[i]->name && std::ranges::find(stack, &x) == stack.end())
          stack.push_back(&x);
    double height = 0;
    for (const auto* x : stack)
      height += x->seen.height;
    const auto at = waypoints_.at(base.waypoint);
    const auto is_part_of = [&](const ThingOnTable& other, const Thing& x) {
      const double beside = std::abs(other.place.x - at.x);
      const double behind = other.place.y - at.y;
      return quality(other, "colour") == quality(x.seen, "colour") &&
             beside < base.seen.radius + finger_gap && behind > -base.seen.radius &&
             behind < base.seen.radius + height * shift_by_height;
    };
    for (auto* x : stack) {
      if (seen.contains(x->name))
        continue;
      auto part =
        std::ranges::find_if(others, [&](const auto* other) { return is_part_of(*other, *x); });
      // Vision may see the whole stack as one thing, which is taken for the lowest.
      if (part == others.end() && x == &base)
        part = std::ranges::find_if(
          others, [&](const auto* other) { return distance(other->place, at) < moved_distance; });
      if (part == others.end())
        continue;
      const auto before = x->seen;
      see_as(*x, **part);
      keep_form(*x, before);
      if (x == &base)
        x->seen.place = before.place;
      seen.insert(x->name);
      others.erase(part);
    }
    std::erase_if(others, [&](const auto* other) {
      return std::ranges::any_of(stack, [&](const auto* x) { return is_part_of(*other, *x); });
    });
  }
}

void TableMemory::see(const std::vector<ThingOnTable>& things, bool is_complete) {
  std::vector<const ThingOnTable*> others;
  std::set<std::string> seen;
  std::set<std::string> loaded;
  for (const auto& x : things_)
    if (!x.on.empty())
      loaded.insert(x.on);
  for (const auto& x : things)
    if (auto* known = with_id(x.id) == nullptr ? nullptr : find(with_id(x.id)->name)) {
      const auto before = known->seen;
      see_as(*known, x);
      // Of a stack, vision does not see where one thing ends.
      if (loaded.contains(known->name) || !known->on.empty())
        keep_form(*known, before);
      seen.insert(known->name);
    } else {
      others.push_back(&x);
    }
  see_stacks(others, seen, loaded);
  std::erase_if(things_, [&](Thing& x) {
    if (seen.contains(x.name) || x.is_held || !x.on.empty() || loaded.contains(x.name))
      return false;
    const auto gap = [&](const ThingOnTable* other) {
      return look_alike(*other, x.seen) ? distance(other->place, x.seen.place)
                                        : std::numeric_limits<double>::infinity();
    };
    const auto nearest = std::ranges::min_element(others, {}, gap);
    if (nearest == others.end() || std::isinf(gap(*nearest)))
      return is_complete;
    see_as(x, **nearest);
    others.erase(nearest);
    return false;
  });
  for (auto& x : things_)
    if (x.on.empty() && !x.is_held &&
        distance(waypoints_.at(x.waypoint), x.seen.place) > moved_distance) {
      if (x.name == carried_)
        leave(x);
      x.waypoint = new_waypoint(x.seen.place);
      x.has_returned = false;
    }
  for (const auto* x : others)
    things_.push_back({object_name(x->proxy), *x, new_waypoint(x->place)});
}

std::string TableMemory::words(const Thing& x) const {
  auto result = "the " + quality(x.seen, "colour");
  const auto shape = quality(x.seen, "shape");
  const auto noun = nouns_.find(shape);
  if (result.back() != ' ')
    result += ' ';
  return result + (noun != nouns_.end() ? noun->second : shape.empty() ? "thing" : shape);
}

std::vector<TableThing> TableMemory::things(const std::vector<ThingAtPlace>& places) const {
  std::vector<TableThing> result;
  for (const auto& x : things_) {
    TableThing thing{x.seen.proxy, x.name, x.waypoint, words(x), x.seen.place.x, x.seen.qualities};
    thing.waypoint_before = x.waypoint_before;
    thing.is_held = x.is_held;
    thing.former_proxies = x.former_proxies;
    thing.former_proxies.push_back(hidden_proxy(x.name));
    thing.waypoint_before_goal = x.waypoint_before_goal;
    thing.y = x.seen.place.y;
    thing.radius = x.seen.radius;
    thing.waypoint_at_first = x.waypoint_at_first;
    thing.is_kept = x.is_kept;
    thing.is_kept_clear = x.is_kept_clear;
    thing.height = x.seen.height;
    thing.on = x.on;
    thing.waypoint_noted = x.waypoint_noted;
    thing.has_returned = x.has_returned;
    thing.is_last_moved =
      !history_.remembered.empty() && history_.remembered.back().object == x.name;
    if (const auto* before = place(x.waypoint_before))
      thing.spot_before = {x.waypoint_before, before->x, before->y};
    for (const auto& at : places)
      if (at.id == x.seen.id && at.place.landmarks.empty())
        thing.parts.push_back(at.place.relation);
    result.push_back(std::move(thing));
  }
  return result;
}

AchieveGoal TableMemory::begin(const TableGoal& goal, const std::string& because) {
  because_ = because;
  chosen_.clear();
  done_.clear();
  put_there_.clear();
  in_way_.clear();
  is_unmoved_ = true;
  carried_.clear();
  push_distance_ = goal.push_distance;
  is_return_ = goal.is_return;
  pushed_to_.clear();
  AchieveGoal result{goal.formula};
  for (const auto& x : goal.spots) {
    const auto name = new_waypoint({x.x, x.y});
    if (goal.push_distance > 0)
      pushed_to_.insert(name);
    const auto end = x.name + ')';
    for (auto at = result.goal.find(end); at != std::string::npos; at = result.goal.find(end, at))
      result.goal.replace(at, x.name.size(), name);
  }
  for (const auto& part : goal.parts)
    result.objects.push_back({part, "part"});
  for (std::size_t i = 0; i < goal.new_places; ++i)
    result.objects.push_back({"place-" + std::to_string(next_waypoint_++), "waypoint"});
  goal_ = result.goal;
  return result;
}

void TableMemory::keep(const TableGoal& goal) {
  for (auto& x : things_) {
    if (std::ranges::find(goal.things, x.seen.proxy) == goal.things.end())
      continue;
    const bool is_allowed = goal.wish == TableWish::allow;
    x.is_kept = !is_allowed && (x.is_kept || goal.wish == TableWish::keep);
    x.is_kept_clear = !is_allowed && (x.is_kept_clear || goal.wish == TableWish::keep_clear);
  }
}

void TableMemory::note_places() {
  for (auto& x : things_)
    x.waypoint_noted = x.is_held ? std::string{} : x.waypoint;
}

bool TableMemory::is_free(const std::string& waypoint, std::string_view goal) const {
  return std::ranges::none_of(things_, [&](const Thing& x) {
    // What is to be moved there, or somewhere else, may be near it.
    const auto wanted = waypoint_wanted(goal, x.name);
    const bool may_be_near = !wanted.empty() && wanted != x.waypoint;
    return !x.is_held && (x.waypoint == waypoint || (is_near(x, waypoint) && !may_be_near));
  });
}

bool TableMemory::is_near(const Thing& x, const std::string& waypoint) const {
  return distance(x.seen.place, waypoints_.at(waypoint)) < x.seen.radius + least_room;
}

/// What the goal moves somewhere else has to leave before another is put nearly where it is.
void TableMemory::tell_order(std::string_view goal, StateReply& reply) const {
  const auto has_to_wait = [&](const Thing& x, const Thing& other) {
    const std::string wanted{waypoint_wanted(goal, x.name)};
    const auto leaves_for = waypoint_wanted(goal, other.name);
    const double room = x.seen.radius + other.seen.radius + finger_gap;
    return x.name != other.name && !other.is_held && wanted != x.waypoint && !leaves_for.empty() &&
           leaves_for != other.waypoint && wanted != other.waypoint &&
           waypoints_.contains(wanted) && distance(waypoints_.at(wanted), other.seen.place) < room;
  };
  for (const auto& x : things_)
    for (const auto& other : things_)
      if (has_to_wait(x, other) && !has_to_wait(other, x))
        reply.facts.push_back("(in-way " + other.name + ' ' + x.name + ')');
}

void TableMemory::tell_place(const std::string& waypoint, const WantedPlace& place,
                             StateReply& reply) {
  for (auto& fact : facts_of(waypoint, place))
    reply.facts.push_back(std::move(fact));
}

void TableMemory::tell_thing(const Thing& x, StateReply& reply) const {
  reply.objects.push_back({x.name, "thing"});
  reply.facts.push_back("(= (pos " + x.name + ") " + (x.is_held ? "hand" : x.waypoint) + ')');
  if (x.is_kept)
    reply.facts.push_back("(kept " + x.name + ')');
  if (quality(x.seen, "shape") == "sphere" || x.is_kept_clear || x.is_kept)
    reply.facts.push_back("(no-flat-top " + x.name + ')');
  if (!x.is_held)
    reply.objects.push_back({x.waypoint, "waypoint"});
  if (!x.on.empty())
    tell_place(x.waypoint, {"on", {x.on}}, reply);
}

StateReply TableMemory::state(std::string_view goal,
                              const std::vector<ThingAtPlace>& places) const {
  StateReply result;
  result.objects.push_back({agent_, "agent"});
  for (const auto& x : things_)
    tell_thing(x, result);
  for (const auto& [name, place] : waypoints_) {
    const bool is_wanted =
      contains_word(goal, name) || std::ranges::any_of(things_, [&name = name](const Thing& x) {
        return x.waypoint_before == name;
      });
    const bool is_used = is_wanted && is_free(name, goal);
    if (is_wanted)
      result.objects.push_back({name, "waypoint"});
    if (is_used)
      result.facts.push_back("(used " + name + ')');
    const auto is_here = [&name = name](const Thing& x) {
      return x.waypoint == name && !x.is_held;
    };
    if (!contains_word(goal, name) && (is_used || std::ranges::any_of(things_, is_here)))
      result.facts.push_back("(unwanted " + name + ')');
  }
  for (const auto& at : places) {
    const auto* x = with_id(at.id);
    auto place = at.place;
    bool are_known = x != nullptr && !x->is_held && x->on.empty();
    for (auto& landmark : place.landmarks) {
      const auto* other = with_id(landmark);
      are_known = are_known && other != nullptr && !other->is_held && other->on.empty();
      if (are_known)
        landmark = other->name;
    }
    if (!are_known)
      continue;
    for (auto& fact : facts_of(x->waypoint, place))
      // What is too far from its landmark is to be brought nearer, unless it was put there.
      if (at.is_close || put_there_.contains(fact))
        result.facts.push_back(std::move(fact));
  }
  for (const auto& [waypoint, wanted] : chosen_) {
    result.objects.push_back({waypoint, "waypoint"});
    result.facts.push_back("(chosen " + waypoint + ')');
    for (const auto& place : wanted)
      if (!place.landmarks.empty() || contains_word(goal, place.relation))
        tell_place(waypoint, place, result);
  }
  const auto is_movable = [&](const std::string& name) {
    return thing(name) != nullptr && is_subject(goal, name);
  };
  for (auto& x : in_way_.facts(is_movable))
    result.facts.push_back(std::move(x));
  tell_order(goal, result);
  const auto unasked = unasked_relations(goal);
  result.facts.insert(result.facts.end(), unasked.begin(), unasked.end());
  for (const auto& x : done_)
    if (!x.starts_with("(wp-in ") || contains_word(goal, part_of(x)))
      result.facts.push_back(x);
  std::ranges::sort(result.facts);
  result.facts.erase(std::ranges::unique(result.facts).begin(), result.facts.end());
  std::ranges::sort(result.objects, {}, &StateObject::name);
  result.objects.erase(std::ranges::unique(result.objects).begin(), result.objects.end());
  return result;
}

void TableMemory::choose(const std::string& step, const std::vector<std::string>& arguments) {
  auto& wanted = chosen_[arguments.at(0)];
  auto relation = step.substr(choosing.size());
  if (relation == "in")
    wanted.push_back({arguments.at(1), {}});
  else if (relation == "free")
    // Something else may be put where it is.
    wanted.push_back({"elsewhere", {}});
  else
    wanted.push_back({std::move(relation), {arguments.begin() + 1, arguments.end()}});
}

std::vector<WantedPlace> TableMemory::chosen(const std::string& waypoint) const {
  const auto found = chosen_.find(waypoint);
  return found == chosen_.end() ? std::vector<WantedPlace>{} : found->second;
}

const GroundPoint* TableMemory::place(const std::string& waypoint) const {
  const auto found = waypoints_.find(waypoint);
  return found == waypoints_.end() ? nullptr : &found->second;
}

const GroundPoint* TableMemory::wanted_place(std::string_view name) const {
  return place(std::string{waypoint_wanted(goal_, name)});
}

void TableMemory::carries(const std::string& name) {
  if (carried_ != name)
    has_carried_left_ = false;
  carried_ = name;
}

void TableMemory::moved(const std::string& name, const std::string& waypoint, const std::string& id,
                        GroundPoint place) {
  auto* x = find(name);
  if (x == nullptr)
    return;
  const auto wanted = chosen(waypoint);
  chosen_.erase(waypoint);
  leave(*x);
  carried_.clear();
  in_way_.moved(name);
  x->waypoint = waypoint;
  x->has_returned = is_return_;
  x->is_held = false;
  x->seen.place = place;
  x->seen.id = id;
  waypoints_[waypoint] = place;
  for (const auto& y : wanted)
    if (y.relation == "on" && !y.landmarks.empty())
      x->on = y.landmarks.front();
    else if (y.landmarks.empty() && !is_seen_part(y.relation))
      // That it is elsewhere is known by what was done only.
      done_.insert("(wp-in " + waypoint + ' ' + y.relation + ')');
    else if (!y.landmarks.empty())
      // As near to its landmarks as there was room.
      for (auto& fact : facts_of(waypoint, y))
        put_there_.insert(std::move(fact));
}

void TableMemory::taken(const std::string& name) {
  if (auto* x = find(name)) {
    leave(*x);
    in_way_.moved(name);
    x->is_held = true;
  }
}

void TableMemory::holds(std::string_view id) {
  for (auto& x : things_)
    x.is_held = x.is_held && x.seen.id == id;
  if (const auto* x = with_id(id); x != nullptr && !x->is_held)
    taken(x->name);
}

void TableMemory::released() {
  for (auto& x : things_)
    x.is_held = false;
}

void TableMemory::pushed(const std::string& name) {
  done_.insert("(pushed " + name + ')');
}

void TableMemory::refused(const std::string& name, const std::vector<std::string>& in_way) {
  std::vector<std::string> others;
  for (const auto& id : in_way) {
    const auto* x = with_id(id);
    if (x == nullptr)
      return;
    others.push_back(x->name);
  }
  in_way_.refused(name, std::move(others));
}

} // namespace castor::planning
