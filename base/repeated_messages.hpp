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

/// Rate limit for log messages that others can cause without limit: of messages that differ in
/// their digits only, a few are written in each period, and the others are counted.
///
/// Pure: time is passed in, lines to write are returned.
class RepeatedMessages {
public:
  using Time = std::chrono::steady_clock::time_point;

  struct Limits {
    std::chrono::seconds period{10};
    /// Messages of one kind that are written per period.
    std::uint32_t written = 5;
    /// Maximum number of kinds; messages beyond it share one further kind.
    std::size_t kinds = 64;
    /// Maximum length of a written message, in bytes.
    std::size_t length = 400;
  };

  RepeatedMessages() : RepeatedMessages(Limits{}) {}
  explicit RepeatedMessages(Limits limits) : limits_(limits) {}

  /// Line to write for a message; nothing if it was only counted.
  std::optional<std::string> add(std::string_view message, Time now);

  /// Lines with the counts of unwritten messages, one for each kind whose period is over.
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
