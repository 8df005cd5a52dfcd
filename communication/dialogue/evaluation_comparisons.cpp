#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scoped.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/numerals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

/// What is larger, nearer, the first from the left, the same.
namespace castor::communication {

namespace {

using binding::FeatureKind;

/// Of two sizes, the larger one is larger by so much at least; else they are about the same.
constexpr double clear_ratio = 1.05;

/// Who calls two things as large allows for more.
constexpr double same_ratio = 1.1;

/// How exactly a thing is measured by who says "5 cm wide"; metres.
constexpr double exactness = 0.003;

/// Distances and coordinates that differ by less are about the same; metres.
constexpr double clear_distance = 0.02;

/// A property that things are compared by: its measure, and whether more of it is meant.
struct Comparative {
  const char* word;
  const char* dimension;
  bool more;
};

constexpr std::array comparatives{
  Comparative{"larger", "size", true},         Comparative{"smaller", "size", false},
  Comparative{"greater", "size", true},        Comparative{"largest", "size", true},
  Comparative{"smallest", "size", false},      Comparative{"taller", "height", true},
  Comparative{"lower", "height", false},       Comparative{"tallest", "height", true},
  Comparative{"lowest", "height", false},      Comparative{"leftmost", "right", false},
  Comparative{"rightmost", "right", true},     Comparative{"frontmost", "back", false},
  Comparative{"backmost", "back", true},       Comparative{"nearest", "distance", false},
  Comparative{"farthest", "distance", true},   Comparative{"nearer", "distance", false},
  Comparative{"wider", "width", true},         Comparative{"narrower", "width", false},
  Comparative{"widest", "width", true},        Comparative{"narrowest", "width", false},
  Comparative{"farther", "distance", true},    Comparative{"further-left", "right", false},
  Comparative{"further-right", "right", true}, Comparative{"further-back", "back", true},
  Comparative{"further-front", "back", false}, Comparative{"centremost", "centre", false}};

const Comparative* comparative(const std::string& word) {
  auto found = std::ranges::find_if(comparatives, [&word](auto& x) { return x.word == word; });
  return found == comparatives.end() ? nullptr : &*found;
}

bool is_length(const std::string& dimension) {
  return dimension == "size" || dimension == "height" || dimension == "width";
}

/// Whether `a` is clearly more than `b`.
bool is_clearly_more(double a, double b, const std::string& dimension) {
  return is_length(dimension) ? a > b * clear_ratio : a > b + clear_distance;
}

} // namespace

std::optional<double> Evaluation::measure(const std::string& id, const std::string& dimension,
                                          const Nominal* anchor) {
  if (dimension == "size")
    return scene_.extent(id);
  if (dimension == "height")
    return scene_.height(id);
  if (dimension == "width")
    return scene_.width(id);
  auto at = scene_.place_in_view(id);
  if (!at)
    return std::nullopt;
  if (dimension == "right")
    return at->x;
  if (dimension == "centre")
    return std::hypot(at->x, at->y);
  if (dimension == "back" || anchor == nullptr)
    return at->y;
  auto to = meant(*anchor);
  auto there = to.size() == 1 ? scene_.place_in_view(to.front()) : std::nullopt;
  return there ? std::optional{std::hypot(at->x - there->x, at->y - there->y)} : std::nullopt;
}

/// "The three largest balls" are three.
std::size_t Evaluation::number_of_selected(const Nominal& phrase) const {
  if (feature(phrase, "Delimitation") == "both")
    return 2;
  const auto* quantity = is_plural(phrase) ? dependent(form_, phrase, "Quantity") : nullptr;
  const auto range = quantity == nullptr ? std::nullopt : number_range(*quantity);
  return range ? std::max<std::size_t>(range->least, 1) : 1;
}

/// "The largest", "the second from the left", "closest to the ball".
/// \param number how many are selected together
Truth Evaluation::is_selected(const std::string& id, const Nominal& selection, const Fitting& among,
                              std::size_t number) {
  const auto* how = comparative(selection.proposition);
  if (how == nullptr)
    not_understood(selection.proposition);
  const auto* anchor = dependent(form_, selection, "Anchor");
  Things others = among.possible;
  if (anchor != nullptr && std::string_view{how->dimension} == "distance")
    for (auto& x : meant(*anchor))
      std::erase(others, x);
  if (std::ranges::find(others, id) == others.end())
    return scene_.open_questions().empty() ? Truth::no : Truth::unknown;
  // How large rooms are nobody tells.
  if (!scene_.is_thing(id) && !is_container(id) && others.size() > 1 &&
      scene_.open_questions().empty() && !measure(id, how->dimension, anchor))
    throw Uninterpretable{Uninterpretable::Reason::unknown, selection.name};
  std::size_t rank = 1;
  if (const auto* ordinal = dependent(form_, selection, "Rank"))
    rank = rank_of_word(ordinal->proposition).value_or(1);
  Count before;
  for (auto& other : others) {
    if (other == id)
      continue;
    const auto& a = how->more ? other : id;
    const auto& b = how->more ? id : other;
    const auto is_before = is_more(a, b, how->dimension, anchor);
    const auto is_after = is_more(b, a, how->dimension, anchor);
    // Which of two that are about the same comes first, nobody can say.
    before.add(both(among.contains(other),
                    is_before == Truth::no && is_after != Truth::yes ? Truth::unknown : is_before));
  }
  return is_within(before, {rank - 1, rank + number - 2});
}

/// What "the small cube" means in a request where no cube, or several, are small: the clearly
/// smallest of the things that are so otherwise. "The tall cube" is the tallest, or the only one,
/// since nothing else says what is tall. Nothing if there is none.
std::optional<std::string> Evaluation::distinguished_by_size(const Nominal& phrase) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> selections{
    {{"large", "largest"},
     {"small", "smallest"},
     {"tall", "tallest"},
     {"short", "lowest"},
     {"high", "tallest"}}};
  const auto* size = dependent(form_, phrase, "Size");
  if (size == nullptr || is_negated(*size) || has_containers())
    return std::nullopt;
  const auto selection =
    std::ranges::find(selections, size->proposition, [](const auto& x) { return x.first; });
  if (selection == selections.end())
    return std::nullopt;
  Fitting others;
  for (const auto& other : candidates(phrase))
    others.add(other, fits_but_for(other, phrase, *size));
  const auto all = others.best();
  const bool is_height = selection->second == "tallest" || selection->second == "lowest";
  if (!is_height && !is_request())
    return std::nullopt;
  if (all.size() == 1 && is_height)
    return all.front();
  const Nominal most{"", "selection", std::string{selection->second}, {}, {}};
  Things found;
  for (const auto& id : all)
    if (all.size() > 1 && is_selected(id, most, others) == Truth::yes)
      found.push_back(id);
  return found.size() == 1 ? std::optional{found.front()} : std::nullopt;
}

/// "The ball at the back" of two, of which neither or both are there: the one farther back. "The
/// one in the middle" of several that were spoken of.
std::optional<std::string> Evaluation::distinguished_by_side(const Nominal& phrase) {
  const auto* side = dependent(form_, phrase, "Location");
  if (side == nullptr || side->sort != "region" || is_negated(*side) || has_containers() ||
      dependent(form_, *side, "Anchor") != nullptr)
    return std::nullopt;
  if (phrase.proposition == "one")
    return outermost(antecedents_of(phrase.name + std::string{last_group}), side->proposition);
  if (vocabulary().is_general(phrase.proposition))
    return std::nullopt;
  Fitting others;
  for (const auto& other : candidates(phrase))
    others.add(other, fits_but_for(other, phrase, *side));
  const auto both = others.best();
  return both.size() == 2 && side->proposition != "centre" ? outermost(both, side->proposition)
                                                           : std::nullopt;
}

/// The one of those that is farthest to a side, clearly, or that has as many on its left as on its
/// right.
std::optional<std::string> Evaluation::outermost(const Things& things,
                                                 const std::string& side) const {
  constexpr double least_difference = 0.02; // metres
  const bool is_centre = side == "centre";
  const bool is_along = side == "front" || side == "back";
  if (things.size() < 2 || (is_centre && things.size() % 2 == 0) ||
      !(is_centre || is_along || side == "left" || side == "right"))
    return std::nullopt;
  std::vector<std::pair<double, std::string>> in_order;
  for (const auto& id : things) {
    const auto at = scene_.place_in_view(id);
    if (!at)
      return std::nullopt;
    const double towards = is_along ? at->y : at->x;
    in_order.emplace_back(side == "left" || side == "front" ? -towards : towards, id);
  }
  std::ranges::sort(in_order, std::ranges::greater{});
  if (is_centre)
    return in_order[in_order.size() / 2].second;
  return in_order[0].first - in_order[1].first < least_difference
           ? std::nullopt
           : std::optional{in_order[0].second};
}

Truth Evaluation::shares(const std::string& a, const std::string& b, const std::string& quality) {
  auto kind = vocabulary().kind_of_quality(quality);
  if (!kind || (is_container(a) && is_container(b))) {
    auto x = value_of(a, {"", "quality", quality, {}, {}});
    auto y = value_of(b, {"", "quality", quality, {}, {}});
    return x && y ? truth_of(*x == *y) : Truth::unknown;
  }
  // Of two cubes that are called small, one may be larger. What a cube and a ball of the same size
  // measure nobody can say.
  if (*kind == FeatureKind::size) {
    const auto shape = scene_.words(a, FeatureKind::shape);
    const auto x = scene_.extent(a);
    const auto y = scene_.extent(b);
    if (x && y && !shape.empty() && shape == scene_.words(b, FeatureKind::shape))
      return truth_of(std::max(*x, *y) <= same_ratio * std::min(*x, *y));
  }
  auto words = scene_.words(a, *kind);
  if (words.empty())
    return Truth::unknown;
  auto result = Truth::no;
  for (auto& word : words)
    result = either(result, scene_.has(b, binding::feature(*kind, word)));
  return result;
}

bool Evaluation::is_request() const {
  return std::ranges::any_of(form_.nominals, [](const auto& x) { return x.sort == "action"; });
}

/// Sizes by the words for them, and where these are the same, by measures.
Truth Evaluation::is_more(const std::string& a, const std::string& b, const std::string& dimension,
                          const Nominal* anchor) {
  if (dimension == "size") {
    auto is = [&](const std::string& id, const char* word) {
      return scene_.has(id, binding::feature(FeatureKind::size, word)) == Truth::yes;
    };
    if (is(a, "large") && is(b, "small"))
      return Truth::yes;
    if (is(a, "small") && is(b, "large"))
      return Truth::no;
  }
  auto x = measure(a, dimension, anchor);
  auto y = measure(b, dimension, anchor);
  // "Give me the farthest thing": of two that are about as far away, either will do.
  if (x && y && is_request() && !is_length(dimension))
    return truth_of(*x > *y);
  return x && y ? truth_of(is_clearly_more(*x, *y, dimension)) : Truth::unknown;
}

/// "Closer to the ball than to the cube".
Truth Evaluation::compares_distances(const std::string& id, const Nominal& comparison,
                                     const Nominal& other) {
  const auto a = measure(id, "distance", &need(comparison, "Anchor"));
  const auto b = measure(id, "distance", &other);
  if (!a || !b)
    return Truth::unknown;
  const bool is_nearer = comparison.proposition == "nearer";
  if (std::abs(*a - *b) <= clear_distance)
    return Truth::unknown;
  return truth_of((*a < *b) == is_nearer);
}

/// "Taller than 7 cm", "at least 5 cm wide", "less than 10 cm from the cube".
Truth Evaluation::compares_with_length(const std::string& id, const Nominal& comparison,
                                       const Nominal& length) {
  const auto& word = comparison.proposition;
  const auto* dimension = dependent(form_, comparison, "Dimension");
  const auto* anchor = dependent(form_, comparison, "Anchor");
  const auto* how = comparative(word);
  const bool is_at_least = word == "at-least" || word == "as-long";
  const bool is_at_most = word == "at-most" || word == "as-long";
  if (how == nullptr && !is_at_least && !is_at_most)
    not_understood(word);
  const auto measured = measure(id,
                                dimension != nullptr ? dimension->proposition
                                : anchor != nullptr  ? "distance"
                                : how != nullptr     ? how->dimension
                                                     : "size",
                                anchor);
  if (anchor != nullptr) {
    const auto others = meant(*anchor);
    if (std::ranges::find(others, id) != others.end())
      return Truth::no;
  }
  if (!measured)
    return Truth::unknown;
  const auto said = metres_of_centimetres(length.proposition);
  if (how != nullptr)
    return truth_of(how->more ? *measured > said : *measured < said);
  return truth_of((!is_at_least || *measured >= said - exactness) &&
                  (!is_at_most || *measured <= said + exactness));
}

Truth Evaluation::compares(const std::string& id, const Nominal& comparison) {
  if (const auto* length = dependent(form_, comparison, "Length"))
    return compares_with_length(id, comparison, *length);
  if (const auto* other = dependent(form_, comparison, "OtherAnchor"))
    return compares_distances(id, comparison, *other);
  if (dependent(form_, comparison, "Than") == nullptr && related_.empty())
    return compares_with_before(id, comparison);
  if (dependent(form_, comparison, "Than") == nullptr && !related_.empty())
    return differs_from_context(id, comparison);
  auto& than = need(comparison, "Than");
  ScopedValue related{related_, id};
  if (const auto* quality = dependent(form_, comparison, "Quality")) {
    const bool same = comparison.proposition == "same";
    if (!same && comparison.proposition != "different")
      not_understood(comparison.proposition);
    return quantified(than, [&](const std::string& other) {
      if (other == id)
        return Truth::no;
      auto shared = shares(id, other, quality->proposition);
      return same ? shared : negation(shared);
    });
  }
  if (comparison.proposition == "as-large" || comparison.proposition == "as-small")
    return quantified(than, [&](const std::string& other) {
      return other == id ? Truth::no
                         : both(negation(is_more(id, other, "size", nullptr)),
                                negation(is_more(other, id, "size", nullptr)));
    });
  const auto* how = comparative(comparison.proposition);
  if (how == nullptr)
    not_understood(comparison.proposition);
  const auto* anchor = dependent(form_, comparison, "Anchor");
  const auto is_so = [&](const std::string& other) {
    if (other == id)
      return Truth::no;
    return how->more ? is_more(id, other, how->dimension, anchor)
                     : is_more(other, id, how->dimension, anchor);
  };
  const auto result = quantified(than, is_so);
  if (feature(than, "Delimitation") != "any" || result != Truth::yes || has_containers())
    return result;
  // "Larger than any ball" may mean than one or than each: nothing is said where that differs.
  for (const auto& other : described(than).certain)
    if (other != id && is_so(other) != Truth::yes)
      return Truth::unknown;
  return result;
}

} // namespace castor::communication
