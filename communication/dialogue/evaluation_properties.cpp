#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scoped.hpp"
#include "castor/communication/dialogue/stacks.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace castor::communication {

namespace {

using binding::FeatureKind;

/// The middle of the table reaches so far towards its outermost things.
constexpr double table_middle_share = 0.25;

/// What is no farther from the middle of the table is in it; metres.
constexpr double least_middle = 0.02;

/// Things are far from each other from this share of the greatest distance on the table, and from
/// this distance in metres.
constexpr double far_share = 0.5;
constexpr double least_far_distance = 0.2;

/// "Directly-back" is said of what is behind with nothing between.
constexpr std::string_view directly = "directly-";

} // namespace

Truth Evaluation::is(const std::string& id, const Nominal& scope, const Nominal* among) {
  check_coordination(scope);
  Truth result;
  if (scope.sort == "conjunction")
    result = conjoined(id, scope, among);
  else if (scope.sort == "region")
    result = is_in(id, scope);
  else if (scope.sort == "comparison")
    result = compares(id, scope);
  else if (scope.sort == "selection") {
    auto things = among == nullptr ? Fitting{scene_.things(), scene_.things()} : described(*among);
    result = is_selected(id, scope, things, among == nullptr ? 1 : number_of_selected(*among));
  } else if (scope.sort == "composition")
    result = has_property(id, need(scope, "Material"));
  else if (scope.sort == "possession")
    result = has(id, need(scope, "Thing"));
  else if (scope.sort == "thing" || scope.sort == "entity") {
    result = is_end_of_some(scope) ? fits(id, scope) : is_one_of(id, scope);
    if (feature(scope, "Delimitation") == "none")
      result = negation(result);
  } else
    result = has_property(id, scope);
  return is_negated(scope) ? denial(id, scope, result, among) : result;
}

/// What others are compared with: the ball in "left of the ball". Nothing is said of it itself.
Evaluation::Things Evaluation::landmarks_of(const Nominal& scope) {
  Things result;
  auto add = [&](const Things& more) { result.insert(result.end(), more.begin(), more.end()); };
  if (scope.sort == "conjunction")
    for (const auto* mode : {"First", "Next"})
      add(landmarks_of(need(scope, mode)));
  else if (scope.sort == "region" || scope.sort == "comparison")
    for (const auto* mode : {"Anchor", "Than"})
      if (const auto* anchor = dependent(form_, scope, mode);
          anchor != nullptr && anchor->sort == "thing" && is_definite(*anchor) &&
          !is_plural(*anchor) && !is_about_others(form_, *anchor) &&
          vocabulary().surroundings(*anchor) == nullptr && !is_side_of_container(*anchor) &&
          !is_stack(*anchor))
        add(meant(*anchor));
  return result;
}

/// Whether it is not so. Of "the ball" it may be said that it is not left of itself.
Truth Evaluation::denial(const std::string& id, const Nominal& scope, Truth truth,
                         const Nominal* among) {
  // What is not as large as another is smaller.
  if (scope.proposition == "as-large" || scope.proposition == "as-small") {
    auto opposite = scope;
    opposite.proposition = scope.proposition == "as-large" ? "smaller" : "larger";
    return compares(id, opposite);
  }
  if (among != nullptr && is_definite(*among) && !is_plural(*among))
    return negation(truth);
  auto landmarks = landmarks_of(scope);
  const bool is_landmark = std::ranges::find(landmarks, id) != landmarks.end();
  return is_landmark ? Truth::no : negation(truth);
}

Truth Evaluation::conjoined(const std::string& id, const Nominal& conjunction,
                            const Nominal* among) {
  auto& first = need(conjunction, "First");
  auto& next = need(conjunction, "Next");
  auto a = is(id, first, among);
  auto b = is(id, next, among);
  if (conjunction.proposition == "nor")
    return both(denial(id, first, a, among), denial(id, next, b, among));
  if (conjunction.proposition == "or")
    return either(a, b);
  // "Red and blue things" are some of each.
  const bool exclude_each_other =
    first.sort == next.sort && vocabulary().kind_of_quality(first.sort);
  const bool is_attribute_of_several = among != nullptr && is_plural(*among);
  return exclude_each_other && is_attribute_of_several ? either(a, b) : both(a, b);
}

Truth Evaluation::has_property(const std::string& id, const Nominal& property) {
  auto kind = vocabulary().kind_of_quality(property.sort);
  if (const auto* look = vocabulary().look(property.proposition))
    return looks(id, *look);
  const auto value = vocabulary().value_of(property.sort, property.proposition);
  if (!kind || !value)
    not_understood(property.proposition);
  // A tower of blocks is as all of them are.
  if (is_container(id) && scene_.words(id, *kind).empty()) {
    auto result = Truth::yes;
    for (auto& part : items(id))
      result = both(result, has_property(part, property));
    return result;
  }
  return kind == FeatureKind::shape ? has_shape(id, *value)
                                    : scene_.has(id, binding::feature(*kind, *value));
}

/// Round like a ball or a disc; flat like a disc or a square.
Truth Evaluation::looks(const std::string& id, const WordMeanings::Look& look) {
  const auto kind = vocabulary().kind_of_quality(look.quality);
  const auto words = kind ? scene_.words(id, *kind) : std::vector<std::string>{};
  if (words.empty() || look.unknown.contains(words.front()))
    return Truth::unknown;
  return truth_of(look.values.contains(words.front()));
}

// -- space

Truth Evaluation::is_in(const std::string& id, const Nominal& region) {
  auto& relation = region.proposition;
  const auto* anchor = dependent(form_, region, "Anchor");
  // "At the right edge": on that side.
  if (relation == "at" && anchor != nullptr && anchor->proposition.ends_with("-edge") &&
      anchor->relations.empty() && !has_containers())
    return is_in_part_of_table(id, anchor->proposition);
  // Nobody has said where the corners and the sides of the table are.
  if (anchor != nullptr && anchor->sort == "place" && !has_containers())
    not_understood(anchor->proposition);
  if (relation == "in" && anchor != nullptr && is_stack(*anchor)) {
    const auto stack = only_stack(scene_);
    return truth_of(std::ranges::find(stack, id) != stack.end());
  }
  const bool is_top = relation == "top" || relation == "on-top";
  if ((is_top || relation == "base") && anchor == nullptr && !has_containers() &&
      scene_.knows_relation("on"))
    return is_end_of_stack(id, is_top);
  if (auto result = is_in_container_part(id, region))
    return *result;
  if (anchor != nullptr)
    check_place_of_other_kind(relation, *anchor);
  if (is_pointed_at(region)) {
    const auto there = antecedents_of(region.name + std::string{pointed_at});
    return truth_of(std::ranges::find(there, id) != there.end());
  }
  if (anchor == nullptr && relation == "here")
    if (const auto around = surroundings_of_addressee(); !around.empty())
      return truth_of(std::ranges::any_of(around, [&](auto& place) {
        return scene_.is_related(binding::containment_label, id, place) == Truth::yes;
      }));
  if (anchor == nullptr)
    return is_in_part_of_table(id, relation);
  if (relation == "between")
    return has_containers() ? is_between_some(id, *anchor) : is_between(id, *anchor);
  if (relation == "among")
    return is_one_of(id, *anchor);
  // The table is where everything is.
  if (const auto* everywhere = vocabulary().surroundings(*anchor)) {
    if (!everywhere->is_said_by(relation))
      not_understood(relation);
    // There is one table; what is said of it is meant of something else.
    if (!anchor->relations.empty())
      not_understood(find_nominal(form_, anchor->relations.front().dependent)->proposition);
    return Truth::yes;
  }
  // What the other stands on.
  if (relation == "under" && !has_containers())
    return quantified(*anchor, [&](const std::string& other) {
      return other == id ? Truth::no : scene_.is_related("on", other, id);
    });
  if (relation == "far")
    return quantified(*anchor, [&](const std::string& other) { return is_far(id, other); });
  if (relation.starts_with(directly))
    return quantified(*anchor, [&, side = relation.substr(directly.size())](auto& other) {
      return is_directly(id, side, other);
    });
  return is_related(id, vocabulary().relation_of(relation).value_or(relation), *anchor);
}

/// "Which one is on top?": it stands on something, and nothing stands on it. "What is at the
/// bottom?": something stands on it, and it stands on nothing.
Truth Evaluation::is_end_of_stack(const std::string& id, bool is_top) {
  auto is_on_something = Truth::no;
  auto is_under_something = Truth::no;
  for (const auto& other : scene_.things()) {
    if (other == id)
      continue;
    is_on_something = either(is_on_something, scene_.is_related("on", id, other));
    is_under_something = either(is_under_something, scene_.is_related("on", other, id));
  }
  return is_top ? both(is_on_something, negation(is_under_something))
                : both(is_under_something, negation(is_on_something));
}

/// Where rooms are to each other is known only as far as somebody tells it: that they adjoin, but
/// not which is to the left of another.
void Evaluation::check_place_of_other_kind(const std::string& relation, const Nominal& anchor) {
  const auto& one = anchor.sort == "conjunction" ? need(anchor, "First") : anchor;
  const auto label = vocabulary().relation_of(relation).value_or(relation);
  if (one.sort == "thing" && vocabulary().is_of_other_kind(one.proposition) &&
      label != binding::containment_label && !scene_.knows_relation(label) &&
      !scene_.individuals().empty() && scene_.open_questions().empty())
    throw Uninterpretable{Uninterpretable::Reason::unknown, one.name};
}

/// The room that the robot is in: "here".
Evaluation::Things Evaluation::surroundings_of_addressee() {
  Things result;
  for (auto& self : scene_.addressee())
    for (auto& place : scene_.surroundings(self))
      result.push_back(place);
  return result;
}

/// Behind it or beside it, with nothing between the two on that side. Of what lies rather beside it
/// than behind it, nobody can say.
Truth Evaluation::is_directly(const std::string& id, const std::string& side,
                              const std::string& other) {
  const auto on_that_side = scene_.is_related(side, id, other);
  if (on_that_side != Truth::yes)
    return on_that_side;
  for (auto& third : scene_.things())
    if (scene_.is_related(side, id, third) == Truth::yes &&
        scene_.is_related(side, third, other) == Truth::yes)
      return Truth::no;
  auto a = scene_.place_in_view(id);
  auto b = scene_.place_in_view(other);
  if (!a || !b)
    return Truth::unknown;
  const bool is_across = std::abs(a->x - b->x) >= std::abs(a->y - b->y);
  return is_across == (side == "left" || side == "right") ? Truth::yes : Truth::unknown;
}

/// What is neither near nor half as far as the two things that are farthest from each other may be
/// called far or not.
Truth Evaluation::is_far(const std::string& id, const std::string& other) {
  if (id == other || scene_.is_related("near", id, other) == Truth::yes)
    return Truth::no;
  auto distance = [&](const std::string& a, const std::string& b) {
    auto x = scene_.place(a);
    auto y = scene_.place(b);
    return x && y ? std::hypot(x->x - y->x, x->y - y->y) : 0;
  };
  double widest = 0;
  for (auto& a : scene_.things())
    for (auto& b : scene_.things())
      widest = std::max(widest, distance(a, b));
  const bool is_clear = distance(id, other) >= std::max(widest * far_share, least_far_distance);
  return is_clear ? Truth::yes : Truth::unknown;
}

/// On the left, in the middle...: by where it lies among all things, around the middle of the
/// table, which is the origin.
Truth Evaluation::is_in_part_of_table(const std::string& id, const std::string& part) {
  // Nobody has said where the table ends.
  if (part == "edge")
    return Truth::unknown;
  // "Here" is anywhere on the table, and so is "over there" if no place was spoken of.
  if (part == "here" || part == "there" || part == "on")
    return Truth::yes;
  // "Back-right-corner", "at the left edge": on each of the sides that it names.
  if (const auto end = part.find('-'); end != std::string::npos) {
    const auto rest = part.substr(end + 1);
    if (rest == "corner" || rest == "edge")
      return is_in_part_of_table(id, part.substr(0, end));
    return both(is_in_part_of_table(id, part.substr(0, end)), is_in_part_of_table(id, rest));
  }
  if (part != "left" && part != "right" && part != "front" && part != "back" && part != "centre")
    not_understood(part);
  double width = 0;
  double depth = 0;
  for (auto& other : scene_.things())
    if (auto at = scene_.place_in_view(other)) {
      width = std::max(width, std::abs(at->x));
      depth = std::max(depth, std::abs(at->y));
    }
  auto at = scene_.place_in_view(id);
  if (!at)
    return Truth::unknown;
  const double beside = std::max(width * table_middle_share, least_middle);
  const double beyond = std::max(depth * table_middle_share, least_middle);
  if (part == "left")
    return truth_of(at->x < -beside);
  if (part == "right")
    return truth_of(at->x > beside);
  if (part == "front")
    return truth_of(at->y < -beyond);
  if (part == "back")
    return truth_of(at->y > beyond);
  return truth_of(std::abs(at->x) <= beside && std::abs(at->y) <= beyond);
}

std::vector<std::string> Evaluation::sides_of(const std::string& id) {
  std::vector<std::string> result;
  if (scene_.place_in_view(id))
    for (const auto* side : {"left", "right", "front", "back", "centre"})
      if (is_in_part_of_table(id, side) == Truth::yes)
        result.emplace_back(side);
  return result;
}

Truth Evaluation::is_related(const std::string& id, const std::string& relation,
                             const Nominal& anchor) {
  // Whether something is in its hand, the robot knows.
  const bool is_own = feature(anchor, "Whose") == "yours";
  if (!vocabulary().is_spatial_relation(relation) && !scene_.knows_relation(relation) &&
      !has_containers() && !is_own)
    not_understood(relation);
  ScopedValue related{related_, id};
  return quantified(anchor, [&](const std::string& other) {
    if (other == id)
      return Truth::no;
    const auto truth = scene_.is_related(relation, id, other);
    return truth == Truth::no && has_wide_sides_ ? truth_of(scene_.is_toward(relation, id, other))
                                                 : truth;
  });
}

/// Nearer to the line between the two than a third of their distance, and not beyond either.
Truth Evaluation::is_between(const std::string& id, const Nominal& anchor) {
  Things ends;
  if (anchor.sort == "conjunction") {
    for (const auto* mode : {"First", "Next"})
      for (auto& end : meant(need(anchor, mode)))
        ends.push_back(end);
  } else
    ends = meant(anchor);
  if (!scene_.open_questions().empty())
    return Truth::unknown;
  if (ends.size() != 2)
    not_understood("between");
  if (id == ends[0] || id == ends[1])
    return Truth::no;
  auto a = scene_.place(ends[0]);
  auto b = scene_.place(ends[1]);
  auto x = scene_.place(id);
  if (!a || !b || !x)
    return Truth::unknown;
  const double dx = b->x - a->x;
  const double dy = b->y - a->y;
  const double length = std::hypot(dx, dy);
  if (length == 0)
    return Truth::no;
  const double along = ((x->x - a->x) * dx + (x->y - a->y) * dy) / (length * length);
  const double aside = std::abs((x->x - a->x) * dy - (x->y - a->y) * dx) / length;
  return truth_of(along > 0 && along < 1 && aside < length / 3);
}

} // namespace castor::communication
