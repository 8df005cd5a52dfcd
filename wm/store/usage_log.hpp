#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace castor {

/// A component's operations so far on the entries of a type in one working memory.
struct Usage {
  std::string component;
  /// Subarchitecture whose working memory holds the entries.
  std::string subarchitecture;
  std::string type;
  std::uint64_t adds = 0;
  std::uint64_t overwrites = 0;
  std::uint64_t deletes = 0;
  std::uint64_t reads = 0;
  /// Events that matched the component's filters.
  std::uint64_t events = 0;

  std::uint64_t writes() const { return adds + overwrites + deletes; }

  friend bool operator==(const Usage&, const Usage&) = default;
};

/// Counts of operations by component, subarchitecture and type.
class UsageLog {
public:
  /// Adds to one counter.
  void record(std::string_view component, std::string_view subarchitecture, std::string_view type,
              std::uint64_t Usage::*what, std::uint64_t count = 1) {
    usage(component, subarchitecture, type).*what += count;
  }

  /// The counters of a component, to be kept by who adds to them often. They stay where they are.
  Usage& usage(std::string_view component, std::string_view subarchitecture,
               std::string_view type) {
    auto key = std::tie(component, subarchitecture, type);
    auto i = usages_.lower_bound(key);
    if (i == usages_.end() || key_of(i->second) != key) {
      Usage x;
      x.component = component;
      x.subarchitecture = subarchitecture;
      x.type = type;
      i = usages_.emplace_hint(i, Key{x.component, x.subarchitecture, x.type}, x);
    }
    return i->second;
  }

  /// Sorted by component, subarchitecture and type.
  std::vector<Usage> all() const {
    std::vector<Usage> result;
    for (auto& [key, usage] : usages_)
      result.push_back(usage);
    return result;
  }

private:
  using Key = std::tuple<std::string, std::string, std::string>;
  using View = std::tuple<std::string_view, std::string_view, std::string_view>;

  static View key_of(const Usage& x) { return {x.component, x.subarchitecture, x.type}; }

  std::map<Key, Usage, std::less<>> usages_;
};

} // namespace castor
