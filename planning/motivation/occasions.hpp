#pragma once

#include "castor/planning/motivation/motive_templates.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

/// Finds the motives that facts and idleness occasion: each once, until its facts were false in
/// between.
class Occasions {
public:
  explicit Occasions(std::vector<MotiveTemplate> templates) : templates_(std::move(templates)) {
    // nop
  }

  /// Motives that are occasioned now and were not the last time.
  /// @param is_idle whether no motive is queued or pursued
  std::vector<Motive> look(const std::vector<std::string>& facts, bool is_idle, Timestamp now);

private:
  std::vector<MotiveTemplate> templates_;
  std::set<std::pair<std::string, MotiveValues>> present_;
  /// Since when there is nothing to do.
  std::optional<Timestamp> idle_since_;
};

} // namespace castor::planning
