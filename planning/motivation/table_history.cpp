#include "castor/planning/motivation/table_history.hpp"

#include "castor/planning/motivation/table_goal_maker.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace castor::planning {

namespace {

using Words = std::vector<std::string>;

/// More moves than these are too many to say.
constexpr std::size_t most_said = 8;

std::string counted(std::uint64_t number, const std::string& noun) {
  constexpr std::array<const char*, 11> numerals{"no",  "one",   "two",   "three", "four", "five",
                                                 "six", "seven", "eight", "nine",  "ten"};
  return (number < numerals.size() ? numerals.at(number) : std::to_string(number)) + (' ' + noun) +
         (number == 1 ? "" : "s");
}

std::string listed(const Words& names) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i)
    result += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return result;
}

/// "The ball, then the cube, and then the ball again".
std::string in_order(std::span<const TableMove> moves) {
  std::string result;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const auto before = moves.first(i);
    const bool is_again =
      std::ranges::find(before, moves[i].object, &TableMove::object) != before.end();
    result += (i == 0                  ? ""
               : i + 1 == moves.size() ? i == 1 ? " and then " : ", and then "
                                       : ", then ") +
              moves[i].words + (is_again ? " again" : "");
  }
  return result;
}

/// Of the moves of the things that are asked about.
class HistoryQuestion {
public:
  HistoryQuestion(const communication::DirectiveStep& step, std::span<const TableThing> table,
                  const TableHistory& history)
    : table_(table), moves_(history.moves), remembered_(history.remembered) {
    for (const auto& x : table)
      if (step.things.empty() || std::ranges::any_of(step.things, [&](const auto& proxy) {
            return find_thing(table, proxy) == &x;
          }))
        things_.push_back(&x);
    if (step.things.empty() || step.action == "StartedWith")
      return;
    std::erase_if(remembered_, [&](const TableMove& move) {
      return std::ranges::none_of(things_, [&](auto* x) { return x->object == move.object; });
    });
    moves_ = remembered_.size();
  }

  HistoryAnswer answer(std::string_view action) const {
    if (action == "NotMoved")
      return which_were_not_moved();
    if (remembered_.empty() && action == "DoneWith" && things_.size() == 1)
      return {"Nothing: I have not moved " + things_.front()->words + '.'};
    if (remembered_.empty())
      return {"I have moved nothing."};
    if (action == "DoneWith")
      return what_was_done();
    if (action == "StartedWith")
      return started_with();
    const std::span all{remembered_};
    if (action == "LastMoved")
      return {"The last thing that I moved is " + remembered_.back().words +
                (remembered_.back().because.empty() ? "" : ": " + remembered_.back().because) + '.',
              proxies(all.last(1))};
    if (action == "FirstMoved" && moves_ > remembered_.size())
      return {"I do not remember what I moved first: that is too long ago."};
    if (action == "FirstMoved")
      return {"The first thing that I moved is " + remembered_.front().words + '.',
              proxies(all.first(1))};
    if (action == "HowManyMoves")
      return {"I have made " + counted(moves_, "move") + ": " + last_in_order(), proxies(all)};
    if (action == "MovesInOrder")
      return {"I have moved " + last_in_order(), proxies(all)};
    return moved(action == "MovedForThat" ? moved_for_the_last() : all);
  }

private:
  std::string last_in_order() const {
    const std::span all{remembered_};
    const auto said = all.last(std::min(all.size(), most_said));
    return (moves_ > said.size() ? "last " : "") + in_order(said) + '.';
  }

  /// What was moved for the same request as the last thing.
  std::span<const TableMove> moved_for_the_last() const {
    const auto& because = remembered_.back().because;
    const auto before =
      std::ranges::find_if(remembered_.rbegin(), remembered_.rend(),
                           [&](const TableMove& x) { return x.because != because; });
    return {before.base(), remembered_.end()};
  }

  /// The last that was done with each of those that are asked about.
  HistoryAnswer what_was_done() const {
    std::string said;
    for (const auto* x : things_) {
      const auto last =
        std::ranges::find(remembered_.rbegin(), remembered_.rend(), x->object, &TableMove::object);
      said += said.empty() ? "" : " ";
      said += last == remembered_.rend() ? "I have not moved " + x->words + '.'
              : last->because.empty()    ? "I moved " + x->words + '.'
                                         : "I moved " + x->words + ": " + last->because + '.';
    }
    return {std::move(said), proxies(remembered_)};
  }

  /// Of the last request that moved several things, or else of all.
  HistoryAnswer started_with() const {
    const auto last = moved_for_the_last();
    const auto& first = (last.size() > 1 ? last : std::span{remembered_}).front();
    const bool is_it =
      std::ranges::find(things_, first.object, &TableThing::object) != things_.end();
    return {is_it ? "Yes." : "No, I moved " + first.words + " first.", proxies({&first, 1})};
  }

  /// Of what was moved and is still there.
  std::vector<std::string> proxies(std::span<const TableMove> moves) const {
    std::vector<std::string> result;
    for (const auto& x : table_)
      if (std::ranges::find(moves, x.object, &TableMove::object) != moves.end())
        result.push_back(x.proxy);
    return result;
  }

  HistoryAnswer moved(std::span<const TableMove> moves) const {
    Words names;
    std::vector<std::string> objects;
    for (const auto& x : moves)
      if (std::ranges::find(objects, x.object) == objects.end()) {
        objects.push_back(x.object);
        names.push_back(x.words);
      }
    return {"I have moved " + (names.size() == 1 ? "" : counted(names.size(), "thing") + ": ") +
              listed(names) + '.',
            proxies(moves)};
  }

  HistoryAnswer which_were_not_moved() const {
    Words names;
    std::vector<std::string> things;
    for (const auto* x : things_)
      if (std::ranges::find(remembered_, x->object, &TableMove::object) == remembered_.end()) {
        names.push_back(x->words);
        things.push_back(x->proxy);
      }
    return {names.empty() ? "I have moved all of them." : "I have not moved " + listed(names) + '.',
            std::move(things)};
  }

  std::span<const TableThing> table_;
  std::uint64_t moves_ = 0;
  std::vector<TableMove> remembered_;
  std::vector<const TableThing*> things_;
};

} // namespace

bool asks_about_history(std::string_view action) {
  constexpr std::array<std::string_view, 9> questions{
    "WhichMoved",   "NotMoved",     "LastMoved",   "FirstMoved", "HowManyMoves",
    "MovesInOrder", "MovedForThat", "StartedWith", "DoneWith"};
  return std::ranges::find(questions, action) != questions.end();
}

HistoryAnswer answer_about_history(const communication::DirectiveStep& step,
                                   std::span<const TableThing> table, const TableHistory& history) {
  return HistoryQuestion{step, table, history}.answer(step.action);
}

} // namespace castor::planning
