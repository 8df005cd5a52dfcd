#pragma once

#include "castor/wm/filters/content_access.hpp"
#include "castor/wm/filters/region_table.hpp"
#include "castor/wm/filters/registered_filter.hpp"
#include "castor/wm/values/per_type.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// Filters that ask the same of an event's operation, address, source and type, found by what they
/// ask of the content: through one part of their predicate (`content_access`), or through the
/// fields that must have changed, or, if there is neither, one by one.
class FilterGroup {
public:
  void insert(RegisteredFilter* filter);
  void erase(RegisteredFilter* filter);
  bool empty() const { return plain_.empty() && !content_; }

  /// Whether some filter here asks for changed fields.
  bool asks_for_changes() const { return content_ && content_->asking_for_changes > 0; }

  /// Calls `f(RegisteredFilter&)` for every filter that may want the event: once, but for those
  /// that wait for the change of several fields.
  template <class F>
  void find(const ChangeEvent& event, const Value& content, F&& f) {
    for (auto* filter : plain_)
      f(*filter);
    if (!content_)
      return;
    auto call = [&](RegisteredFilter* filter) { f(*filter); };
    if (event.changed != 0)
      for (auto& [name, table] : content_->changing)
        if (table.concerns(event, name))
          for (auto* filter : table.filters)
            call(filter);
    if (!content.has_value())
      return;
    for (auto& [path, table] : content_->fields)
      table.find(content, path, call);
    for (auto& [path, table] : content_->points)
      table.find(content, path.first, path.second, call);
  }

private:
  using Filters = std::vector<RegisteredFilter*>;

  /// A threshold and whether it is beyond its number: `> 3` comes after `>= 3`, `<= 3` after `< 3`.
  using Threshold = std::pair<long double, bool>;

  /// What filters ask of one single field.
  struct FieldTable {
    std::unordered_map<FieldValue, Filters> equal;
    RegionTable regions;
    std::map<Threshold, Filters> above;
    std::map<Threshold, Filters> below;
    PerType<std::optional<FieldPath>> places;

    bool empty() const {
      return equal.empty() && regions.empty() && above.empty() && below.empty();
    }

    template <class F>
    void find(const Value& content, const std::string& path, F&& f) {
      auto value = read(content, path);
      if (!value)
        return;
      if (auto found = equal.find(*value); found != equal.end())
        for (auto* filter : found->second)
          f(filter);
      if (auto number = as_number(*value)) {
        for (auto i = above.begin(); i != above.end() && i->first <= Threshold{*number, false}; ++i)
          for (auto* filter : i->second)
            f(filter);
        for (auto i = below.lower_bound({*number, true}); i != below.end(); ++i)
          for (auto* filter : i->second)
            f(filter);
        auto rounded = static_cast<double>(*number);
        regions.find({&rounded, 1}, f);
      }
    }

    /// The field, normalised; nothing if it is absent or the type has no such field.
    std::optional<FieldValue> read(const Value& content, const std::string& path);
    /// Nothing for what is not a number, and for NaN, which is on no side of a threshold.
    static std::optional<long double> as_number(const FieldValue& x);
  };

  /// What filters ask of one point.
  struct PointTable {
    RegionTable regions;
    PerType<std::vector<FieldPath>> places;

    template <class F>
    void find(const Value& content, const std::string& path, std::size_t dimensions, F&& f) {
      if (auto point = read(content, path); point.size() == dimensions)
        regions.find(point, f);
    }

    /// The coordinates; none if it is absent or the type has no such point.
    std::vector<double> read(const Value& content, const std::string& path);
  };

  struct ChangingTable {
    Filters filters;
    PerType<FieldMask> bits;

    bool concerns(const ChangeEvent& event, const std::string& name);
  };

  struct Content {
    std::map<std::string, FieldTable> fields;
    /// By path and number of coordinates.
    std::map<std::pair<std::string, std::size_t>, PointTable> points;
    std::map<std::string, ChangingTable> changing;
    /// How many filters ask for changed fields, by whatever they are looked up.
    std::size_t asking_for_changes = 0;

    bool empty() const { return fields.empty() && points.empty() && changing.empty(); }
  };

  /// Whether a filter is looked up neither by a field nor by changes.
  static bool is_plain(const ChangeFilter& filter, const ContentAccess& access) {
    return access.kind == ContentAccess::Kind::none && filter.changing.empty();
  }

  void insert_by_field(const ContentAccess& access, RegisteredFilter* filter);
  void erase_by_field(const ContentAccess& access, RegisteredFilter* filter);

  Filters plain_;
  /// Most groups of a system with many addresses have none.
  std::unique_ptr<Content> content_;
};

} // namespace castor
