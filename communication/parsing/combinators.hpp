#pragma once

#include "castor/communication/parsing/category.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace castor::communication {

enum class Combinator : std::uint8_t {
  lexical,
  type_raising,
  forward_application,
  backward_application,
  forward_composition,
  backward_composition,
  forward_crossed_composition,
  backward_crossed_composition
};

bool is_forward(Combinator combinator);
bool is_composition(Combinator combinator);

/// A way to combine two adjacent categories into one.
struct Combination {
  Combinator combinator;
  CategoryId result;
  /// Number of the function's indices that belong to its result; the others belong to its argument,
  /// and are unified with the first of the argument's indices.
  std::uint16_t result_atoms;
  /// The function modifies its argument, such as a noun: the result has the argument's category.
  /// "That is" before "left of the box" modifies nothing.
  bool modifies = false;
};

/// Composition reaches over so many arguments: X/Y (Y/Z)/W makes (X/Z)/W.
inline constexpr std::size_t max_composition_degree = 2;

/// The combinatory rules: application, and composition over up to two arguments, harmonic and
/// crossed.
class Combinators {
public:
  explicit Combinators(CategoryTable& categories) : categories_(categories) {
    // nop
  }

  /// All combinations of `left` with its right neighbour.
  const std::vector<Combination>& combine(CategoryId left, CategoryId right) {
    if (std::max(left, right) >= outlines_.size())
      add_outlines();
    const auto& a = outlines_[left];
    const auto& b = outlines_[right];
    if (may_apply(a, b, SlashDirection::forward) || may_apply(b, a, SlashDirection::backward))
      return found_or_made(left, right);
    return none_;
  }

  /// The type-raised category: x becomes `result`/(`result`\x).
  CategoryId raised(CategoryId category, const AtomicCategory& result);

private:
  /// What shows of most pairs of categories that they cannot be combined, without unifying them.
  struct Outline {
    AtomicCategory result;
    std::uint32_t arguments = 0;
    /// Of the outermost argument, if there is any.
    SlashDirection direction = SlashDirection::forward;
    std::uint32_t wanted_arguments = 0;
    AtomicCategory wanted;
  };

  static bool may_apply(const Outline& function, const Outline& argument,
                        SlashDirection direction) {
    return function.arguments > 0 && function.direction == direction &&
           function.wanted_arguments <= argument.arguments &&
           argument.arguments <= function.wanted_arguments + max_composition_degree &&
           may_unify(function.wanted, argument.result);
  }

  void add_outlines();
  const std::vector<Combination>& found_or_made(CategoryId left, CategoryId right);
  void apply(const Category& function, const Category& argument, SlashDirection direction,
             std::vector<Combination>& found);

  CategoryTable& categories_;
  /// By category; for the first categories of the table.
  std::vector<Outline> outlines_;
  const std::vector<Combination> none_;
  std::unordered_map<std::uint64_t, std::vector<Combination>> known_;
};

} // namespace castor::communication
