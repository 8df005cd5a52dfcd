#include "castor/planning/motivation/table_goal_maker.hpp"

#include "castor/planning/motivation/table_groups.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace castor::planning {

TableGoal refusal(std::string words) {
  return {TableWish::refusal, {}, {}, 0, std::move(words)};
}

std::string listed(const std::vector<const TableThing*>& things, std::string_view last) {
  std::string result;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (i > 0)
      result += i + 1 == things.size() ? ' ' + std::string{last} + ' ' : ", ";
    result += things[i]->words;
  }
  return result;
}

std::string are(const std::vector<const TableThing*>& things) {
  return things.size() == 1 ? " is" : " are";
}

std::string at_waypoint(const TableThing& x, const std::string& waypoint) {
  return "(= (pos " + x.object + ") " + waypoint + ')';
}

std::string sentence(std::string words) {
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words + '.';
}

TableGoalMaker::TableGoalMaker(const DirectiveStep& step, std::span<const TableThing> table,
                               TableReach reach, TableExchange exchange, TableLanding landing)
  : step_(step), table_(table), room_(table, std::move(reach), std::move(landing)),
    exchange_(std::move(exchange)) {
  for (const auto& proxy : step.things)
    if (const auto* x = thing(proxy))
      things_.push_back(x);
}

TableGoal TableGoalMaker::make() {
  const auto& action = step_.action;
  if (action == "Stop")
    return {TableWish::stop, {}, {}, 0, "stop"};
  if (action == "Wait")
    return {TableWish::wait, {}, {}, 0, "wait"};
  if (action == "GoOn")
    return {TableWish::go_on, {}, {}, 0, "go on"};
  if (things_.size() < step_.things.size())
    return refusal("I do not see all of that any more.");
  if (is_question(action))
    return answer_question();
  if (action == "Note")
    return {TableWish::note, {}, {}, 0, "I will remember how the things lie now."};
  if (action == "Forbid" || action == "Allow")
    return manage();
  return leave_kept();
}

/// What may be done, and what may not.
TableGoal TableGoalMaker::manage() {
  if (step_.action == "Allow") {
    const bool was_kept =
      std::ranges::any_of(things_, [](const auto* x) { return x->is_kept || x->is_kept_clear; });
    if (!was_kept)
      return refusal("I was not told to keep away from " + listed(things_) + '.');
    return {TableWish::allow, {}, {}, 0, "Then I may touch " + listed(things_) + " again.", {}, {},
            proxies()};
  }
  if (!step_.places.empty())
    return {TableWish::keep_clear,
            {},
            {},
            0,
            "I will put nothing on " + listed(things_) + '.',
            {},
            {},
            proxies()};
  return {TableWish::keep, {}, {}, 0, "I will not touch " + listed(things_) + '.', {}, {},
          proxies()};
}

/// Of several things those that are not to be touched are left out.
TableGoal TableGoalMaker::leave_kept() {
  const bool is_about_two = step_.action == "Swap";
  const auto all = things_;
  std::erase_if(things_, [&](const auto* x) {
    const bool is_kept = x->is_kept && !x->is_held;
    if (is_kept)
      kept_.push_back(x);
    return is_kept;
  });
  const auto wanted = step_.number > 0 ? static_cast<std::size_t>(step_.number) : std::size_t{1};
  if (!kept_.empty() && (is_about_two || things_.size() < wanted))
    return refusal_for_kept();
  // Any of the others will do.
  if (step_.number > 0)
    kept_.clear();
  return handle();
}

TableGoal TableGoalMaker::refusal_for_kept() const {
  return refusal("I am not to touch " + listed(kept_) + ". Tell me that I may touch " +
                 (kept_.size() == 1 ? "it" : "them") + " again.");
}

std::string TableGoalMaker::but_what_is_kept() const {
  return kept_.empty() ? std::string{} : ", but not " + listed(kept_);
}

TableGoal TableGoalMaker::handle() {
  const auto& action = step_.action;
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
  if (action == "PutAsNoted")
    return put_as_noted();
  if (action == "PutDown")
    return put_down();
  if (action == "Push" && is_push_away())
    return push();
  if (!step_.places.empty())
    return put();
  if (action == "Take")
    return each("held", "take");
  if (action == "Give")
    return give();
  return refusal("I do not know how to do that.");
}

const TableThing* find_thing(std::span<const TableThing> table, const std::string& proxy) {
  auto found = std::ranges::find(table, proxy, &TableThing::proxy);
  if (found == table.end())
    found = std::ranges::find_if(table, [&](const TableThing& x) {
      return std::ranges::find(x.former_proxies, proxy) != x.former_proxies.end();
    });
  return found == table.end() ? nullptr : &*found;
}

const TableThing* TableGoalMaker::thing(const std::string& proxy) const {
  return find_thing(table_, proxy);
}

/// @param result a sentence without its full stop
TableGoal TableGoalMaker::goal(std::string words, std::string result) {
  if (facts_.empty())
    return refusal("There is nothing to do.");
  std::string formula = "(and";
  for (const auto& x : facts_)
    formula += ' ' + x;
  std::ranges::sort(parts_);
  parts_.erase(std::ranges::unique(parts_).begin(), parts_.end());
  return {TableWish::goal,   formula + ')',    std::move(parts_),
          places_ + 1,       std::move(words), sentence(std::move(result)),
          std::move(spots_), proxies(),        push_distance_};
}

std::vector<std::string> TableGoalMaker::proxies() const {
  std::vector<std::string> result;
  for (const auto* x : things_)
    result.push_back(x->proxy);
  return result;
}

std::string TableGoalMaker::in_part(const TableThing& x, std::string part) {
  ++places_;
  parts_.push_back(part);
  return "(in-part " + x.object + ' ' + std::move(part) + ')';
}

/// Of "one of the balls", those that are held already, then those that come first.
void TableGoalMaker::choose() {
  if (step_.number <= 0)
    return;
  std::ranges::stable_partition(things_, [](const auto* x) { return x->is_held; });
  things_.resize(std::min(things_.size(), static_cast<std::size_t>(step_.number)));
}

TableGoal TableGoalMaker::each(const std::string& predicate, const std::string& verb) {
  choose();
  if (predicate == "held" && things_.size() > 1)
    return refusal("I can hold one thing only.");
  for (const auto* x : things_)
    facts_.push_back('(' + predicate + ' ' + x->object + ')');
  return goal(done_before_taking() + verb + ' ' + listed(things_),
              predicate == "held" ? "I hold " + listed(things_) + " now"
                                  : "I have pushed " + listed(things_));
}

/// What people did not ask for, but will see: "put down the ball and ".
std::string TableGoalMaker::done_before_taking() const {
  std::string result;
  for (const auto& x : table_) {
    const bool is_taken = std::ranges::find(things_, &x) != things_.end();
    const auto below = std::ranges::find(things_, x.on, [](const auto* y) { return y->object; });
    if (x.is_held && !is_taken)
      result += "put down " + x.words + " and ";
    else if (!is_taken && !x.is_held && !x.on.empty() && below != things_.end())
      result += "take " + x.words + " off " + (*below)->words + " and ";
  }
  return result;
}

TableGoal TableGoalMaker::give() {
  // "Hand it over": what it holds.
  if (step_.things.empty())
    hold_held();
  if (things_.empty())
    return refusal("I do not hold anything.");
  choose();
  // Who speaks sits in front.
  for (const auto* x : things_)
    facts_.push_back(in_part(*x, "at-hand"));
  return goal(done_before_taking() + "give you " + listed(things_),
              "here you are: " + listed(things_));
}

void TableGoalMaker::hold_held() {
  for (const auto& x : table_)
    if (x.is_held)
      things_.push_back(&x);
}

TableGoal TableGoalMaker::put_down() {
  if (step_.things.empty())
    hold_held();
  if (things_.empty())
    return refusal("I do not hold anything.");
  const auto asked = things_;
  std::erase_if(things_, [](const auto* x) { return !x->is_held; });
  // Whatever is asked for besides may still be done.
  if (things_.empty())
    return {TableWish::answer, {}, {}, 0, "I do not hold " + listed(asked, "or") + '.'};
  for (const auto* x : things_)
    facts_.push_back(in_part(*x, "table"));
  return goal("put down " + listed(things_), "I have put down " + listed(things_));
}

TableGoal TableGoalMaker::swap() {
  if (things_.size() != 2)
    return refusal("I can swap two things only.");
  const auto& a = *things_.front();
  const auto& b = *things_.back();
  if (a.is_held || b.is_held)
    return refusal("I cannot swap what I hold.");
  for (const auto& [x, other] : {std::pair{&a, &b}, {&b, &a}}) {
    const auto problem = beyond_reach(*x, *other);
    auto beside = problem ? spot_nearly_at(*x, *other) : std::nullopt;
    if (problem && !beside)
      return refusal(*problem);
    facts_.push_back(at_waypoint(*x, beside ? beside->name : other->waypoint));
    if (beside)
      spots_.push_back(*std::move(beside));
  }
  return goal("swap " + listed(things_), listed(things_) + " have changed places");
}

/// The part's things go to the other side.
TableGoal TableGoalMaker::clear() {
  const auto& part = step_.places.front().relation;
  const auto other = words_for(opposites, part);
  // "I need a bit of room here."
  if (other.empty() && part == "at-hand")
    return refusal("Tell me which side I am to clear: the left, the right, the front or the back.");
  if (other.empty())
    return refusal("I have nowhere else to put the things. I can sort them by colour or shape, put "
                   "them in a row, or clear one side.");
  for (const auto& x : table_)
    if (!x.is_held && std::ranges::find(x.parts, part) != x.parts.end()) {
      if (x.is_kept)
        kept_.push_back(&x);
      else
        facts_.push_back(in_part(x, std::string{other}));
    }
  if (facts_.empty() && !kept_.empty())
    return refusal_for_kept();
  if (facts_.empty())
    return refusal("There is nothing " + std::string{words_for(part_words, part)} + '.');
  return goal("clear what is " + std::string{words_for(part_words, part)} + but_what_is_kept(),
              "there is nothing " + std::string{words_for(part_words, part)} + " any more" +
                (kept_.empty() ? "" : " but " + listed(kept_)));
}

/// A group for each value, in the order in which their things lie already.
TableGoal TableGoalMaker::sort() {
  if (step_.by.starts_with("height") || step_.by.starts_with("width") ||
      step_.by.starts_with("volume"))
    return sort_in_row();
  std::map<std::string, Things> groups;
  for (const auto* x : things_) {
    const auto value = x->qualities.find(step_.by);
    if (value == x->qualities.end() || value->second.empty() || value->second == "unknown")
      return refusal("I do not know the " + step_.by + " of " + x->words + '.');
    groups[value->second].push_back(x);
  }
  // All of them may be called small.
  if (groups.size() < 2 && step_.by == "size")
    return sort_in_row();
  if (groups.size() < 2)
    return refusal("They are all of the same " + step_.by + '.');
  if (groups.size() == things_.size())
    if (auto row = sort_one_of_each(); row.wish == TableWish::goal)
      return row;
  std::vector<std::pair<double, Things>> from_left;
  for (auto& [value, group] : groups) {
    double sum = 0;
    for (const auto* x : group)
      sum += x->x;
    from_left.emplace_back(sum / static_cast<double>(group.size()), std::move(group));
  }
  std::ranges::stable_sort(from_left, {}, [](const auto& x) { return x.first; });
  std::vector<Things> in_order;
  for (auto& [x, group] : from_left)
    in_order.push_back(std::move(group));
  things_.clear();
  for (const auto& group : in_order)
    things_.insert(things_.end(), group.begin(), group.end());
  const bool are_on_table =
    std::ranges::none_of(things_, [](const auto* x) { return x->is_held || !x->on.empty(); });
  auto spots = are_on_table ? grouped(in_order, room_) : std::vector<TableSpot>{};
  if (spots.empty())
    stand_in_strips(in_order);
  else
    stand_at(std::move(spots));
  return goal("sort the things by " + step_.by + but_what_is_kept(),
              "the things are sorted by " + step_.by + " now" + but_what_is_kept());
}

/// Things of which no two belong together stand in a row, so that it is seen that all was looked
/// at.
TableGoal TableGoalMaker::sort_one_of_each() {
  auto result = arrange("in-row");
  const auto own = ": each has a " + step_.by + " of its own";
  result.words = "sort the things by " + step_.by + but_what_is_kept() + own;
  result.result = sentence(listed(things_) + " are in a row now" + but_what_is_kept() + own);
  return result;
}

/// Where there is no room for groups that stand together.
void TableGoalMaker::stand_in_strips(const std::vector<Things>& groups) {
  const auto count = std::to_string(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (const auto* x : groups[i])
      facts_.push_back(in_part(*x, "strip-" + std::to_string(i + 1) + "-of-" + count));
}

TableGoal goal_of(const communication::DirectiveStep& step, std::span<const TableThing> table,
                  TableReach reach, TableExchange exchange, TableLanding landing) {
  return TableGoalMaker{step, table, std::move(reach), std::move(exchange), std::move(landing)}
    .make();
}

} // namespace castor::planning
