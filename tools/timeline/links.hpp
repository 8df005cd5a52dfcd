#pragma once

#include "castor/tools/timeline/contents.hpp"

#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor::timeline {

/// Finds the entries that an entry refers to: by address, by a string that is the id of an entry,
/// or by its own id if it contains theirs ("location of 1:3").
class Links {
public:
  /// Registers an entry, which may have been deleted since.
  void know(const Address& x) { by_id_[x.id].insert(x.subarchitecture); }

  /// Addresses of the referenced entries, without the entry itself.
  std::set<Address> of(const Address& entry, const Contents& contents) const {
    std::set<Address> result;
    auto add = [&](const std::optional<Address>& x) {
      if (x && *x != entry)
        result.insert(*x);
    };
    for (auto& x : contents.addresses)
      if (is_known(x))
        add(x);
    for (auto& x : contents.texts)
      add(find(x, entry.subarchitecture));
    add(origin_of(entry));
    return result;
  }

  bool is_known(const Address& x) const {
    auto i = by_id_.find(x.id);
    return i != by_id_.end() && i->second.count(x.subarchitecture) > 0;
  }

  bool is_id(const std::string& x) const { return by_id_.count(x) > 0; }

private:
  /// Finds an entry by its id: in that subarchitecture first, else in another one if the id is
  /// unambiguous.
  std::optional<Address> find(const std::string& id, const std::string& subarchitecture) const {
    auto i = by_id_.find(id);
    if (i == by_id_.end())
      return std::nullopt;
    if (i->second.count(subarchitecture) > 0)
      return Address{subarchitecture, id};
    if (i->second.size() == 1)
      return Address{*i->second.begin(), id};
    return std::nullopt;
  }

  /// The longest other entry id that is a suffix of the entry's id.
  std::optional<Address> origin_of(const Address& entry) const {
    for (std::size_t at = entry.id.find_first_of(" /"); at != std::string::npos;
         at = entry.id.find_first_of(" /", at + 1))
      if (auto found = find(entry.id.substr(at + 1), entry.subarchitecture))
        return found;
    return std::nullopt;
  }

  /// By id: the subarchitectures that have an entry with it.
  std::unordered_map<std::string, std::set<std::string>> by_id_;
};

} // namespace castor::timeline
