#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace castor {

using Names = std::set<std::string>;

/// The stopping and starting of some children, one step after the other.
struct Round {
  enum class Step : std::uint8_t { stop, wait, make, configure, start };

  std::uint64_t id = 0;
  std::vector<std::string> stop;
  std::vector<std::string> start;
  /// The same in another order.
  std::vector<std::string> configure;
  Timestamp delay{0};
  /// Whether it makes what it starts anew, and why.
  bool makes = false;
  std::string reason;
  Step step = Step::stop;
  /// Counts steps, so that a late reminder is known as such.
  std::uint64_t steps = 0;
  /// Who is being stopped, configured or started now, as an index.
  std::size_t at = 0;
  /// Who of its name was told to; nobody if nobody was.
  caf::actor_addr asked;
  std::chrono::steady_clock::time_point since;
  /// Who failed meanwhile, to be dealt with when the round is over.
  std::vector<ComponentEnded> failures;
  /// Whose configuration is wrong, if the round starts them for the first time.
  std::vector<Diagnostic> problems;
  /// Whose process was lost meanwhile.
  Names gone;
  /// Who is not to be configured once it is made.
  Names withdrawn;
  std::vector<std::string> stopped;
  std::vector<std::string> stuck;
  std::function<void(const Round&)> done;

  /// In which its components go through the present phase: those outside the subarchitectures are
  /// configured last, and started first.
  const std::vector<std::string>& order() const {
    return step == Step::configure ? configure : start;
  }

  bool concerns(const std::string& name) const {
    return std::count(stop.begin(), stop.end(), name) > 0 ||
           std::count(start.begin(), start.end(), name) > 0;
  }

  /// It does not start these any more, wherever it is. Those that are just being made are made.
  void withdraw(const std::vector<std::string>& names) {
    if (step == Step::make) {
      withdrawn.insert(names.begin(), names.end());
      return;
    }
    auto is_withdrawn = [&](auto& name) {
      return std::count(names.begin(), names.end(), name) > 0;
    };
    if (step == Step::configure || step == Step::start) {
      auto& present = order();
      auto now = present.begin() + static_cast<std::ptrdiff_t>(std::min(at, present.size()));
      auto earlier = std::count_if(present.begin(), now, is_withdrawn);
      if (now != present.end() && is_withdrawn(*now)) {
        asked = nullptr;
        ++steps;
      }
      at -= static_cast<std::size_t>(earlier);
    }
    // Who was to be stopped for it has been.
    if (step != Step::stop)
      stop.clear();
    std::erase_if(start, is_withdrawn);
    std::erase_if(configure, is_withdrawn);
  }

  bool overlaps(const Round& other) const {
    auto concerned = [&](auto& name) { return other.concerns(name); };
    return std::any_of(stop.begin(), stop.end(), concerned) ||
           std::any_of(start.begin(), start.end(), concerned);
  }

  bool includes(const Round& other) const {
    auto concerned = [&](auto& name) { return concerns(name); };
    return std::all_of(other.stop.begin(), other.stop.end(), concerned) &&
           std::all_of(other.start.begin(), other.start.end(), concerned);
  }
};

} // namespace castor
