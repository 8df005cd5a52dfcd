#pragma once

#include "castor/wm/entries/client.hpp"

#include <optional>
#include <set>
#include <string>
#include <utility>

namespace castor {

/// Access to a working memory. Components of its own subarchitecture may write and read, those of
/// others may write if configured. They may read unless it is configured who may; operators, and
/// the runtime itself, always may.
class AccessRules {
public:
  explicit AccessRules(std::string owner) : owner_(std::move(owner)) {}

  void allow(std::string subarchitecture) { writers_.insert(std::move(subarchitecture)); }
  void allow_all() { open_ = true; }

  bool may_write(const std::string& subarchitecture) const {
    return open_ || subarchitecture == owner_ || writers_.count(subarchitecture) > 0;
  }

  /// Nothing for everybody.
  void set_readers(std::optional<std::set<std::string>> readers) { readers_ = std::move(readers); }

  bool may_read(const std::string& subarchitecture) const {
    return !readers_ || subarchitecture == owner_ || subarchitecture.empty() ||
           subarchitecture == operators || readers_->count("*") > 0 ||
           readers_->count(subarchitecture) > 0;
  }

  /// Why a subarchitecture may not read, and the remedy.
  std::string readers_text(const std::string& subarchitecture) const {
    std::string others;
    for (auto& reader : *readers_)
      others += " and of " + reader;
    return "only components of " + owner_ + others +
           " read there, since the system's .cast file has rules ACCESS reader READS " + owner_ +
           ". To allow it, add ACCESS " + subarchitecture + " READS " + owner_;
  }

private:
  std::string owner_;
  std::set<std::string> writers_;
  std::optional<std::set<std::string>> readers_;
  bool open_ = false;
};

} // namespace castor
