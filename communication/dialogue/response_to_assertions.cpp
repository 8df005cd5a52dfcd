#include "castor/communication/dialogue/assertion.hpp"
#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/responder.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <utility>

namespace castor::communication {

namespace {

Response accept() {
  return {RhetoricalRelation::acceptance, {{marker("ok")}}, {}, {}};
}

Response correct(LogicalForm content, LogicalForm simpler = marker("no")) {
  return {RhetoricalRelation::correction, {{std::move(content), std::move(simpler)}}, {}, {}};
}

} // namespace

Response Responder::to_assertion() {
  const auto* restriction = dependent(form_, root(), "Cop-Restr");
  const auto* scope = dependent(form_, root(), "Cop-Scope");
  auto truth = judge_assertion(root(), form_, evaluation_);
  if (truth != Truth::no)
    return accept();
  if (auto why = reason())
    return correct(with_marker("no", *std::move(why)));
  if (root().sort == "existence" || root().sort == "perception") {
    auto& subject = need(root(), root().sort == "existence" ? "Subject" : "Patient");
    if (!is_negated(root()) && subject.sort == "thing") {
      auto found = evaluation_.described(subject);
      if (found.possible.empty())
        return correct(nothing_like(subject));
      if (found.certain.empty())
        return correct(marker("no"));
      return correct(
        with_marker("no", exists(counted(found.count(), part_of(form_, subject.name)))));
    }
    return correct(marker("no"));
  }
  if (restriction == nullptr || scope == nullptr || restriction->sort != "thing" ||
      !is_definite(*restriction) || is_plural(*restriction) ||
      !feature(*restriction, "Focus").empty())
    return correct(marker("no"));
  Things things;
  try {
    things = evaluation_.meant(*restriction);
  } catch (const Uninterpretable&) {
    // It is so of none of those that may be meant.
  }
  if (things.size() != 1)
    return correct(marker("no"));
  if (is_negated(root()) || is_negated(*scope))
    return correct(with_marker("no", ascribe(pronoun("it"), part_of(form_, scope->name))));
  if (scope->sort == "region" || scope->sort == "comparison" || scope->sort == "selection")
    return correct(with_marker("no", ascribe(pronoun("it"), part_of(form_, scope->name), false)));
  return correct(with_marker("no", as_it_is(things.front(), pronoun("it"), *scope)));
}

} // namespace castor::communication
