#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scoped.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

/// Of which things a question is true.
namespace castor::communication {

Fitting Evaluation::answers(const Nominal& e, const Nominal& asked) {
  auto result = strict_answers(e, asked);
  if (result.possible.empty())
    result = outermost_answer(e, asked);
  // "What is behind the cube?", where nothing is straight behind it.
  if (result.possible.empty() && may_have_wide_sides()) {
    ScopedValue wide{has_wide_sides_, true};
    result = strict_answers(e, asked);
  }
  return result;
}

/// It is about one side of one thing, and counts nothing; and somebody tells what is on which side.
bool Evaluation::may_have_wide_sides() {
  const auto is_told = [&](const char* side) { return scene_.knows_relation(side); };
  if (std::ranges::none_of(std::array{"left", "right", "front", "back"}, is_told))
    return false;
  std::size_t sides = 0;
  for (const auto& x : form_.nominals) {
    const auto* anchor = x.sort == "region" ? dependent(form_, x, "Anchor") : nullptr;
    if (x.sort == "region" && (anchor == nullptr || !is_definite(*anchor) || is_plural(*anchor)))
      return false;
    sides += x.sort == "region" ? 1 : 0;
    if (dependent(form_, x, "Quantity") != nullptr || is_negated(x) ||
        is_among(feature(x, "Delimitation"),
                 {"all", "most", "half", "both", "none", "neither", "only"}))
      return false;
  }
  return sides == 1 && !has_containers();
}

Fitting Evaluation::strict_answers(const Nominal& e, const Nominal& asked) {
  Fitting result;
  auto candidates = described(asked);
  const auto* topic = dependent(form_, e, "Topic");
  const auto* excepted = dependent(form_, e, "Except");
  for (auto& id : candidates.possible) {
    auto truth = candidates.contains(id);
    if (topic != nullptr && asked.proposition == "one")
      truth = both(truth, is_one_of(id, *topic));
    if (excepted != nullptr)
      truth = both(truth, negation(is_one_of(id, *excepted)));
    ScopedBinding binding{bound_, asked.name};
    binding.set(id);
    truth = both(truth, clause(e));
    result.add(id, truth);
  }
  return result;
}

Truth Evaluation::clause_with_wide_sides(const Nominal& e) {
  ScopedValue wide{has_wide_sides_, may_have_wide_sides()};
  return clause(e);
}

/// "Which of them is on the left?", where none is: the leftmost of them.
Fitting Evaluation::outermost_answer(const Nominal& e, const Nominal& asked) {
  const auto* whole = dependent(form_, asked, "PartOf");
  const auto* side = dependent(form_, e, "Cop-Scope");
  if (whole == nullptr || side == nullptr || side->sort != "region" || is_negated(e) ||
      is_negated(*side) || has_containers() || dependent(form_, *side, "Anchor") != nullptr)
    return {};
  const auto one = outermost(meant(*whole), side->proposition);
  return one ? Fitting{{*one}, {*one}} : Fitting{};
}

Fitting Evaluation::subjects(const Nominal& e, const Nominal& subject) {
  Fitting result;
  for (auto& id : scene_.things()) {
    ScopedBinding binding{bound_, subject.name};
    binding.set(id);
    result.add(id, clause(e));
  }
  return result;
}

} // namespace castor::communication
