#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace castor {

/// What a component has done so far with the entries of a type in one working memory.
struct Access {
  std::string component;
  /// Whose working memory holds the entries.
  std::string subarchitecture;
  std::string type;
  std::uint64_t adds = 0;
  std::uint64_t overwrites = 0;
  std::uint64_t deletes = 0;
  std::uint64_t reads = 0;
  /// Events that the component wanted.
  std::uint64_t events = 0;

  std::uint64_t writes() const { return adds + overwrites + deletes; }

  friend bool operator==(const Access&, const Access&) = default;
};

/// Who uses what, and how often.
class AccessLog {
public:
  /// Counts one more.
  void note(std::string_view component, std::string_view subarchitecture, std::string_view type,
            std::uint64_t Access::*what) {
    auto key = std::tie(component, subarchitecture, type);
    auto i = accesses_.lower_bound(key);
    if (i == accesses_.end() || key_of(i->second) != key) {
      Access x;
      x.component = component;
      x.subarchitecture = subarchitecture;
      x.type = type;
      i = accesses_.emplace_hint(i, Key{x.component, x.subarchitecture, x.type}, x);
    }
    ++(i->second.*what);
  }

  /// By component, subarchitecture and type.
  std::vector<Access> all() const {
    std::vector<Access> result;
    for (auto& [key, access] : accesses_)
      result.push_back(access);
    return result;
  }

private:
  using Key = std::tuple<std::string, std::string, std::string>;
  using View = std::tuple<std::string_view, std::string_view, std::string_view>;

  static View key_of(const Access& x) { return {x.component, x.subarchitecture, x.type}; }

  std::map<Key, Access, std::less<>> accesses_;
};

} // namespace castor
