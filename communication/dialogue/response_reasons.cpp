#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/responder.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace castor::communication {

namespace {

using binding::FeatureKind;

constexpr std::array ranks{"first", "second", "third"};

/// Its number apart.
LogicalForm uncounted(const LogicalForm& form, const Nominal& phrase) {
  auto all = part_of(form, phrase.name);
  for (auto& x : all.nominals)
    if (x.name == phrase.name) {
      std::erase_if(x.relations, [](auto& y) { return y.mode == "Quantity"; });
      std::erase_if(x.features, [](auto& y) { return y.name == "Focus"; });
    }
  return all;
}

} // namespace

/// What contradicts an ascription: "the second box has two items", "one ball is not red", "one of
/// the towers has a blue base". Nothing if there are no few words for it.
std::optional<LogicalForm> Responder::reason(const Nominal& said) {
  const auto* subject = dependent(form_, said, "Cop-Restr");
  const auto* scope = dependent(form_, said, "Cop-Scope");
  if (said.sort != "ascription" || is_negated(said) || subject == nullptr || scope == nullptr ||
      subject->sort != "thing" || is_pronoun(*subject) || !feature(*subject, "Focus").empty() ||
      is_negated(*subject))
    return std::nullopt;
  const auto* quantity = dependent(form_, *subject, "Quantity");
  const bool is_universal = feature(*subject, "Delimitation") == "all" && quantity == nullptr;
  const bool is_single = is_definite(*subject) && !is_plural(*subject);
  if (is_universal || (is_single && evaluation_.is_container_phrase(*subject)))
    return exception(said, *subject, *scope);
  // "Two of the boxes have a circle": so many do.
  if (quantity == nullptr || !number_range(*quantity) || is_definite(*subject) ||
      !evaluation_.is_container_phrase(*subject) || scope->sort == "comparison")
    return std::nullopt;
  std::size_t number = 0;
  const auto candidates = evaluation_.described(*subject);
  for (auto& id : candidates.best())
    number += evaluation_.is_so_of(said, id) == Truth::yes ? 1 : 0;
  const auto they = counted(number, part_of(form_, subject->name));
  const auto so = part_of(form_, scope->name);
  return said.proposition == "have" ? possess(they, so) : ascribe(they, so);
}

/// The first container of which it is not so, and what it has instead; of other things how many
/// are not so.
std::optional<LogicalForm> Responder::exception(const Nominal& said, const Nominal& subject,
                                                const Nominal& scope) {
  if (scope.sort == "comparison")
    return std::nullopt;
  Things against;
  const auto candidates = evaluation_.described(subject);
  for (auto& id : candidates.best())
    if (evaluation_.is_so_of(said, id) == Truth::no)
      against.push_back(id);
  if (against.empty())
    return std::nullopt;
  if (!evaluation_.is_container_phrase(subject))
    return ascribe(counted(against.size(), part_of(form_, subject.name)),
                   part_of(form_, scope.name), false);
  std::ranges::sort(against, {}, [this](auto& id) {
    const auto place = scene_.place(id);
    return place ? place->x : 0;
  });
  const auto& first = against.front();
  const auto* group = dependent(form_, subject, "PartOf");
  const auto owner = by_position(first, (group == nullptr ? subject : *group).proposition);
  if (!owner || said.proposition != "have")
    return std::nullopt;
  return what_it_has(first, *owner, scope);
}

/// "The second box has two items", "... has no circle", "... has a blue circle" where it should
/// have nothing but others.
std::optional<LogicalForm> Responder::what_it_has(const std::string& id, const LogicalForm& owner,
                                                  const Nominal& what) {
  if (what.sort != "thing")
    return std::nullopt;
  const auto alone = uncounted(form_, what);
  const auto delimited = feature(what, "Delimitation");
  if (feature(what, "Focus") == "only" || delimited == "all") {
    for (auto& item : scene_.contents(id)) {
      if (!scene_.contents(item).empty() || evaluation_.is(item, what) == Truth::yes)
        continue;
      const auto colours = scene_.words(item, FeatureKind::colour);
      const auto shapes = scene_.words(item, FeatureKind::shape);
      if (colours.empty() || shapes.empty())
        return std::nullopt;
      const auto names = scene_.words(item, FeatureKind::concept_name);
      // What is called a block looks like a square on a picture.
      const bool has_own_name = !names.empty() && !vocabulary().definition(names.front()).empty();
      return possess(owner, with(indefinite(has_own_name ? names.front() : shapes.front()),
                                 "Colour", property("colour", colours.front())));
    }
    return std::nullopt;
  }
  const auto number = evaluation_.number_inside(id, what);
  return possess(owner, number.certain == 0 ? none_of(alone) : counted(number, alone));
}

/// "The second box": of all that are called so, from the left.
std::optional<LogicalForm> Responder::by_position(const std::string& id, const std::string& noun) {
  struct Placed {
    double x;
    std::string id;
  };
  std::vector<Placed> row;
  for (auto& other : scene_.things())
    if (scene_.has(other, binding::feature(FeatureKind::concept_name,
                                           vocabulary().concept_of(noun))) == Truth::yes)
      if (const auto place = scene_.place(other))
        row.push_back({place->x, other});
  std::ranges::sort(row, {}, &Placed::x);
  const auto found = std::ranges::find(row, id, &Placed::id);
  const auto rank = static_cast<std::size_t>(found - row.begin());
  if (found == row.end() || rank >= ranks.size())
    return std::nullopt;
  if (row.size() == 1)
    return definite(noun);
  auto leftmost = property("selection", "leftmost");
  if (rank > 0)
    leftmost = with(std::move(leftmost), "Rank", property("number", ranks[rank]));
  return with(definite(noun), "Selection", leftmost);
}

} // namespace castor::communication
