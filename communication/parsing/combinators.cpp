#include "castor/communication/parsing/combinators.hpp"

#include <algorithm>

namespace castor::communication {

namespace {

/// Larger than any variable's number.
constexpr FeatureValue apart = 1000;

Combinator composition(SlashDirection function, SlashDirection argument) {
  if (function == SlashDirection::forward)
    return argument == function ? Combinator::forward_composition
                                : Combinator::forward_crossed_composition;
  return argument == function ? Combinator::backward_composition
                              : Combinator::backward_crossed_composition;
}

} // namespace

bool is_forward(Combinator combinator) {
  return combinator == Combinator::forward_application ||
         combinator == Combinator::forward_composition ||
         combinator == Combinator::forward_crossed_composition;
}

bool is_composition(Combinator combinator) {
  return combinator >= Combinator::forward_composition;
}

void Combinators::add_outlines() {
  while (outlines_.size() < categories_.size()) {
    const auto& category = categories_[static_cast<CategoryId>(outlines_.size())];
    auto& outline = outlines_.emplace_back();
    outline.result = category.result;
    outline.arguments = static_cast<std::uint32_t>(category.arguments.size());
    if (category.arguments.empty())
      continue;
    const auto& outermost = category.arguments.back();
    outline.direction = outermost.direction;
    outline.wanted_arguments = static_cast<std::uint32_t>(outermost.category.arguments.size());
    outline.wanted = outermost.category.result;
  }
}

const std::vector<Combination>& Combinators::found_or_made(CategoryId left, CategoryId right) {
  const auto key = std::uint64_t{left} << 32 | right;
  if (const auto known = known_.find(key); known != known_.end())
    return known->second;
  std::vector<Combination> found;
  apply(categories_[left], categories_[right], SlashDirection::forward, found);
  apply(categories_[right], categories_[left], SlashDirection::backward, found);
  return known_.emplace(key, std::move(found)).first->second;
}

void Combinators::apply(const Category& function, const Category& argument,
                        SlashDirection direction, std::vector<Combination>& found) {
  if (function.arguments.empty() || function.arguments.back().direction != direction)
    return;
  const auto& wanted = function.arguments.back();
  const auto result = without_last_argument(function);
  const auto fresh = with_variables_apart(argument, apart);
  const auto most = std::min(max_composition_degree, fresh.arguments.size());
  for (std::size_t degree = 0; degree <= most; ++degree) {
    auto combinator = direction == SlashDirection::forward ? Combinator::forward_application
                                                           : Combinator::backward_application;
    if (degree > 0) {
      const auto& innermost = fresh.arguments[fresh.arguments.size() - degree];
      combinator = composition(direction, innermost.direction);
      const auto needed =
        innermost.direction == direction ? SlashMode::composition : SlashMode::crossed;
      if (wanted.mode < needed || innermost.mode < needed)
        continue;
    }
    FeatureSubstitution substitution;
    if (!substitution.unify(wanted.category, without_last_argument(fresh, degree)))
      continue;
    auto combined = result;
    combined.arguments.insert(combined.arguments.end(),
                              fresh.arguments.end() - static_cast<std::ptrdiff_t>(degree),
                              fresh.arguments.end());
    const bool modifies = degree == 0 && wanted.mode != SlashMode::application &&
                          wanted.category.arguments.empty() && result == wanted.category;
    found.push_back({combinator, categories_.intern(substitution.apply(combined)),
                     static_cast<std::uint16_t>(result.atoms()), modifies});
  }
}

CategoryId Combinators::raised(CategoryId category, const AtomicCategory& result) {
  const Category raised_result{result, {}};
  Category predicate = raised_result;
  predicate.arguments.push_back(
    {SlashDirection::backward, SlashMode::composition, categories_[category]});
  Category raised = raised_result;
  raised.arguments.push_back({SlashDirection::forward, SlashMode::composition, predicate});
  return categories_.intern(raised);
}

} // namespace castor::communication
