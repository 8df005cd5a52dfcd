#include "castor/wm/events/event_backlog.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::test::backlog_properties {

namespace {

using rc::gen::element;

// --- what happens ---

/// Filters that want everything, one operation each, and one (`moody`) that wants of each event
/// what the step says, as a condition on the content might.
enum Filter : std::uint32_t { any, also_any, adds, overwrites, deletions, moody, filters };

bool wants(std::uint32_t filter, Operation operation) {
  switch (filter) {
    case adds:
      return operation == Operation::add;
    case overwrites:
      return operation == Operation::overwrite;
    case deletions:
      return operation == Operation::remove;
    default:
      return true;
  }
}

struct Write {
  Address address;
  bool removes = false;
  FieldMask changed = 0;
  /// Those of the filters that are registered, beyond what they want.
  unsigned mood = 0;
};

struct Step {
  enum { write, take, withdraw } kind = write;
  /// Of different entries, at once.
  std::vector<Write> writes;
  std::uint32_t filter = any;
};

std::ostream& operator<<(std::ostream& out, const Step& x) {
  if (x.kind == Step::take)
    return out << "take";
  if (x.kind == Step::withdraw)
    return out << "withdraw " << x.filter;
  for (auto& y : x.writes)
    out << (y.removes ? "remove " : "write ") << to_string(y.address) << " changed " << y.changed
        << " mood " << y.mood << "; ";
  return out;
}

/// Some ids come again and again, others once.
rc::Gen<Step> any_step(bool with_takes, bool with_withdrawals) {
  auto address = rc::gen::build<Address>(
    rc::gen::set(&Address::subarchitecture, element<std::string>("a", "b")),
    rc::gen::set(&Address::id, element<std::string>("x", "x", "y", "z", "new")));
  auto write =
    rc::gen::build<Write>(rc::gen::set(&Write::address, address),
                          rc::gen::set(&Write::removes, element(false, false, true)),
                          rc::gen::set(&Write::changed, element<FieldMask>(1, 2, 4)),
                          rc::gen::set(&Write::mood, rc::gen::inRange(0u, 1u << filters)));
  auto kinds = std::vector<decltype(Step::kind)>(8, Step::write);
  if (with_takes)
    kinds.insert(kinds.end(), 7, Step::take);
  if (with_withdrawals)
    kinds.push_back(Step::withdraw);
  return rc::gen::build<Step>(
    rc::gen::set(&Step::kind, rc::gen::elementOf(kinds)),
    rc::gen::set(&Step::writes, rc::gen::mapcat(element<std::size_t>(1, 1, 1, 1, 3),
                                                [write](std::size_t n) {
                                                  return rc::gen::container<std::vector<Write>>(
                                                    n, write);
                                                })),
    rc::gen::set(&Step::filter, rc::gen::inRange<std::uint32_t>(0, filters)));
}

std::vector<Step> steps(bool with_takes, bool with_withdrawals) {
  return *rc::gen::scale(
    4.0, rc::gen::container<std::vector<Step>>(any_step(with_takes, with_withdrawals)));
}

/// Entries and their versions, and the events that writes to them make.
class World {
public:
  using Batch = EventBacklog::Batch;

  /// The notices of writes at once. Of several writes of one entry the first counts.
  Batch make(const std::vector<Write>& writes) {
    Batch result;
    std::set<Address> written;
    for (auto& x : writes) {
      auto address = x.address;
      if (address.id == "new" && !x.removes)
        address.id += std::to_string(++ids_made_);
      else if (address.id == "new")
        address.id += std::to_string(ids_made_);
      if (!written.insert(address).second)
        continue;
      auto here = there.find(address);
      if (x.removes && here == there.end())
        continue;
      auto event = std::make_shared<ChangeEvent>();
      event->address = address;
      event->type = descriptor_of<Box>();
      event->sequence = ++sequences_[address.subarchitecture];
      if (x.removes) {
        event->operation = Operation::remove;
        event->version = here->second;
        there.erase(here);
      } else if (here == there.end()) {
        event->version = next_version_[address]++;
        there[address] = event->version;
      } else {
        event->operation = Operation::overwrite;
        event->version = here->second = next_version_[address]++;
        event->changed = x.changed;
      }
      ChangeNotice notice{event, {}};
      for (std::uint32_t filter = 0; filter < filters; ++filter)
        if (wants(filter, event->operation) && (filter != moody || (x.mood & 1u) != 0))
          notice.filters.push_back(filter);
      result.push_back(std::move(notice));
    }
    return result;
  }

  std::map<Address, Version> there;

private:
  std::map<Address, Version> next_version_;
  std::map<std::string, std::uint64_t> sequences_;
  int ids_made_ = 0;
};

// --- what is to be expected ---

/// What waits for each filter, in a list that is searched from end to end, by the rules that the
/// backlog's description gives.
class Naive {
public:
  struct Waiting {
    ChangeEvent event;
    std::size_t order = 0;
  };

  explicit Naive(std::size_t bound) : bound_(bound) {}

  void push(const EventBacklog::Batch& batch) {
    for (auto& notice : batch) {
      auto order = ++pushed_;
      if (merging)
        merge({*notice.event, order}, notice.filters);
      else if (!notice.filters.empty())
        queue_.push_back({{*notice.event, order}, notice.filters});
    }
    if (!merging && queue_.size() > bound_) {
      merging = has_merged = true;
      for (auto& [waiting, wanted_by] : std::exchange(queue_, {}))
        merge(waiting, wanted_by);
    }
    rest_if_empty();
  }

  /// Fails unless this is what comes next.
  void pop(const EventBacklog::Batch& batch) {
    for (auto& [event, wanted_by] : batch) {
      RC_ASSERT(!wanted_by.empty());
      if (!merging) {
        RC_ASSERT(!queue_.empty());
        check(*event, queue_.front().first);
        RC_ASSERT(wanted_by == queue_.front().second);
        queue_.erase(queue_.begin());
        continue;
      }
      for (auto filter : wanted_by) {
        auto& list = lists_[filter];
        RC_ASSERT(!list.empty());
        check(*event, list.front());
        list.erase(list.begin());
      }
    }
    rest_if_empty();
  }

  void withdraw(std::uint32_t filter) {
    lists_[filter].clear();
    for (auto& [waiting, wanted_by] : queue_)
      castor::erase(wanted_by, filter);
    std::erase_if(queue_, [](auto& x) { return x.second.empty(); });
    rest_if_empty();
  }

  bool empty() const {
    return queue_.empty() &&
           std::all_of(lists_.begin(), lists_.end(), [](auto& x) { return x.second.empty(); });
  }

  bool merging = false;
  bool has_merged = false;

private:
  void check(const ChangeEvent& event, const Waiting& expected) {
    RC_ASSERT(to_string(event) == to_string(expected.event));
    RC_ASSERT(event.sequence == expected.event.sequence);
    RC_ASSERT(event.changed == expected.event.changed);
    RC_ASSERT(event.coalesced == expected.event.coalesced);
    RC_ASSERT(expected.order >= taken_);
    taken_ = expected.order;
  }

  static std::optional<ChangeEvent> cut(std::vector<Waiting>& list, const Address& address,
                                        bool end) {
    for (auto i = list.begin(); i != list.end(); ++i) {
      if (i->event.address != address || (i->event.operation == Operation::remove) != end)
        continue;
      auto result = i->event;
      list.erase(i);
      return result;
    }
    return std::nullopt;
  }

  void merge(Waiting x, const FilterIds& wanted_by) {
    auto& address = x.event.address;
    bool is_end = x.event.operation == Operation::remove;
    if (x.event.operation == Operation::add)
      born_[address] = x.order;
    for (auto filter : wanted_by) {
      auto& list = lists_[filter];
      auto told = x;
      auto there = cut(list, address, false);
      if (!is_end) {
        told.event.coalesced = there.has_value();
        if (there && told.event.operation == Operation::overwrite) {
          if (there->operation == Operation::add) {
            told.event.operation = Operation::add;
            told.event.changed = 0;
          } else {
            told.event.changed |= there->changed;
          }
        }
        list.push_back(told);
        continue;
      }
      auto gone = cut(list, address, true);
      bool is_news = (there && there->operation == Operation::add) || born_[address] > taken_;
      if (gone || !is_news) {
        told.event.coalesced = gone || there;
        list.push_back(told);
      }
    }
    if (!is_end)
      return;
    for (auto& [filter, list] : lists_)
      cut(list, address, false);
    born_[address] = 0;
  }

  void rest_if_empty() {
    if (!empty())
      return;
    merging = false;
    born_.clear();
  }

  std::size_t bound_;
  std::vector<std::pair<Waiting, FilterIds>> queue_;
  std::map<std::uint32_t, std::vector<Waiting>> lists_;
  std::map<Address, std::size_t> born_;
  std::size_t pushed_ = 0;
  std::size_t taken_ = 0;
};

/// One that has registered all the filters, and follows what it is told.
class Receiver {
public:
  void hear(const EventBacklog::Batch& batch) {
    for (auto& [event, wanted_by] : batch) {
      auto& address = event->address;
      auto& last_sequence = last_sequences_[address.subarchitecture];
      RC_ASSERT(event->sequence >= last_sequence);
      last_sequence = event->sequence;
      for (auto filter : wanted_by) {
        RC_ASSERT(wants(filter, event->operation));
        auto& versions = last_versions_[filter];
        if (auto last = versions.find(address); last != versions.end())
          RC_ASSERT(event->version >= last->second);
        versions[address] = event->version;
        if (filter == any || filter == also_any)
          follow(views[filter], *event);
      }
    }
  }

  /// By filter that wants everything: what there is, and in which version.
  std::map<std::uint32_t, std::map<Address, Version>> views{{any, {}}, {also_any, {}}};

private:
  /// The story is one that can be: nothing is added twice, or changed before it is there.
  static void follow(std::map<Address, Version>& view, const ChangeEvent& event) {
    auto i = view.find(event.address);
    if (event.operation == Operation::add) {
      RC_ASSERT(i == view.end());
      view[event.address] = event.version;
      return;
    }
    RC_ASSERT(i != view.end());
    if (event.operation == Operation::overwrite)
      i->second = event.version;
    else
      view.erase(i);
  }

  std::map<std::string, std::uint64_t> last_sequences_;
  std::map<std::uint32_t, std::map<Address, Version>> last_versions_;
};

} // namespace

RC_GTEST_PROP(EventBacklogProperties, TellsAShorterStoryWithTheSameEnd, ()) {
  auto bound = *element<std::size_t>(0, 1, 3, 10);
  EventBacklog backlog{bound};
  World world;
  Naive naive{bound};
  Receiver receiver;
  std::size_t pushed = 0;
  std::set<std::pair<std::string, std::uint64_t>> popped;
  auto take = [&] {
    auto batch = backlog.pop();
    naive.pop(batch);
    receiver.hear(batch);
    for (auto& notice : batch)
      popped.emplace(notice.event->address.subarchitecture, notice.event->sequence);
  };
  for (auto& step : steps(true, false)) {
    if (step.kind == Step::write) {
      auto batch = world.make(step.writes);
      pushed += static_cast<std::size_t>(std::count_if(
        batch.begin(), batch.end(), [](auto& notice) { return !notice.filters.empty(); }));
      naive.push(batch);
      backlog.push(std::move(batch));
    } else if (!backlog.empty()) {
      take();
    }
    RC_ASSERT(backlog.is_merging() == naive.merging);
    RC_ASSERT(backlog.empty() == naive.empty());
    RC_ASSERT((backlog.size() == 0) == backlog.empty());
  }
  while (!backlog.empty())
    take();
  RC_ASSERT(naive.empty());
  RC_ASSERT(receiver.views[any] == world.there);
  RC_ASSERT(receiver.views[also_any] == world.there);
  RC_ASSERT(pushed == popped.size() + backlog.suppressed());
  RC_ASSERT(naive.has_merged || backlog.suppressed() == 0);
}

RC_GTEST_PROP(EventBacklogProperties, ForgetsWithdrawnFiltersOnly, ()) {
  auto bound = *element<std::size_t>(0, 3, 10);
  EventBacklog backlog{bound};
  World world;
  Naive naive{bound};
  for (auto& step : steps(true, true)) {
    if (step.kind == Step::write) {
      auto batch = world.make(step.writes);
      naive.push(batch);
      backlog.push(std::move(batch));
    } else if (step.kind == Step::withdraw) {
      naive.withdraw(step.filter);
      backlog.erase(step.filter);
    } else if (!backlog.empty()) {
      naive.pop(backlog.pop());
    }
    RC_ASSERT(backlog.is_merging() == naive.merging);
    RC_ASSERT(backlog.empty() == naive.empty());
  }
}

RC_GTEST_PROP(EventBacklogProperties, NeverGrowsBeyondItsBoundAndTheEntriesThereAre, ()) {
  auto bound = *element<std::size_t>(0, 1, 3, 10);
  EventBacklog backlog{bound};
  World world;
  // Those that were there when it began to merge, or that it knew of by then.
  std::set<Address> known;
  for (auto& step : steps(false, false)) {
    auto before = world.there;
    auto batch = world.make(step.writes);
    if (!backlog.is_merging()) {
      known.clear();
      for (auto& [address, version] : before)
        known.insert(address);
      for (auto& notice : batch)
        known.insert(notice.event->address);
    }
    backlog.push(std::move(batch));
    auto entries = known;
    for (auto& [address, version] : world.there)
      entries.insert(address);
    RC_ASSERT(backlog.size() <= bound + 2 * filters * entries.size());
  }
}

} // namespace castor::test::backlog_properties
