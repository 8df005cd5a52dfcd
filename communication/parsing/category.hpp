#pragma once

#include "castor/communication/parsing/symbols.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor::communication {

/// Maximum number of features of an atomic category; each is declared in the lexicon.
inline constexpr std::size_t max_features = 4;

/// The value of a feature: 0 for any value, a symbol if positive, a variable if negative. Variables
/// with the same number within one category have the same value.
using FeatureValue = std::int32_t;

struct AtomicCategory {
  Symbol name = 0;
  std::array<FeatureValue, max_features> features{};

  friend bool operator==(const AtomicCategory&, const AtomicCategory&) = default;
};

enum class SlashDirection : std::uint8_t { forward, backward };

/// Combinators allowed for an argument besides application.
enum class SlashMode : std::uint8_t {
  /// None: `/*`.
  application,
  /// Harmonic composition: `/`.
  composition,
  /// Crossed composition too: `/+`.
  crossed
};

struct Argument;

/// A category of combinatory categorial grammar: an atomic result and its arguments, the outermost
/// last: (s\np)/np is s with the arguments \np and /np.
struct Category {
  AtomicCategory result;
  std::vector<Argument> arguments;

  friend bool operator==(const Category&, const Category&) = default;

  /// Number of its atomic categories; each has an index in the semantics.
  std::size_t atoms() const;
};

struct Argument {
  SlashDirection direction = SlashDirection::forward;
  SlashMode mode = SlashMode::composition;
  Category category;

  friend bool operator==(const Argument&, const Argument&) = default;
};

/// The category without its outermost argument.
Category without_last_argument(const Category& category, std::size_t count = 1);

/// Whether no feature keeps the two from being unified, as long as it has no variables: a cheap
/// test that unification fails.
inline bool may_unify(const AtomicCategory& a, const AtomicCategory& b) {
  bool differ = a.name != b.name;
  for (std::size_t i = 0; i < max_features; ++i)
    differ |= a.features[i] > 0 && b.features[i] > 0 && a.features[i] != b.features[i];
  return !differ;
}

/// Values of feature variables.
class FeatureSubstitution {
public:
  /// Unifies two categories; false if that is impossible. \pre their variables are distinct
  bool unify(const Category& a, const Category& b);

  Category apply(const Category& category) const;

private:
  bool unify(const AtomicCategory& a, const AtomicCategory& b);
  FeatureValue resolve(FeatureValue value) const;

  /// Variables and their values; there are few.
  std::vector<std::pair<FeatureValue, FeatureValue>> values_;
};

/// The same category with other variables: `offset` is added to their numbers.
Category with_variables_apart(const Category& category, FeatureValue offset);

/// The same category with variables numbered in order, from 1.
Category with_canonical_variables(const Category& category);

/// In the syntax of lexicon files: (s[dcl]\np[?1])/np.
std::string to_string(const Category& category, const SymbolTable& symbols);

using CategoryId = std::uint32_t;

/// Numbers of categories. Categories equal up to renaming of variables have the same number.
class CategoryTable {
public:
  CategoryId intern(const Category& category);

  const Category& operator[](CategoryId id) const { return *categories_[id]; }

  std::size_t size() const { return categories_.size(); }

private:
  std::unordered_map<std::string, std::pair<CategoryId, Category>> ids_;
  std::vector<const Category*> categories_;
};

} // namespace castor::communication
