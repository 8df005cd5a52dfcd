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

/// How two neighbours make one.
struct Combination {
  Combinator combinator;
  CategoryId result;
  /// Of the function's indices so many are those of its result; the others are those of the
  /// argument, and meet the first of the argument's indices.
  std::uint16_t result_atoms;
  /// The function modifies the argument, a noun or the like: what it makes is of the argument's
  /// category again. "That is" before "left of the box" modifies nothing.
  bool modifies = false;
};

/// The combinatory rules: application, and composition over up to two arguments, harmonic and
/// crossed.
class Combinators {
public:
  explicit Combinators(CategoryTable& categories) : categories_(categories) {
    // nop
  }

  /// All that `left` and its right neighbour can make.
  const std::vector<Combination>& combine(CategoryId left, CategoryId right);

  /// The category of something that finds a function to be the argument of: x becomes
  /// `result`/(`result`\x).
  CategoryId raised(CategoryId category, const AtomicCategory& result);

private:
  void apply(const Category& function, const Category& argument, SlashDirection direction,
             std::vector<Combination>& found);

  CategoryTable& categories_;
  std::unordered_map<std::uint64_t, std::vector<Combination>> known_;
};

} // namespace castor::communication
