#pragma once

#include <map>
#include <string>
#include <utility>

namespace castor::communication {

/// Binds a nominal while something is evaluated.
class ScopedBinding {
public:
  ScopedBinding(std::map<std::string, std::string>& bound, const std::string& nominal)
    : bound_(bound), nominal_(nominal), before_(bound.extract(nominal)) {}
  ~ScopedBinding() {
    bound_.erase(nominal_);
    if (!before_.empty())
      bound_.insert(std::move(before_));
  }
  ScopedBinding(const ScopedBinding&) = delete;
  ScopedBinding& operator=(const ScopedBinding&) = delete;

  void set(const std::string& id) { bound_[nominal_] = id; }

private:
  std::map<std::string, std::string>& bound_;
  std::string nominal_;
  std::map<std::string, std::string>::node_type before_;
};

} // namespace castor::communication
