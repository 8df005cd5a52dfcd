#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace castor::planning {

/// Which subarchitecture executes which actions of plans.
class Executors {
public:
  Executors() = default;

  /// @param rules "move=navigation", or "ask-*=communication" for all names that begin so
  /// @param standard for all others
  /// \throws std::invalid_argument names a rule that is none
  Executors(const std::vector<std::string>& rules, std::string standard);

  /// Of several rules, the longest counts.
  std::string executor_of(std::string_view action) const;

private:
  std::map<std::string, std::string, std::less<>> names_;
  std::map<std::string, std::string, std::less<>> prefixes_;
  std::string standard_;
};

} // namespace castor::planning
