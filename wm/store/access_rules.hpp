#pragma once

#include <set>
#include <string>

namespace castor {

/// Who may write to a working memory: the components of its own subarchitecture always, those of
/// other subarchitectures where the configuration says so. Reading is free.
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
