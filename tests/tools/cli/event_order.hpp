#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <map>
#include <stdexcept>
#include <string>

namespace castor::test {

/// Sees to it that what happens to an entry is heard of in turn: nothing is missing unless
/// something newer stands for it, nothing comes twice.
class EventOrder {
public:
  void check(const ChangeEvent& event) {
    merged_ += event.coalesced;
    if (event.operation == Operation::add) {
      note_add(event);
      return;
    }
    if (late_ && last_.count(event.address) == 0)
      last_[event.address] = event.version - 1;
    auto last = last_.find(event.address);
    auto expected = last == last_.end() ? 1 : last->second + 1;
    if (event.coalesced ? event.version < expected : event.version != expected)
      throw std::runtime_error("instead of version " + std::to_string(expected) + " comes " +
                               to_string(event));
    last_[event.address] = event.version;
  }

  /// From now on, the first event of an entry may be any.
  void begin_late() { late_ = true; }

  /// 0 before the first event.
  Version last(const Address& x) const {
    auto i = last_.find(x);
    return i == last_.end() ? 0 : i->second;
  }

  int merged() const { return merged_; }

private:
  /// A working memory that is back counts on from a higher number.
  void note_add(const ChangeEvent& event) {
    auto [last, is_new] = last_.try_emplace(event.address, event.version);
    if (!is_new && event.version <= last->second)
      throw std::runtime_error("after version " + std::to_string(last->second) + " comes " +
                               to_string(event));
    last->second = event.version;
  }

  std::map<Address, Version> last_;
  int merged_ = 0;
  bool late_ = false;
};

} // namespace castor::test
