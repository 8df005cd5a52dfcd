#include "castor/tools/chaos/change_check.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace castor::linearizability {

namespace {

class ChangeCheck {
public:
  ChangeCheck(std::span<const ChangeEventPtr> told, std::span<const ObservedWrite> writes)
    : told_(told), writes_(writes) {}

  std::vector<std::string> run(std::uint64_t made) {
    check_sequence(made);
    check_versions();
    match();
    check_order();
    check_batches();
    return std::move(faults_);
  }

private:
  void check_sequence(std::uint64_t made) {
    std::uint64_t last = 0;
    for (auto& event : told_)
      if (event->sequence != ++last)
        faults_.push_back("number " + std::to_string(event->sequence) + " came as number " +
                          std::to_string(last) + ": " + to_string(*event));
    if (last != made)
      faults_.push_back("told " + std::to_string(last) + " of " + std::to_string(made) +
                        " changes");
  }

  void check_versions() {
    struct Standing {
      bool present = false;
      Version next = 0;
    };
    std::map<std::string, Standing> entries;
    for (auto& event : told_) {
      auto& [present, next] = entries[event->address.id];
      auto is_add = event->operation == Operation::add;
      auto is_remove = event->operation == Operation::remove;
      auto expected = is_remove ? next - 1 : next;
      if (present == is_add || event->version != expected)
        faults_.push_back("after version " + std::to_string(next - 1) +
                          (present ? "" : ", which was deleted or never was") + ": " +
                          to_string(*event));
      present = !is_remove;
      next = event->version + 1;
    }
  }

  /// Finds out which event tells of which write.
  void match() {
    using Key = std::tuple<std::string, Operation, std::string, std::optional<Version>>;
    std::multimap<Key, std::size_t> events;
    for (std::size_t i = 0; i < told_.size(); ++i)
      events.emplace(
        Key{told_[i]->address.id, told_[i]->operation, told_[i]->source, told_[i]->version}, i);
    event_of_.assign(writes_.size(), std::nullopt);
    for (std::size_t i = 0; i < writes_.size(); ++i) {
      auto& x = writes_[i];
      if (x.returned == never)
        continue;
      auto event = events.find({x.address.id, x.operation, x.component, x.version});
      if (event == events.end()) {
        faults_.push_back("no event for the " + describe(x));
        continue;
      }
      event_of_[i] = event->second;
      events.erase(event);
    }
    // What is left must come from writes whose clients did not live to see the answer.
    std::map<Key, std::size_t> pending;
    for (auto& x : writes_)
      if (x.returned == never)
        ++pending[{x.address.id, x.operation, x.component, std::nullopt}];
    for (auto& [key, event] : events) {
      auto& [id, operation, component, version] = key;
      auto write = pending.find({id, operation, component, std::nullopt});
      if (write == pending.end() || write->second-- == 0)
        faults_.push_back("nobody made this change: " + to_string(*told_[event]));
    }
  }

  void check_order() {
    std::vector<const ObservedWrite*> by_event(told_.size(), nullptr);
    for (std::size_t i = 0; i < writes_.size(); ++i)
      if (event_of_[i])
        by_event[*event_of_[i]] = &writes_[i];
    const ObservedWrite* latest = nullptr;
    for (auto* x : by_event) {
      if (!x)
        continue;
      if (latest && x->returned < latest->invoked)
        faults_.push_back("event after that of the " + describe(*latest) +
                          ", but written before it: the " + describe(*x));
      if (!latest || x->invoked > latest->invoked)
        latest = x;
    }
  }

  void check_batches() {
    for (std::size_t i = 1; i < writes_.size(); ++i)
      if (writes_[i].batch != 0 && writes_[i].batch == writes_[i - 1].batch && event_of_[i] &&
          event_of_[i - 1] && *event_of_[i] != *event_of_[i - 1] + 1)
        faults_.push_back("another change came between two writes of one batch, the " +
                          describe(writes_[i - 1]) + " and the " + describe(writes_[i]));
  }

  static std::string describe(const ObservedWrite& x) {
    return std::string{to_string(x.operation)} + " " + to_string(x.address) + " v" +
           std::to_string(x.version) + " by " + x.component;
  }

  std::span<const ChangeEventPtr> told_;
  std::span<const ObservedWrite> writes_;
  /// Index into `told_`, for each write.
  std::vector<std::optional<std::size_t>> event_of_;
  std::vector<std::string> faults_;
};

} // namespace

std::vector<std::string> faults_of(std::span<const ChangeEventPtr> told, std::uint64_t made,
                                   std::span<const ObservedWrite> writes) {
  return ChangeCheck{told, writes}.run(made);
}

} // namespace castor::linearizability
