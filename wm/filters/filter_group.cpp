#include "castor/wm/filters/filter_group.hpp"

#include "castor/wm/values/point_field.hpp"

#include <cmath>

namespace castor {

namespace {

using Kind = ContentAccess::Kind;

/// The key of a threshold in the order described at `Threshold`.
std::pair<long double, bool> threshold(const ContentAccess& x) {
  return {x.threshold, x.inclusive == (x.kind == Kind::below)};
}

/// Regions of numbers have one coordinate and are kept with the other conditions on their field.
bool is_of_point(const ContentAccess& x) {
  return x.kind == Kind::region && x.region.size() > 1;
}

/// Removes the filter from where it stands under `key`, which goes when it is empty.
template <class Map, class Key>
void erase_from(Map& map, const Key& key, RegisteredFilter* filter) {
  auto i = map.find(key);
  std::erase(i->second, filter);
  if (i->second.empty())
    map.erase(i);
}

} // namespace

void FilterGroup::insert(RegisteredFilter* filter) {
  auto access = content_access(filter->filter.predicate);
  if (is_plain(filter->filter, access)) {
    plain_.push_back(filter);
    return;
  }
  if (!content_)
    content_ = std::make_unique<Content>();
  auto& changing = filter->filter.changing;
  content_->asking_for_changes += changing.empty() ? 0 : 1;
  if (access.kind != Kind::none)
    insert_by_field(access, filter);
  else
    for (auto& name : changing)
      content_->changing[name].filters.push_back(filter);
}

void FilterGroup::erase(RegisteredFilter* filter) {
  auto access = content_access(filter->filter.predicate);
  if (is_plain(filter->filter, access)) {
    std::erase(plain_, filter);
    return;
  }
  auto& changing = filter->filter.changing;
  content_->asking_for_changes -= changing.empty() ? 0 : 1;
  if (access.kind != Kind::none)
    erase_by_field(access, filter);
  else
    for (auto& name : changing) {
      auto i = content_->changing.find(name);
      std::erase(i->second.filters, filter);
      if (i->second.filters.empty())
        content_->changing.erase(i);
    }
  if (content_->empty())
    content_.reset();
}

void FilterGroup::insert_by_field(const ContentAccess& access, RegisteredFilter* filter) {
  if (is_of_point(access)) {
    content_->points[{access.path, access.region.size()}].regions.insert(access.region, filter);
    return;
  }
  auto& table = content_->fields[access.path];
  if (access.kind == Kind::equal)
    table.equal[access.literal].push_back(filter);
  else if (access.kind == Kind::region)
    table.regions.insert(access.region, filter);
  else
    (access.kind == Kind::above ? table.above : table.below)[threshold(access)].push_back(filter);
}

void FilterGroup::erase_by_field(const ContentAccess& access, RegisteredFilter* filter) {
  if (is_of_point(access)) {
    auto i = content_->points.find({access.path, access.region.size()});
    i->second.regions.erase(access.region, filter);
    if (i->second.regions.empty())
      content_->points.erase(i);
    return;
  }
  auto i = content_->fields.find(access.path);
  auto& table = i->second;
  if (access.kind == Kind::equal)
    erase_from(table.equal, access.literal, filter);
  else if (access.kind == Kind::region)
    table.regions.erase(access.region, filter);
  else
    erase_from(access.kind == Kind::above ? table.above : table.below, threshold(access), filter);
  if (table.empty())
    content_->fields.erase(i);
}

std::optional<FieldValue> FilterGroup::FieldTable::read(const Value& content,
                                                        const std::string& path) {
  auto& place = places.get(content.type_ptr(), [&]() -> std::optional<FieldPath> {
    try {
      auto found = find_field(content.type(), path);
      return is_single(found.type->kind) ? std::optional{std::move(found.path)} : std::nullopt;
    } catch (const FieldError&) {
      return std::nullopt;
    }
  });
  if (!place)
    return std::nullopt;
  try {
    auto result = normalised(content.field(*place));
    return std::holds_alternative<std::monostate>(result) ? std::nullopt
                                                          : std::optional{std::move(result)};
  } catch (const DecodeError&) {
    return std::nullopt;
  }
}

std::optional<long double> FilterGroup::FieldTable::as_number(const FieldValue& x) {
  if (auto* integer = std::get_if<std::int64_t>(&x))
    return static_cast<long double>(*integer);
  if (auto* natural = std::get_if<std::uint64_t>(&x))
    return static_cast<long double>(*natural);
  if (auto* real = std::get_if<double>(&x); real && !std::isnan(*real))
    return static_cast<long double>(*real);
  return std::nullopt;
}

std::vector<double> FilterGroup::PointTable::read(const Value& content, const std::string& path) {
  auto& coordinates = places.get(content.type_ptr(), [&]() -> std::vector<FieldPath> {
    try {
      return find_point(content.type(), path);
    } catch (const FieldError&) {
      return {};
    }
  });
  std::vector<double> result;
  try {
    for (auto& coordinate : coordinates)
      result.push_back(as_double(content.field(coordinate)));
  } catch (const DecodeError&) {
    result.clear();
  }
  return result;
}

bool FilterGroup::ChangingTable::concerns(const ChangeEvent& event, const std::string& name) {
  return (event.changed & bits.get(event.type, [&] { return field_bit(*event.type, name); })) != 0;
}

} // namespace castor
