#pragma once

#include "castor/communication/parsing/category.hpp"

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

/// The combinatory rules: application, and composition over up to two arguments, harmonic and
/// crossed.
class Combinators {
public:
  explicit Combinators(CategoryTable& categories) : categories_(categories) {
    // nop
  }

  /// All combinations of `left` with its right neighbour.
  const std::vector<Combination>& combine(CategoryId left, CategoryId right);

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

  static Outline outline(const Category& category);
  static bool may_apply(const Outline& function, const Outline& argument, SlashDirection direction);
  const std::vector<Combination>& found_or_made(CategoryId left, CategoryId right);
  void apply(const Category& function, const Category& argument, SlashDirection direction,
             std::vector<Combination>& found);

  CategoryTable& categories_;
  /// By category; for the first categories of the table.
  std::vector<Outline> outlines_;
  std::unordered_map<std::uint64_t, std::vector<Combination>> known_;
};

} // namespace castor::communication
