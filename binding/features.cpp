#include "castor/binding/features.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <utility>

namespace castor::binding {

namespace {

Feature numeric(FeatureKind kind, std::vector<double> numbers) {
  Feature result;
  result.kind = kind;
  result.numbers = std::move(numbers);
  return result;
}

} // namespace

Feature feature(FeatureKind kind, std::string text) {
  Feature result;
  result.kind = kind;
  result.text = std::move(text);
  return result;
}

Feature negated(Feature x) {
  x.holds = !x.holds;
  return x;
}

Feature location_at(double x, double y, double z) {
  return numeric(FeatureKind::location, {x, y, z});
}

Feature not_from(const std::string& subarchitecture) {
  return negated(feature(FeatureKind::other_source_id, subarchitecture));
}

Feature tether_to(AnyEntryPointer data) {
  Feature result;
  result.kind = FeatureKind::source_data;
  result.data = std::move(data);
  return result;
}

Feature created_at(std::int64_t time) {
  return numeric(FeatureKind::creation_time, {static_cast<double>(time)});
}

Feature salient_from(std::int64_t begin, std::optional<std::int64_t> end) {
  std::vector<double> numbers{static_cast<double>(begin)};
  if (end)
    numbers.push_back(static_cast<double>(*end));
  return numeric(FeatureKind::salience, std::move(numbers));
}

const Feature* find_feature(std::span<const Feature> features, FeatureKind kind) {
  for (const auto& x : features) {
    if (x.kind == kind)
      return &x;
  }
  return nullptr;
}

KindSet kinds_of(std::span<const Feature> features) {
  KindSet result = 0;
  for (const auto& x : features)
    result |= bit(x.kind);
  return result;
}

std::string to_string(FeatureKind kind) {
  static constexpr auto reflection = reflection_of<FeatureKind>();
  for (const auto& [name, value] : reflection.enumerators) {
    if (value == kind)
      return std::string{name};
  }
  return std::to_string(static_cast<int>(kind));
}

std::string to_string(const Feature& x) {
  auto result = (x.holds ? "" : "not ") + to_string(x.kind);
  if (!x.text.empty())
    result += ' ' + x.text;
  if (!x.numbers.empty())
    result += fmt::format(" ({})", fmt::join(x.numbers, ", "));
  if (x.data)
    result += fmt::format(" {} {}", x.data.type, to_string(x.data.address));
  return result;
}

} // namespace castor::binding
