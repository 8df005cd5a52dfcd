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

Response Responder::to_assertion(const Nominal& said) {
  const auto* restriction = dependent(form_, said, "Cop-Restr");
  const auto* scope = dependent(form_, said, "Cop-Scope");
  auto truth = judge_assertion(said, form_, evaluation_);
  if (truth == Truth::unknown && is_told_in_vain(said))
    return {RhetoricalRelation::answer, {}, "I do not know whether that is so.", {}};
  if (truth != Truth::no)
    return accept();
  if (auto why = reason(said))
    return correct(with_marker("no", *std::move(why)));
  if (said.sort == "existence" || said.sort == "perception") {
    auto& subject = need(said, said.sort == "existence" ? "Subject" : "Patient");
    if (!is_negated(said) && subject.sort == "thing") {
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
  if (is_negated(said) || is_negated(*scope))
    return correct(with_marker("no", ascribe(pronoun("it"), part_of(form_, scope->name))));
  if (scope->sort == "conjunction")
    return correct(marker("no"));
  if (scope->sort == "region" || scope->sort == "comparison" || scope->sort == "selection")
    return correct(with_marker("no", ascribe(pronoun("it"), part_of(form_, scope->name), false)));
  return correct(denied(things.front(), *scope));
}

/// What vision has no word for, said of nothing that binding can be told of.
bool Responder::is_told_in_vain(const Nominal& said) const {
  if (said.sort != "conjunction")
    return says_what_is_not_seen(said) && telling_of(said, form_) == Telling::nothing;
  const auto& first = need(said, "First");
  const auto& next = need(said, "Next");
  if (said.proposition != "and")
    return says_what_is_not_seen(first) || says_what_is_not_seen(next);
  return is_told_in_vain(first) || is_told_in_vain(next);
}

/// A kind of thing that vision has no word for, such as a toy.
bool Responder::says_what_is_not_seen(const Nominal& said) const {
  const auto* kind = dependent(form_, said, said.sort == "existence" ? "Subject" : "Cop-Scope");
  return kind != nullptr && kind->sort == "thing" && !is_pronoun(*kind) &&
         !vocabulary().is_perceptible(kind->proposition);
}

std::optional<Response> Responder::to_preface() {
  const auto* preface = dependent(form_, root(), "Preface");
  // "Where, do you see a ball": what is asked by "where" is not clear.
  if (preface != nullptr && preface->sort == "ellipsis")
    throw Uninterpretable{Uninterpretable::Reason::word, preface->proposition};
  if (preface == nullptr || dependent(form_, *preface, "Wh-Restr") != nullptr ||
      feature(*preface, "Mood") == "int" || preface->sort == "marker")
    return std::nullopt;
  auto reply = to_assertion(*preface);
  if (reply.relation != RhetoricalRelation::correction)
    return std::nullopt;
  return reply;
}

} // namespace castor::communication
