#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace castor::simulation {

/// Counts of occurrences in simulated systems, by group: "faults" has "crash" 12 times.
class Happenings {
public:
  using Counts = std::map<std::string, std::uint64_t, std::less<>>;

  /// Zero for every occurrence that is possible.
  static Happenings everything();

  void add(std::string_view group, std::string_view what, std::uint64_t times = 1);
  void add(const Happenings& other);

  std::uint64_t count(std::string_view group, std::string_view what) const;
  std::uint64_t sum(std::string_view group) const;
  const std::map<std::string, Counts, std::less<>>& groups() const { return groups_; }

  /// Possible occurrences with count zero, as "group: what".
  std::vector<std::string> never() const;

  friend bool operator==(const Happenings&, const Happenings&) = default;

private:
  std::map<std::string, Counts, std::less<>> groups_;
};

} // namespace castor::simulation
