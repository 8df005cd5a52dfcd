#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/responder.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

using binding::FeatureKind;

} // namespace

/// "What kind of thing" asks for a shape.
std::optional<FeatureKind> Responder::kind_asked_for(const Nominal& quality) const {
  return quality.proposition == "kind" ? std::optional{FeatureKind::shape}
                                       : vocabulary().kind_of_quality(quality.proposition);
}

/// "Which colours do you see?", "how many colours are there?"
Response Responder::values_seen(const Nominal& asked, const Nominal* region) {
  const auto kind = kind_asked_for(asked);
  for (auto& [mode, name] : asked.relations)
    if (const auto* x = find_nominal(form_, name); mode == "Location")
      region = x;
    else if (mode != "Quantity" && x != nullptr && x->proposition != "different")
      throw Uninterpretable{Uninterpretable::Reason::word, x->proposition};
  if (!kind)
    throw Uninterpretable{Uninterpretable::Reason::word, asked.proposition};
  // "Which colour is there most of?"
  if (const auto* subject = dependent(form_, root(), "Subject");
      root().sort == "existence" && subject != &asked)
    throw Uninterpretable{Uninterpretable::Reason::word,
                          subject == nullptr ? asked.proposition : subject->proposition};
  const auto* excepted = dependent(form_, root(), "Except");
  std::vector<std::string> values;
  for (auto& id : scene_.things()) {
    auto is_there = region == nullptr ? Truth::yes : evaluation_.is(id, *region);
    if (excepted != nullptr)
      is_there = both(is_there, negation(evaluation_.is(id, *excepted)));
    if (is_there == Truth::unknown)
      return answer(i_do_not_know());
    if (is_there == Truth::no)
      continue;
    auto words = scene_.words(id, *kind);
    if (words.empty() && asks_for_number(asked))
      return answer(i_do_not_know());
    if (!words.empty() && std::ranges::find(values, words.front()) == values.end())
      values.push_back(words.front());
  }
  if (asks_for_number(asked))
    return answer(exists(counted(values.size(), part_of(form_, asked.name))));
  if (values.empty())
    return answer(i_do_not_know());
  std::vector<LogicalForm> all;
  for (auto& word : values)
    all.push_back(kind == FeatureKind::shape ? indefinite(word)
                                             : property(asked.proposition, word));
  if (kind == FeatureKind::shape)
    return answer(exists(listed(std::move(all))));
  return answer(ascribe(pronoun(values.size() == 1 ? "it" : "they"), listed(std::move(all))));
}

/// "What is the most common colour?", "which colour is the rarest?": the quality, which is asked
/// for or what is asked about; null in other questions.
const Nominal* Responder::commonest_quality(const Nominal& asked) const {
  const auto* about = dependent(form_, root(), "Cop-Restr");
  const auto* scope = dependent(form_, root(), "Cop-Scope");
  if (root().sort != "ascription" || about == nullptr || scope == nullptr)
    return nullptr;
  const auto is_frequency = [](const Nominal* x) {
    return x != nullptr && (x->proposition == "commonest" || x->proposition == "rarest");
  };
  for (const auto* x : {&asked, about, scope})
    if (x->sort == "quality" &&
        (is_frequency(dependent(form_, *x, "Selection")) || (x == &asked && is_frequency(scope))))
      return x;
  return nullptr;
}

/// The value that most things have, or fewest; several if they are as common.
Response Responder::most_common(const Nominal& quality) {
  const auto kind = kind_asked_for(quality);
  const auto* selection = dependent(form_, quality, "Selection");
  const auto& frequency = selection == nullptr ? need(root(), "Cop-Scope") : *selection;
  const auto* owner = dependent(form_, quality, "Owner");
  const auto* region = dependent(form_, quality, "Location");
  if (!kind || is_negated(root()))
    throw Uninterpretable{Uninterpretable::Reason::word, quality.proposition};
  std::map<std::string, std::size_t> numbers;
  for (auto& id : scene_.things()) {
    auto counts = owner == nullptr ? Truth::yes : evaluation_.described(*owner).contains(id);
    if (region != nullptr)
      counts = both(counts, evaluation_.is(id, *region));
    const auto words = scene_.words(id, *kind);
    if (counts == Truth::unknown || (counts == Truth::yes && words.empty()))
      return answer(i_do_not_know());
    if (counts == Truth::yes)
      ++numbers[words.front()];
  }
  if (numbers.empty())
    return answer(i_do_not_know());
  const auto by_number = [](auto& a, auto& b) { return a.second < b.second; };
  const auto wanted = frequency.proposition == "rarest"
                        ? std::ranges::min_element(numbers, by_number)->second
                        : std::ranges::max_element(numbers, by_number)->second;
  std::vector<LogicalForm> values;
  for (auto& [word, number] : numbers)
    if (number == wanted)
      values.push_back(kind == FeatureKind::shape ? indefinite(word)
                                                  : property(quality.proposition, word));
  const auto* const it = values.size() == 1 ? "it" : "they";
  return answer(ascribe(pronoun(it), listed(std::move(values))));
}

} // namespace castor::communication
