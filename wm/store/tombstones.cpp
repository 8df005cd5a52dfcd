#include "castor/wm/store/tombstones.hpp"

#include <algorithm>
#include <utility>

namespace castor {

std::optional<Tombstones::Tombstone> Tombstones::add(const std::string& id, Version version,
                                                     std::uint64_t sequence) {
  erase(id);
  by_id_[id] = tombstones_.insert(tombstones_.end(), {id, version, sequence});
  if (tombstones_.size() <= limit_)
    return std::nullopt;
  auto oldest = std::move(tombstones_.front());
  tombstones_.pop_front();
  by_id_.erase(oldest.id);
  raise_floor(current_version(oldest) + 1);
  return oldest;
}

bool Tombstones::erase(const std::string& id) {
  auto i = by_id_.find(id);
  if (i == by_id_.end())
    return false;
  tombstones_.erase(i->second);
  by_id_.erase(i);
  return true;
}

std::optional<Version> Tombstones::version(const std::string& id) const {
  auto i = by_id_.find(id);
  return i == by_id_.end() ? std::nullopt : std::optional{current_version(*i->second)};
}

Version Tombstones::version_for_add(const std::string& id) const {
  auto last = version(id);
  return last ? *last + 1 : floor_;
}

void Tombstones::begin_incarnation(std::uint64_t first_number) {
  first_number_ = std::max(first_number_, first_number);
  raise_floor(first_number_);
}

void Tombstones::raise_floor(Version floor) {
  floor_ = std::max(floor_, floor);
}

} // namespace castor
