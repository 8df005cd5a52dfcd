#pragma once

#include <set>
#include <string>

namespace castor {

/// Write access to a working memory: for components of its own subarchitecture always, for those of
/// other subarchitectures if configured. Every component may read.
class AccessRules {
public:
  explicit AccessRules(std::string owner) : owner_(std::move(owner)) {}

  void allow(std::string subarchitecture) { writers_.insert(std::move(subarchitecture)); }
  void allow_all() { open_ = true; }

  bool may_write(const std::string& subarchitecture) const {
    return open_ || subarchitecture == owner_ || writers_.count(subarchitecture) > 0;
  }

private:
  std::string owner_;
  std::set<std::string> writers_;
  bool open_ = false;
};

} // namespace castor
