#include "castor/binding/features.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

namespace castor::binding {

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
  auto result = (x.negated ? "not " : "") + to_string(x.kind);
  if (!x.text.empty())
    result += ' ' + x.text;
  if (!x.numbers.empty())
    result += fmt::format(" ({})", fmt::join(x.numbers, ", "));
  if (x.data)
    result += fmt::format(" {} {}", x.data.type, to_string(x.data.address));
  return result;
}

} // namespace castor::binding
