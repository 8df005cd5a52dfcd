#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// Keeps whoever can cause a message at will from filling the log: of messages that differ in their
/// digits only, a few are written in each period, and the others are counted.
///
/// Pure: it gets the time, and returns what to write.
class RepeatedMessages {
public:
  using Time = std::chrono::steady_clock::time_point;

  struct Limits {
    std::chrono::seconds period{10};
    /// Messages of a kind that are written in one period.
    std::uint32_t written = 5;
    /// Kinds that are told apart; what is of none of them is of one more kind.
    std::size_t kinds = 64;
    /// Bytes of a message that are written.
    std::size_t length = 400;
  };

  RepeatedMessages() : RepeatedMessages(Limits{}) {}
  explicit RepeatedMessages(Limits limits) : limits_(limits) {}

  /// What to write of a message, which may be nothing.
  std::optional<std::string> add(std::string_view message, Time now);

  /// What to write of those that were counted: one line for each kind whose period is over.
  std::vector<std::string> take_due(Time now);

  /// The same for all kinds, whether their period is over or not.
  std::vector<std::string> take_all();

private:
  struct Kind {
    Time since;
    std::uint32_t written = 0;
    std::uint64_t counted = 0;
    std::string last = {};
  };

  std::string shortened(std::string_view message) const;
  std::string summary(const Kind& x) const;

  Limits limits_;
  std::map<std::string, Kind> kinds_;
};

} // namespace castor
