#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scoped.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace castor::communication {

namespace {

/// Gaps to a wall that are no wider count as contact; metres.
constexpr double contact_with_wall = 0.0005;

/// So do such gaps between things, which do not fit as closely.
constexpr double contact = 0.0015;

/// Gaps that are no wider are nearly contact; metres.
constexpr double nearly_contact = 0.009;

/// The middle of a container reaches so far from its centre, as a share of its extent.
constexpr double middle_share = 0.25;

constexpr std::size_t horizontal = 0;
constexpr std::size_t vertical = 2;

/// How far a thing is from the sides of what it is in.
struct Gaps {
  double left, right, top, bottom;
};

Gaps gaps(const Body& thing, const Body& container) {
  return {thing.low(horizontal) - container.low(horizontal),
          container.high(horizontal) - thing.high(horizontal),
          container.high(vertical) - thing.high(vertical),
          thing.low(vertical) - container.low(vertical)};
}

/// Nearer to the line between the centres of the two than a third of their distance, and adjacent
/// to both where things are stacked.
bool lies_between(const Body& x, const Body& a, const Body& b) {
  const double dx = b.centre[horizontal] - a.centre[horizontal];
  const double dz = b.centre[vertical] - a.centre[vertical];
  const double px = x.centre[horizontal] - a.centre[horizontal];
  const double pz = x.centre[vertical] - a.centre[vertical];
  const double length = std::hypot(dx, dz);
  if (length == 0)
    return false;
  if (dx == 0 && px == 0)
    return std::abs(std::abs(pz) - a.extent[vertical]) <= contact &&
           std::abs(std::abs(dz - pz) - b.extent[vertical]) <= contact && pz * dz > 0 &&
           std::abs(pz) < std::abs(dz);
  const double along = (px * dx + pz * dz) / (length * length);
  return along > 0 && along < 1 && std::abs(px * dz - pz * dx) / length < length / 3;
}

} // namespace

/// "The edge", "a corner": no thing of its own.
bool Evaluation::is_side_of_container(const Nominal& phrase) {
  return is_side(phrase) && has_containers();
}

/// "The edge", "a corner", wherever it is.
bool Evaluation::is_side(const Nominal& phrase) const {
  return vocabulary().side(phrase.proposition) != nullptr;
}

bool Evaluation::is_corner(const Nominal& phrase) const {
  const auto* side = vocabulary().side(phrase.proposition);
  return side != nullptr && side->corner;
}

/// "The base of a tower": whichever is at the base of one.
bool Evaluation::is_end_of_some(const Nominal& phrase) {
  const auto* region = dependent(form_, phrase, "Location");
  const auto* whole = region == nullptr ? nullptr : dependent(form_, *region, "Anchor");
  return whole != nullptr && is_definite(phrase) && is_container_phrase(*whole) &&
         !is_definite(*whole) && (region->proposition == "base" || region->proposition == "top");
}

/// Places that only what is in containers has: at the top or the base of a tower, in contact with a
/// side of a box. Nothing for other places.
std::optional<Truth> Evaluation::is_in_container_part(const std::string& id,
                                                      const Nominal& region) {
  auto& place = region.proposition;
  const auto* anchor = dependent(form_, region, "Anchor");
  if (place == "touching" || place == "nearly-touching") {
    if (anchor == nullptr)
      not_understood(place);
    return touches(id, region, *anchor);
  }
  if (place == "at" && anchor != nullptr && anchor->sort == "conjunction")
    not_understood(place);
  if ((place == "near" || place == "next_to") && anchor != nullptr && is_side(*anchor))
    return touches_side(id, *anchor, nearly_contact);
  // "In a corner", "on the wall", "at the base".
  if ((place == "in" || place == "at" || place == "on") && anchor != nullptr && is_side(*anchor)) {
    const auto& end = anchor->proposition;
    const bool is_base = end == "base" || end == "bottom";
    if (!is_base && end != "top")
      return touches_side(id, *anchor, is_corner(*anchor) ? contact : contact_with_wall);
    auto result = Truth::no;
    for (auto& container : scene_.containers(id))
      result = either(result, is_at_end(id, container, !is_base));
    return result;
  }
  const bool is_top = place == "top" || (place == "on" && anchor != nullptr);
  if (!is_top && place != "base" && place != "centre" && place != "middle")
    return std::nullopt;
  auto at = [&](const std::string& container) {
    if (place == "centre" || place == "middle")
      return is_in_middle(id, container);
    return is_at_end(id, container, is_top);
  };
  if (anchor != nullptr) {
    if (!is_container_noun(anchor->proposition) && !bound_.contains(anchor->name) &&
        !is_pronoun(*anchor))
      return place == "top" ? std::optional{is_related(id, "on", *anchor)} : std::nullopt;
    if (place == "on" && !is_container_noun(anchor->proposition))
      return std::nullopt;
    return is_pronoun(*anchor) || bound_.contains(anchor->name) || is_in_each(*anchor)
             ? quantified(*anchor, at)
             : of_own_container(id, *anchor, at);
  }
  if (!within_.empty())
    return at(within_);
  if (place == "centre" && (scene_.containers(id).empty() || is_container(id)))
    return std::nullopt;
  auto result = Truth::no;
  for (auto& container : scene_.containers(id))
    result = either(result, at(container));
  return result;
}

Truth Evaluation::touches(const std::string& id, const Nominal& region, const Nominal& anchor) {
  if (anchor.sort == "conjunction") {
    // "Touching the wall and a ball" would be one place; that is never said.
    for (const auto* mode : {"First", "Next"})
      if (const auto& x = need(anchor, mode); !is_side(x))
        not_understood(x.proposition);
    auto first = touches(id, region, need(anchor, "First"));
    auto next = touches(id, region, need(anchor, "Next"));
    return anchor.proposition == "or" ? either(first, next) : both(first, next);
  }
  // "One of the sides".
  if (const auto* sides_of_it = dependent(form_, anchor, "PartOf");
      sides_of_it != nullptr && is_side_of_container(*sides_of_it)) {
    auto some = *sides_of_it;
    if (const auto* quantity = dependent(form_, anchor, "Quantity");
        quantity != nullptr && quantity->proposition != "one")
      some.relations.push_back({"Quantity", quantity->name});
    return touches(id, region, some);
  }
  const bool is_close = region.proposition == "touching";
  if (is_corner(anchor))
    return touches_side(id, anchor, is_close ? contact : nearly_contact);
  if (is_side(anchor))
    return touches_side(id, anchor, is_close ? contact_with_wall : nearly_contact);
  ScopedValue related{related_, id};
  return quantified(anchor, [&](const std::string& other) {
    return other == id ? Truth::no : touches_thing(id, other, is_close ? contact : nearly_contact);
  });
}

/// "The wall" is any of four.
Truth Evaluation::touches_side(const std::string& id, const Nominal& side, double slack) {
  for (auto& [mode, name] : side.relations)
    if (mode != "Owner" && mode != "Quantity")
      not_understood(side.proposition);
  const auto* quantity = dependent(form_, side, "Quantity");
  auto range = quantity == nullptr ? std::nullopt : number_range(*quantity);
  auto touches_one = [&](const std::string& container) {
    auto thing = scene_.body(id);
    auto whole = scene_.body(container);
    if (!thing || !whole)
      return Truth::unknown;
    const auto gap = gaps(*thing, *whole);
    const bool across = gap.left <= slack || gap.right <= slack;
    const bool along = gap.top <= slack || gap.bottom <= slack;
    const auto* which = vocabulary().side(side.proposition);
    if (which == nullptr || which->corner)
      return truth_of(across && along);
    const std::size_t number = (which->left && gap.left <= slack ? 1U : 0U) +
                               (which->right && gap.right <= slack ? 1U : 0U) +
                               (which->top && gap.top <= slack ? 1U : 0U) +
                               (which->bottom && gap.bottom <= slack ? 1U : 0U);
    return is_within({number, number}, range.value_or(NumberRange{1}));
  };
  if (const auto* owner = dependent(form_, side, "Owner"))
    return of_own_container(id, *owner, touches_one);
  // Towers have no walls.
  auto result = Truth::no;
  if (is_container(id))
    return result;
  for (auto& container : scene_.containers(id))
    if (scene_.containers(container).empty())
      result = either(result, touches_one(container));
  return result;
}

/// "The base of the tower", whichever it is in.
Truth Evaluation::of_own_container(const std::string& id, const Nominal& container,
                                   const Property& scope) {
  auto result = Truth::no;
  for (auto& whole : scene_.containers(id))
    result = either(result, both(fits(whole, container), scope(whole)));
  return result;
}

/// Between things in the same container, whichever fit: "between two black blocks".
Truth Evaluation::is_between_some(const std::string& id, const Nominal& anchor) {
  const bool is_pair = anchor.sort == "conjunction";
  auto& first = is_pair ? need(anchor, "First") : anchor;
  auto& next = is_pair ? need(anchor, "Next") : anchor;
  const auto* comparison = is_pair ? nullptr : collective_modifier(anchor);
  auto own = scene_.body(id);
  Things others;
  for (auto& container : scene_.containers(id))
    for (auto& other : items(container))
      if (other != id && std::ranges::find(others, other) == others.end())
        others.push_back(other);
  auto result = Truth::no;
  for (auto& a : others)
    for (auto& b : others) {
      auto x = scene_.body(a);
      auto y = scene_.body(b);
      if (a == b || !own || !x || !y)
        continue;
      auto fit = both(fits(a, first), fits(b, next));
      if (comparison != nullptr && comparison->sort == "comparison") {
        auto shared = shares(a, b, need(*comparison, "Quality").proposition);
        fit = both(fit, comparison->proposition == "same" ? shared : negation(shared));
      }
      result = either(result, both(fit, truth_of(lies_between(*own, *x, *y))));
    }
  return result;
}

Truth Evaluation::touches_thing(const std::string& a, const std::string& b, double slack) {
  auto x = scene_.body(a);
  auto y = scene_.body(b);
  if (!x || !y)
    return Truth::unknown;
  for (std::size_t axis = 0; axis < x->centre.size(); ++axis)
    if (x->low(axis) > y->high(axis) + slack || y->low(axis) > x->high(axis) + slack)
      return Truth::no;
  return Truth::yes;
}

/// The highest or the lowest of what is stacked; where nothing is stacked, what touches that side.
Truth Evaluation::is_at_end(const std::string& id, const std::string& container, bool top) {
  if (scene_.is_related(binding::containment_label, id, container) != Truth::yes)
    return Truth::no;
  auto own = scene_.body(id);
  if (!own)
    return Truth::unknown;
  auto others = items(container);
  const bool is_stack = scene_.knows_relation("on");
  if (!is_stack) {
    auto whole = scene_.body(container);
    if (!whole)
      return Truth::unknown;
    const auto gap = gaps(*own, *whole);
    return truth_of((top ? gap.top : gap.bottom) <= contact_with_wall);
  }
  for (auto& other : others) {
    auto body = scene_.body(other);
    if (!body)
      return Truth::unknown;
    const double above = body->centre[vertical] - own->centre[vertical];
    if (top ? above > contact : above < -contact)
      return Truth::no;
  }
  return Truth::yes;
}

Truth Evaluation::is_in_middle(const std::string& id, const std::string& container) {
  if (scene_.is_related(binding::containment_label, id, container) != Truth::yes)
    return Truth::no;
  if (scene_.knows_relation("on"))
    return both(negation(is_at_end(id, container, true)),
                negation(is_at_end(id, container, false)));
  auto own = scene_.body(id);
  auto whole = scene_.body(container);
  if (!own || !whole)
    return Truth::unknown;
  for (auto axis : {horizontal, vertical})
    if (std::abs(own->centre[axis] - whole->centre[axis]) > whole->extent[axis] * middle_share)
      return Truth::no;
  return Truth::yes;
}

/// Where things are to one another.
bool Evaluation::is_mutual(const Nominal& region) {
  auto& place = region.proposition;
  return region.sort == "region" &&
         (place == "stacked-together" || place == "touching-each-other" ||
          (place == "near-each-other" && has_containers()));
}

/// "Two blocks stacked together", "circles touching each other": each is so of another of them.
std::optional<Truth> Evaluation::is_with_the_others(const std::string& id, const Nominal& phrase,
                                                    const Nominal& region) {
  if (!is_mutual(region))
    return std::nullopt;
  auto& place = region.proposition;
  if (!is_plural(phrase) && phrase.sort != "conjunction")
    not_understood(place);
  const bool is_stacked =
    place == "stacked-together" || (place == "near-each-other" && scene_.knows_relation("on"));
  auto result = Truth::no;
  for (auto& other : scene_.things()) {
    if (other == id || is_container(other))
      continue;
    auto together =
      is_stacked ? either(scene_.is_related("on", id, other), scene_.is_related("on", other, id))
      : place == "near-each-other" ? scene_.is_related("near", id, other)
                                   : touches_thing(id, other, contact);
    if (together != Truth::no)
      result = either(result, both(together, fits_but_for(other, phrase, region)));
  }
  return result;
}

} // namespace castor::communication
