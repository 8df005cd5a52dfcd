#include "castor/tools/simulation/outstanding_operations.hpp"

#include <algorithm>
#include <utility>

namespace castor::linearizability {

std::uint64_t OutstandingOperations::add(Route route, std::vector<Index> records, WaitNumber wait) {
  auto number = ++sent_;
  operations_.push_back({number, route, std::move(records), wait});
  return number;
}

bool OutstandingOperations::is_awaited() const {
  return std::ranges::any_of(operations_, [](auto& x) { return x.given_up_by == 0; });
}

bool OutstandingOperations::concern(std::uint32_t entry) const {
  return std::ranges::any_of(operations_, [&](auto& x) {
    return std::ranges::any_of(x.records,
                               [&](auto record) { return world_.recorder[record].entry == entry; });
  });
}

Outstanding OutstandingOperations::take(std::uint64_t number, bool arrived) {
  auto& recorder = world_.recorder;
  Outstanding result = *std::ranges::find(operations_, number, &Outstanding::number);
  std::erase_if(operations_, [&](auto& x) {
    if (x.number == number)
      return true;
    if (!arrived || !(x.route == result.route) || x.number > number)
      return false;
    auto was_given_up = x.given_up_by != 0 && x.given_up_by < number;
    for (auto record : x.records)
      if (was_given_up)
        recorder.returned(record, {Status::timed_out});
      else
        recorder.known_to_have_arrived(record);
    return was_given_up;
  });
  std::erase_if(unwanted_, [&](auto& x) {
    auto has_ended = arrived && x.route == result.route && x.given_up_by < number;
    if (has_ended)
      recorder.has_ended(x.entry, x.token);
    return has_ended;
  });
  return result;
}

std::vector<OutstandingOperations::Index> OutstandingOperations::drop(std::uint64_t number) {
  std::vector<Index> result;
  std::erase_if(operations_, [&](auto& x) {
    if (x.number == number)
      result = std::move(x.records);
    return x.number == number;
  });
  return result;
}

bool OutstandingOperations::can_be_given_up(const Outstanding& x,
                                            const std::vector<EntryView>& views) const {
  if (x.wait == 0 || x.given_up_by != 0 || x.records.empty())
    return false;
  auto& record = world_.recorder[x.records.front()];
  if (record.kind == OperationKind::read)
    return true;
  // A lease that it has or will have is not to be given up with the wait.
  return record.kind == OperationKind::lock && views[record.entry].times == 0 &&
         std::ranges::count_if(operations_, [&](auto& y) {
           return y.given_up_by == 0 && !y.records.empty() &&
                  world_.recorder[y.records.front()].entry == record.entry &&
                  (world_.recorder[y.records.front()].kind == OperationKind::lock ||
                   world_.recorder[y.records.front()].kind == OperationKind::try_lock);
         }) == 1;
}

Outstanding* OutstandingOperations::find_to_give_up(const std::vector<EntryView>& views) {
  auto i = std::ranges::find_if(operations_, [&](auto& x) { return can_be_given_up(x, views); });
  return i == operations_.end() ? nullptr : &*i;
}

void OutstandingOperations::give_up(Outstanding& x) {
  x.given_up_by = ++sent_;
  x.given_up_at = world_.recorder.tick();
}

void OutstandingOperations::grant_unwanted(const Outstanding& x, std::uint32_t entry, Token token) {
  world_.recorder.may_end(entry, token, x.given_up_at);
  unwanted_.push_back({entry, token, x.route, x.given_up_by});
}

void OutstandingOperations::settle(const std::string& client) {
  for (auto& x : operations_) {
    if (x.given_up_by == 0)
      world_.find(client + " got no answer to its message " + std::to_string(x.number));
    else
      for (auto record : x.records)
        world_.recorder.returned(record, {Status::timed_out});
  }
  operations_.clear();
  for (auto& x : unwanted_)
    world_.recorder.has_ended(x.entry, x.token);
  unwanted_.clear();
}

} // namespace castor::linearizability
