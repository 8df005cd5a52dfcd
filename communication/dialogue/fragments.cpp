#include "castor/communication/dialogue/fragments.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/directive_places.hpp"
#include "castor/communication/dialogue/substitution.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/numerals.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

namespace castor::communication {

namespace {

/// "Put the cube on the box. The other way round": the box on the cube.
bool exchange(LogicalForm& request) {
  auto& root = *find_nominal(request, request.root);
  const auto* patient = dependent(request, root, "Patient");
  const auto* destination = dependent(request, root, "Destination");
  const auto* anchor =
    destination == nullptr ? nullptr : dependent(request, *destination, "Anchor");
  if (patient == nullptr || patient->sort != "thing" || anchor == nullptr ||
      anchor->sort != "thing")
    return false;
  const auto moved = patient->name;
  const auto landmark = anchor->name;
  for (auto& relation : root.relations)
    if (relation.mode == "Patient")
      relation.dependent = landmark;
  for (auto& relation : find_nominal(request, destination->name)->relations)
    if (relation.mode == "Anchor")
      relation.dependent = moved;
  return true;
}

/// "The other way": where the request goes is its opposite then.
bool turn(LogicalForm& request) {
  constexpr std::array<std::array<std::string_view, 2>, 2> opposites{
    {{"left", "right"}, {"front", "back"}}};
  const auto* root = find_nominal(request, request.root);
  const auto* destination = root == nullptr ? nullptr : dependent(request, *root, "Destination");
  if (destination == nullptr)
    return false;
  auto& where = *find_nominal(request, destination->name);
  auto& place = where.proposition;
  for (const auto& [a, b] : opposites)
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}})
      if (const auto at = place.find(from); at != std::string::npos) {
        place.replace(at, from.size(), to);
        where.features.push_back({"Corrects", "true"});
        return true;
      }
  return exchange(request);
}

void set_feature(Nominal& x, std::string_view name, std::string_view value) {
  std::erase_if(x.features, [&](auto& feature) { return feature.name == name; });
  x.features.push_back({std::string{name}, std::string{value}});
}

/// \param centimetres none if empty
void set_degree(Nominal& region, std::string_view degree, std::string_view centimetres = {}) {
  set_feature(region, "Degree", degree);
  std::erase_if(region.features, [](auto& x) { return x.name == "Centimetres"; });
  if (!centimetres.empty())
    region.features.push_back({"Centimetres", std::string{centimetres}});
}

/// "A bit more", "closer", "not so far" after a place at a thing: the gap between both becomes
/// narrower or wider.
/// \returns whether the place is one with a gap
bool change_gap(Nominal& region, std::string_view more) {
  constexpr std::array<std::string_view, 7> towards{"near", "next_to",  "to",    "at",
                                                    "by",   "touching", "closer"};
  constexpr std::array<std::string_view, 12> off{
    "left",           "right",         "front", "back", "directly-left", "directly-right",
    "directly-front", "directly-back", "away",  "from", "far",           "farther"};
  const bool goes_towards = std::ranges::find(towards, region.proposition) != towards.end();
  if (!goes_towards && std::ranges::find(off, region.proposition) == off.end())
    return false;
  const bool is_closer =
    more == "closer" || (more != "farther" && goes_towards == (more != "half-back"));
  const bool is_number = std::isdigit(static_cast<unsigned char>(more.front())) != 0;
  region.proposition = is_closer ? "closer" : "farther";
  set_degree(region, more == "more" ? "more" : "small", is_number ? more : std::string_view{});
  return true;
}

/// "Either of them", "both": how many of those are meant that may be; empty if it does not say.
std::string all_or_any(const LogicalForm& form, const Nominal& fragment) {
  if (fragment.sort == "marker")
    return fragment.proposition == "either" ? "any" : "";
  const auto* whole = dependent(form, fragment, "PartOf");
  const auto* number = dependent(form, fragment, "Quantity");
  // "Both" is "they two".
  if (fragment.proposition == "they" && number != nullptr && number->proposition == "two")
    return "both";
  const auto all = feature(fragment, "Delimitation");
  const bool is_alone = fragment.relations.size() == (whole == nullptr ? 0U : 1U);
  const bool is_of_these = whole == nullptr || is_pronoun(*whole);
  return fragment.proposition == "one" && is_alone && is_of_these && (all == "any" || all == "both")
           ? std::string{all}
           : std::string{};
}

/// "Behind the ball." "Which ball?" "Behind the blue one." says the place once more.
bool is_other_place(const LogicalForm& form, const std::string& asked, const Nominal& fragment) {
  return fragment.sort == "region" && std::ranges::any_of(form.nominals, [&](const Nominal& x) {
           const auto* anchor = dependent(form, x, "Anchor");
           return anchor != nullptr && anchor->name == asked &&
                  x.proposition == fragment.proposition;
         });
}

/// "Not the blue one": the thing that was asked about does not have that.
/// \returns false if more is said than one quality
bool exclude(LogicalForm& form, Nominal& asked, const Nominal& fragment) {
  if (fragment.relations.size() != 1)
    return false;
  const auto& [mode, property] = fragment.relations.front();
  if (mode != "Colour" && mode != "Size" && mode != "Shape" && mode != "Material")
    return false;
  set_feature(*find_nominal(form, property), "Polarity", "neg");
  asked.relations.push_back({mode, property});
  return true;
}

/// "On the left", "blue", "the bigger": what tells the thing that was asked about from others.
bool tell_apart(LogicalForm& form, const std::string& asked, const std::string& fragment) {
  constexpr std::array<std::array<std::string_view, 2>, 4> properties{
    {{"colour", "Colour"}, {"size", "Size"}, {"shape", "Shape"}, {"material", "Material"}}};
  constexpr std::array<std::array<std::string_view, 2>, 5> sides{{{"left", "leftmost"},
                                                                  {"right", "rightmost"},
                                                                  {"front", "frontmost"},
                                                                  {"here", "frontmost"},
                                                                  {"back", "backmost"}}};
  auto relate = [&](std::string_view mode) {
    find_nominal(form, asked)->relations.push_back({std::string{mode}, fragment});
    return true;
  };
  auto& said = *find_nominal(form, fragment);
  if (said.sort == "selection") {
    std::erase_if(said.features, [](auto& x) { return x.name == "Of"; });
    return relate("Selection");
  }
  for (const auto& [sort, mode] : properties)
    if (said.sort == sort)
      return relate(mode);
  if (said.sort != "region" && said.sort != "place")
    return false;
  // Of those that may be meant, whatever is on either side of the table.
  if (dependent(form, said, "Anchor") == nullptr && dependent(form, said, "Owner") == nullptr)
    for (const auto& [side, selection] : sides)
      if (said.proposition == side) {
        said = {said.name, "selection", std::string{selection}, {}, {}};
        return relate("Selection");
      }
  if (said.sort != "region")
    return false;
  relate("Location");
  // "Front left": what is in front and on the left.
  constexpr std::string_view corner = "-corner";
  const auto middle = said.proposition.find('-');
  if (said.proposition.ends_with(corner) && middle != std::string::npos) {
    const auto end = said.proposition.size() - corner.size();
    auto other = said;
    other.name += "-side";
    other.proposition =
      said.proposition.substr(std::min(middle + 1, end), end - std::min(middle + 1, end));
    said.proposition.resize(middle);
    find_nominal(form, asked)->relations.push_back({"Location", other.name});
    form.nominals.push_back(std::move(other));
  }
  return true;
}

} // namespace

std::string append(LogicalForm& form, const LogicalForm& other, Antecedents& antecedents,
                   const Antecedents& others) {
  std::string prefix = "n";
  auto is_taken = [&] {
    return std::ranges::any_of(form.nominals,
                               [&](auto& x) { return x.name.starts_with(prefix + '-'); });
  };
  while (is_taken())
    prefix += 'n';
  prefix += '-';
  for (auto x : other.nominals) {
    x.name = prefix + x.name;
    for (auto& relation : x.relations)
      relation.dependent = prefix + relation.dependent;
    form.nominals.push_back(std::move(x));
  }
  for (auto& [name, proxies] : others)
    antecedents.insert_or_assign(prefix + name, proxies);
  return prefix + other.root;
}

bool clarify(CompleteMove& question, const std::string& nominal, const LogicalForm& said,
             const Antecedents& antecedents, const Vocabulary& vocabulary) {
  auto& form = question.move.content;
  const auto name = append(form, said, question.antecedents, antecedents);
  auto* asked = find_nominal(form, nominal);
  const auto* fragment = find_nominal(form, name);
  if (asked == nullptr || fragment == nullptr)
    return false;
  if (const auto all = all_or_any(form, *fragment); !all.empty() && !is_pronoun(*asked)) {
    set_feature(*asked, "Delimitation", all);
    set_feature(*asked, "Number", all == "both" ? "pl" : "sg");
    return true;
  }
  if (fragment->sort != "thing")
    return !is_pronoun(*asked) && !is_other_place(form, nominal, *fragment) &&
           tell_apart(form, nominal, name);
  // "This one."
  const std::string at{pointed_at};
  if (auto shown = question.antecedents.find(name + at); shown != question.antecedents.end()) {
    question.antecedents.insert_or_assign(nominal + at, shown->second);
    return true;
  }
  if (is_pronoun(*fragment))
    return false;
  // "Not the blue one."
  if (is_negated(*fragment))
    return exclude(form, *asked, *fragment);
  // What "this" is has been said now.
  if (is_pronoun(*asked)) {
    asked->proposition = fragment->proposition == "one" ? "thing" : fragment->proposition;
    asked->features = fragment->features;
  } else if (!vocabulary.is_general(fragment->proposition))
    asked->proposition = fragment->proposition;
  for (auto& relation : fragment->relations)
    if (relation.mode != "InsteadOf")
      asked->relations.push_back(relation);
  return true;
}

bool substitute(CompleteMove& question, const LogicalForm& said, const Antecedents& antecedents,
                const Vocabulary& vocabulary) {
  auto& form = question.move.content;
  const auto name = append(form, said, question.antecedents, antecedents);
  const auto* fragment = find_nominal(form, name);
  if (fragment != nullptr && fragment->sort == "region" && fragment->proposition == "other-way")
    return turn(form);
  return fragment != nullptr && substitute_fragment(form, *fragment, vocabulary);
}

bool correct_number(CompleteMove& statement, const LogicalForm& said,
                    const Antecedents& antecedents) {
  const auto* fragment = find_nominal(said, said.root);
  const auto* number = fragment == nullptr ? nullptr : dependent(said, *fragment, "Quantity");
  const auto* root = find_nominal(statement.move.content, statement.move.content.root);
  const auto* topic =
    root == nullptr ? nullptr : dependent(statement.move.content, *root, "Subject");
  const auto* old =
    topic == nullptr ? nullptr : dependent(statement.move.content, *topic, "Quantity");
  const bool is_alone = fragment != nullptr && fragment->proposition == "one" &&
                        fragment->sort == "thing" && fragment->relations.size() == 1 &&
                        !is_definite(*fragment);
  if (!is_alone || number == nullptr || old == nullptr || is_negated(*root))
    return false;
  const auto from = old->name;
  const auto subject = topic->name;
  const bool is_several = is_plural(*fragment);
  const auto name =
    append(statement.move.content, part_of(said, number->name), statement.antecedents, antecedents);
  for (auto& x : find_nominal(statement.move.content, subject)->relations)
    if (x.dependent == from)
      x.dependent = name;
  for (auto& x : find_nominal(statement.move.content, subject)->features)
    if (x.name == "Number")
      x.value = is_several ? "pl" : "sg";
  return true;
}

bool asks_for_more(const LogicalForm& said) {
  const auto asks = [](const Nominal* x) {
    return x != nullptr && x->sort == "action" && x->proposition == "same" &&
           !feature(*x, "More").empty();
  };
  const auto* root = find_nominal(said, said.root);
  return asks(root) ||
         (root != nullptr && root->sort == "conjunction" && asks(dependent(said, *root, "First")) &&
          asks(dependent(said, *root, "Next")));
}

namespace {

std::optional<double> number_after(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix))
    return std::nullopt;
  text.remove_prefix(prefix.size());
  double result = 0;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

/// In centimetres: how much further something is to go that went as far as the region says.
std::optional<double> length_change(const Nominal& region, std::string_view more) {
  if (const auto less = number_after(more, "less-"))
    return -*less;
  const auto all = number_after(more, "in-all-");
  const auto old = number_after(feature(region, "Centimetres"), "");
  return all && old && *all != *old && *old != 0 ? std::optional{*all - *old} : std::nullopt;
}

} // namespace

std::optional<LogicalForm> repeated(LogicalForm request, std::string_view more, bool has_unit) {
  const auto* root = find_nominal(request, request.root);
  const auto* destination = root == nullptr ? nullptr : dependent(request, *root, "Destination");
  const bool is_number = std::isdigit(static_cast<unsigned char>(more.front())) != 0;
  // "Take two balls. Three more.": no centimetres.
  if (is_number && !has_unit &&
      (destination == nullptr || feature(*destination, "Centimetres").empty()))
    return std::nullopt;
  if (more == "again")
    return request;
  const bool is_of_gap = more == "closer" || more == "farther";
  if (destination == nullptr)
    return is_of_gap ? std::nullopt : std::optional{request};
  auto& region = *find_nominal(request, destination->name);
  if (const auto* landmark = dependent(request, *destination, "Anchor")) {
    if (const auto all = number_after(more, "in-all-")) {
      set_degree(region, "more", numeral(*all));
      return request;
    }
    const bool is_changed = landmark->sort == "thing" && change_gap(region, more);
    return is_changed || !is_of_gap ? std::optional{request} : std::nullopt;
  }
  std::string side = region.proposition.substr(region.proposition.find('-') + 1);
  const auto opposite = opposite_of(side);
  // To who speaks, in front.
  if (is_of_gap) {
    if (side != "front" && side != "back" && side != "here")
      return std::nullopt;
    region.proposition = more == "closer" ? "further-front" : "further-back";
    set_degree(region, "small");
    return request;
  }
  if (!opposite)
    return request;
  if (const auto change = length_change(region, more)) {
    if (*change < 0)
      side = *opposite;
    region.proposition = "further-" + side;
    set_degree(region, "more", numeral(std::abs(*change)));
    return request;
  }
  if (number_after(more, "in-all-"))
    return std::nullopt;
  if (more == "half-back") {
    // Without a length it went as far as "further" or "a bit" says.
    side = *opposite;
    const auto length = feature(region, "Centimetres");
    double number = feature(region, "Degree") == "small" ? 4 : 8;
    std::from_chars(length.data(), length.data() + length.size(), number);
    region.proposition = "further-" + side;
    set_degree(region, "more", numeral(number / 2));
    return request;
  }
  region.proposition = "further-" + side;
  if (is_number)
    set_degree(region, "more", more);
  else
    set_degree(region, more);
  return request;
}

} // namespace castor::communication
