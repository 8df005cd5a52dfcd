#pragma once

#include "castor/planning/motivation/motive_templates.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

/// Finds the motives that facts and idleness occasion: each when its facts become true, and again
/// some time later if they still are, since what it led to may have been given up.
class Occasions {
public:
  /// @param again time after which facts that are still true occasion their motive again; 0: never
  explicit Occasions(std::vector<MotiveTemplate> templates, std::chrono::microseconds again = {})
    : templates_(std::move(templates)), again_(again) {
    // nop
  }

  /// Motives that are occasioned now.
  /// @param is_idle whether no motive is queued or pursued
  std::vector<Motive> look(const std::vector<std::string>& facts, bool is_idle, Timestamp now);

private:
  std::vector<MotiveTemplate> templates_;
  std::chrono::microseconds again_;
  /// By template and values: when they occasioned their motive.
  std::map<std::pair<std::string, MotiveValues>, Timestamp> present_;
  /// Since when there is nothing to do.
  std::optional<Timestamp> idle_since_;
};

} // namespace castor::planning
