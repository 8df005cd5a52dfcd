#pragma once

#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <tuple>
#include <vector>

namespace castor {

/// Those who wait for simulated time to pass, in the order in which they are woken: by time, then
/// by their order, then by when they began to wait.
class Sleepers {
public:
  using Wake = std::function<void()>;

  /// Identifies one wait.
  struct Key {
    Timestamp time{0};
    std::uint64_t order = 0;
    std::uint64_t number = 0;

    friend auto operator<=>(const Key&, const Key&) = default;
  };

  Key add(Timestamp time, std::uint64_t order, Wake wake);
  void remove(const Key& key) { waiting_.erase(key); }

  /// Time of the first; `Timestamp::max()` if there is none.
  Timestamp next() const {
    return waiting_.empty() ? Timestamp::max() : waiting_.begin()->first.time;
  }

  /// Removes and returns those whose time has come, at most `count`.
  std::vector<Wake> take_due(Timestamp now, std::size_t count);

private:
  std::map<Key, Wake> waiting_;
  std::uint64_t last_number_ = 0;
};

} // namespace castor
