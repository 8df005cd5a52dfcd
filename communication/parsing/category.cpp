#include "castor/communication/parsing/category.hpp"

#include <algorithm>
#include <functional>

namespace castor::communication {

namespace {

void for_each_atom(Category& category, const std::function<void(AtomicCategory&)>& f) {
  f(category.result);
  for (auto& argument : category.arguments)
    for_each_atom(argument.category, f);
}

void append_key(const Category& category, std::string& key) {
  key += std::to_string(category.result.name);
  for (const auto feature : category.result.features)
    key += ',' + std::to_string(feature);
  for (const auto& argument : category.arguments) {
    key += argument.direction == SlashDirection::forward ? '/' : '\\';
    key += std::to_string(static_cast<int>(argument.mode)) + '(';
    append_key(argument.category, key);
    key += ')';
  }
}

std::string to_string(const AtomicCategory& atom, const SymbolTable& symbols) {
  std::string features;
  for (const auto feature : atom.features)
    if (feature != 0)
      features +=
        (features.empty() ? "" : ",") +
        (feature > 0 ? symbols.text(static_cast<Symbol>(feature)) : "?" + std::to_string(-feature));
  return symbols.text(atom.name) + (features.empty() ? "" : "[" + features + "]");
}

} // namespace

std::size_t Category::atoms() const {
  std::size_t count = 1;
  for (const auto& argument : arguments)
    count += argument.category.atoms();
  return count;
}

Category without_last_argument(const Category& category, std::size_t count) {
  Category shorter{category.result, {}};
  shorter.arguments.assign(category.arguments.begin(),
                           category.arguments.end() - static_cast<std::ptrdiff_t>(count));
  return shorter;
}

FeatureValue FeatureSubstitution::resolve(FeatureValue value) const {
  while (value < 0) {
    const auto known = std::find_if(values_.begin(), values_.end(),
                                    [value](const auto& x) { return x.first == value; });
    if (known == values_.end())
      break;
    value = known->second;
  }
  return value;
}

bool FeatureSubstitution::unify(const AtomicCategory& a, const AtomicCategory& b) {
  if (a.name != b.name)
    return false;
  for (std::size_t i = 0; i < max_features; ++i) {
    const auto x = resolve(a.features[i]);
    const auto y = resolve(b.features[i]);
    if (x == y || x == 0 || y == 0)
      continue;
    if (x < 0)
      values_.emplace_back(x, y);
    else if (y < 0)
      values_.emplace_back(y, x);
    else
      return false;
  }
  return true;
}

bool FeatureSubstitution::unify(const Category& a, const Category& b) {
  if (a.arguments.size() != b.arguments.size() || !unify(a.result, b.result))
    return false;
  for (std::size_t i = 0; i < a.arguments.size(); ++i)
    if (a.arguments[i].direction != b.arguments[i].direction ||
        !unify(a.arguments[i].category, b.arguments[i].category))
      return false;
  return true;
}

Category FeatureSubstitution::apply(const Category& category) const {
  auto result = category;
  for_each_atom(result, [this](AtomicCategory& atom) {
    for (auto& feature : atom.features)
      feature = resolve(feature);
  });
  return result;
}

Category with_variables_apart(const Category& category, FeatureValue offset) {
  auto result = category;
  for_each_atom(result, [offset](AtomicCategory& atom) {
    for (auto& feature : atom.features)
      if (feature < 0)
        feature -= offset;
  });
  return result;
}

Category with_canonical_variables(const Category& category) {
  auto result = category;
  std::unordered_map<FeatureValue, FeatureValue> numbers;
  for_each_atom(result, [&numbers](AtomicCategory& atom) {
    for (auto& feature : atom.features)
      if (feature < 0)
        feature =
          numbers.emplace(feature, -static_cast<FeatureValue>(numbers.size()) - 1).first->second;
  });
  return result;
}

std::string to_string(const Category& category, const SymbolTable& symbols) {
  std::string text = to_string(category.result, symbols);
  for (std::size_t i = 0; i < category.arguments.size(); ++i) {
    const auto& argument = category.arguments[i];
    if (i > 0)
      text = "(" + text + ")";
    text += argument.direction == SlashDirection::forward ? '/' : '\\';
    if (argument.mode == SlashMode::application)
      text += '*';
    else if (argument.mode == SlashMode::crossed)
      text += '+';
    const auto inner = to_string(argument.category, symbols);
    text += argument.category.arguments.empty() ? inner : "(" + inner + ")";
  }
  return text;
}

CategoryId CategoryTable::intern(const Category& category) {
  auto canonical = with_canonical_variables(category);
  std::string key;
  append_key(canonical, key);
  const auto [place, is_new] = ids_.try_emplace(std::move(key));
  if (is_new) {
    place->second = {static_cast<CategoryId>(categories_.size()), std::move(canonical)};
    categories_.push_back(&place->second.second);
  }
  return place->second.first;
}

} // namespace castor::communication
