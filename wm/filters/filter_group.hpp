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

/// Filters with equal conditions on an event's operation, address, source and type, indexed by
/// their conditions on the content: by one part of their predicate (`content_access`), else by the
/// fields that must have changed. Filters with neither are in a list.
class FilterGroup {
public:
  void insert(RegisteredFilter* filter);
  void erase(RegisteredFilter* filter);
  bool empty() const { return plain_.empty() && !content_; }

  /// Whether some filter of the group has a condition on changed fields.
  bool asks_for_changes() const { return content_ && content_->asking_for_changes > 0; }

  /// Calls `f(RegisteredFilter&)` for every filter that may match the event: once, or several times
  /// for filters for changes of several fields.
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

  /// A number, and whether the threshold is just above it: `> 3` sorts after `>= 3`, `<= 3` after
  /// `< 3`.
  using Threshold = std::pair<long double, bool>;

  /// Conditions of filters on one single field.
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
    /// Nothing for a value that is not a number, and for NaN, which compares false with every
    /// threshold.
    static std::optional<long double> as_number(const FieldValue& x);
  };

  /// Conditions of filters on one point.
  struct PointTable {
    RegionTable regions;
    PerType<std::vector<FieldPath>> places;

    template <class F>
    void find(const Value& content, const std::string& path, std::size_t dimensions, F&& f) {
      if (auto point = read(content, path); point.size() == dimensions)
        regions.find(point, f);
    }

    /// The coordinates; empty if the point is absent or the type has no such point.
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
    /// Number of filters with a condition on changed fields, whichever table they are in.
    std::size_t asking_for_changes = 0;

    bool empty() const { return fields.empty() && points.empty() && changing.empty(); }
  };

  /// Whether a filter is indexed neither by a field nor by changes.
  static bool is_plain(const ChangeFilter& filter, const ContentAccess& access) {
    return access.kind == ContentAccess::Kind::none && filter.changing.empty();
  }

  void insert_by_field(const ContentAccess& access, RegisteredFilter* filter);
  void erase_by_field(const ContentAccess& access, RegisteredFilter* filter);

  Filters plain_;
  /// Null if empty, as in most groups of a system with many addresses.
  std::unique_ptr<Content> content_;
};

} // namespace castor
