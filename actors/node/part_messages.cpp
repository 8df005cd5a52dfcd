#include "castor/actors/node/part_messages.hpp"

#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/store/value_limit.hpp"

#include <string>
#include <utility>
#include <vector>

namespace castor {

namespace {

/// What a message that is too large is about, in words, and the entry if it is about one.
std::pair<std::string, Address> subject_of(const caf::type_erased_tuple& x) {
  auto of_write = [](const WriteRequest& w) {
    return (w.client ? to_string(*w.client) + ": " : std::string{}) + to_string(w.address);
  };
  if (x.match_elements<WriteRequest>()) {
    auto& request = x.get_as<WriteRequest>(0);
    return {of_write(request), request.address};
  }
  if (x.match_elements<BatchRequest>()) {
    auto& request = x.get_as<BatchRequest>(0);
    return {std::to_string(request.writes.size()) + " writes for " + request.subarchitecture,
            {request.subarchitecture, {}}};
  }
  if (x.match_elements<Outcome<EntryPtr>>())
    if (auto& entry = x.get_as<Outcome<EntryPtr>>(0); entry && *entry)
      return {"what was read, " + to_string((*entry)->address), (*entry)->address};
  if (x.match_elements<Pushed>())
    return {"what " + x.get_as<Pushed>(0).provider + " pushes", {}};
  return {std::string{"a message, "} + name_of_type(x), {}};
}

} // namespace

std::size_t PartMessages::count_events(const Content& x) const {
  if (x.match_elements<RoutedEvents>())
    return x.get_as<RoutedEvents>(0).events.size();
  if (x.match_elements<ChangeNotices>())
    return x.get_as<ChangeNotices>(0).notices.size();
  return x.match_elements<ChangeNotice>() ? 1 : 0;
}

// -- what is too large

void PartMessages::set_largest_value(ActorName working_memory, const std::string& subarchitecture,
                                     std::size_t bytes) {
  std::lock_guard guard{mutex_};
  std::erase_if(largest_values_, [&](auto& x) { return x.second.first == subarchitecture; });
  largest_values_[working_memory] = {subarchitecture, bytes};
}

std::optional<Failure> PartMessages::check(ActorName to, const Content& x) const {
  bool is_write = x.match_elements<WriteRequest>();
  if (!is_write && !x.match_elements<BatchRequest>())
    return std::nullopt;
  std::pair<std::string, std::size_t> limit;
  {
    std::lock_guard guard{mutex_};
    auto i = largest_values_.find(to);
    if (i == largest_values_.end())
      return std::nullopt;
    limit = i->second;
  }
  if (is_write)
    return value_too_large(x.get_as<WriteRequest>(0), limit.first, limit.second);
  for (auto& write : x.get_as<BatchRequest>(0).writes)
    if (auto failure = value_too_large(write, limit.first, limit.second))
      return failure;
  return std::nullopt;
}

Failure PartMessages::too_large(const Content& x, std::size_t size, std::size_t largest) const {
  auto [what, address] = subject_of(x);
  return {FailureKind::too_large,
          what + " takes " + std::to_string(size) + " bytes or more, but at most " +
            std::to_string(largest) +
            " travel to another process at once. Write it in parts, or have both in one process",
          address};
}

std::optional<caf::message> PartMessages::failed_outcome(const Content& x,
                                                         const Failure& why) const {
  auto outcome = [&]<class T>(Outcome<T> result) { return caf::make_message(std::move(result)); };
  if (x.match_elements<WriteRequest>())
    return outcome(Outcome<Version>{why});
  if (x.match_elements<BatchRequest>())
    return outcome(Outcome<std::vector<Version>>{why});
  if (x.match_elements<Subscribe>())
    return outcome(Outcome<Acknowledged>{why});
  if (x.match_elements<ReadRequest>() || x.match_elements<Outcome<EntryPtr>>())
    return outcome(Outcome<EntryPtr>{why});
  if (x.match_elements<QueryRequest>() || x.match_elements<Outcome<std::vector<EntryPtr>>>())
    return outcome(Outcome<std::vector<EntryPtr>>{why});
  return std::nullopt;
}

bool PartMessages::may_repeat(const Content& x) const {
  return x.match_elements<Outcome<EntryPtr>>() ||
         x.match_elements<Outcome<std::vector<EntryPtr>>>();
}

// -- flow control

std::optional<caf::message> PartMessages::receipt_if_dropped(const Content& x) const {
  if (!x.match_elements<Pushed>())
    return std::nullopt;
  return caf::make_message(PushesTaken{x.get_as<Pushed>(0).value.type_name(), 1});
}

LinkMessages::OnArrival PartMessages::on_arrival(ProcessNumber peer,
                                                 const caf::strong_actor_ptr& sender,
                                                 const Content& x) {
  if (!x.match_elements<RoutedEvents>())
    return nullptr;
  std::shared_ptr<Receipts> receipts;
  {
    std::lock_guard guard{mutex_};
    auto& known = receipts_[{peer, sender->id()}];
    if (!known)
      known = std::make_shared<Receipts>(route_limit);
    receipts = known;
  }
  return [sender, receipts = std::move(receipts),
          events = x.get_as<RoutedEvents>(0).events.size()](const caf::strong_actor_ptr& receiver) {
    std::uint64_t taken = 0;
    for (std::size_t i = 0; i < events; ++i)
      taken += receipts->take();
    if (taken > 0)
      sender->enqueue(receiver, caf::make_message_id(),
                      caf::make_message(EventsTaken{EventStream::component, taken}), nullptr);
  };
}

void PartMessages::process_ended(ProcessNumber peer) {
  std::lock_guard guard{mutex_};
  std::erase_if(receipts_, [&](auto& x) { return x.first.first == peer; });
  std::erase_if(largest_values_, [&](auto& x) { return process_of(x.first) == peer; });
}

} // namespace castor
