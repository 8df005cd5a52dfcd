#pragma once

#include "castor/mapping/body/body_state_text.hpp"

#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace castor::mapping {

/// The simulated bodies of this process, by the names of their components: a robot stays where it
/// is when the component that simulates it fails. Thread-safe.
class KeptBodies {
public:
  static KeptBodies& instance();

  void keep(const std::string& name, const SavedBody& x);

  /// Nothing if none was kept.
  std::optional<SavedBody> find(const std::string& name) const;

private:
  mutable std::mutex mutex_;
  std::map<std::string, SavedBody> bodies_;
};

} // namespace castor::mapping
