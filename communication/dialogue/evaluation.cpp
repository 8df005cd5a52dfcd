#include "castor/communication/dialogue/evaluation.hpp"

#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace castor::communication {

namespace {

using binding::FeatureKind;

constexpr std::array number_words{"zero", "one",   "two",   "three", "four", "five",
                                  "six",  "seven", "eight", "nine",  "ten"};

std::string_view delimitation(const Nominal& x) {
  return feature(x, "Delimitation");
}

/// Stands for one thing or several that are known already.
bool is_definite_phrase(const Nominal& x) {
  return is_definite(x) || delimitation(x) == "both" || delimitation(x) == "neither";
}

/// Binds a nominal while something is evaluated.
class Binding {
public:
  Binding(std::map<std::string, std::string>& bound, const std::string& nominal)
    : bound_(bound), nominal_(nominal), before_(bound.extract(nominal)) {}
  ~Binding() {
    bound_.erase(nominal_);
    if (!before_.empty())
      bound_.insert(std::move(before_));
  }
  Binding(const Binding&) = delete;
  Binding& operator=(const Binding&) = delete;

  void set(const std::string& id) { bound_[nominal_] = id; }

private:
  std::map<std::string, std::string>& bound_;
  std::string nominal_;
  std::map<std::string, std::string>::node_type before_;
};

} // namespace

std::string number_word(std::size_t number) {
  return number < number_words.size() ? number_words[number] : "many";
}

std::optional<NumberRange> number_range(const Nominal& quantity) {
  auto word = std::find(number_words.begin(), number_words.end(), quantity.proposition);
  if (word == number_words.end())
    return std::nullopt;
  const auto number = static_cast<std::size_t>(word - number_words.begin());
  const auto bound = feature(quantity, "Bound");
  NumberRange range{number, number};
  if (bound == "at_least" || bound == "more_than")
    range = {bound == "at_least" ? number : number + 1};
  else if (bound == "at_most")
    range = {0, number};
  else if (bound == "fewer_than") {
    // Nothing is fewer than none.
    range = number == 0 ? NumberRange{1, 0} : NumberRange{0, number - 1};
  }
  return range;
}

void Evaluation::not_understood(const std::string& word) {
  throw Uninterpretable{Uninterpretable::Reason::word, word};
}

const Nominal& Evaluation::need(const Nominal& of, const char* mode) {
  const auto* result = dependent(form_, of, mode);
  if (result == nullptr)
    not_understood(of.proposition);
  return *result;
}

// -- clauses

Truth Evaluation::clause(const Nominal& e) {
  auto result = affirmed_clause(e);
  return feature(e, "Denied") == "true" ? negation(result) : result;
}

Truth Evaluation::affirmed_clause(const Nominal& e) {
  if (e.sort == "conjunction") {
    auto first = clause(need(e, "First"));
    auto next = clause(need(e, "Next"));
    return e.proposition == "or" ? either(first, next) : both(first, next);
  }
  if (e.sort == "ascription")
    return ascription(e);
  const bool is_perception = e.sort == "perception" && e.proposition == "see";
  if (e.sort != "existence" && !is_perception)
    not_understood(e.proposition);
  auto result = existence(need(e, is_perception ? "Patient" : "Subject"));
  if (const auto* place = dependent(form_, e, "Location"); place != nullptr && !is_perception)
    not_understood(place->proposition);
  return is_negated(e) ? negation(result) : result;
}

Truth Evaluation::ascription(const Nominal& e) {
  auto& subject = need(e, "Cop-Restr");
  auto& scope = need(e, "Cop-Scope");
  const bool negated = is_negated(e);
  if (subject.sort == "quality") {
    auto result = about_qualities(subject, scope);
    return negated ? negation(result) : result;
  }
  if (scope.sort == "comparison" && dependent(form_, scope, "Than") == nullptr) {
    auto result = collectively(subject, scope);
    return negated ? negation(result) : result;
  }
  if (scope.sort == "region" && scope.proposition == "near-each-other") {
    auto result = are_near_each_other(subject);
    return negated ? negation(result) : result;
  }
  return quantified(subject, [&](const std::string& id) {
    auto result = e.proposition == "have" ? has(id, scope) : is(id, scope, &subject);
    return negated ? negation(result) : result;
  });
}

/// "The cube has a ball beside it", "the ball has a different colour".
Truth Evaluation::has(const std::string& id, const Nominal& scope) {
  if (scope.sort == "comparison")
    return compares(id, scope);
  // What "it" is in "a ball beside it".
  for (auto& [mode, name] : scope.relations) {
    const auto* region = find_nominal(form_, name);
    const auto* anchor = region == nullptr ? nullptr : dependent(form_, *region, "Anchor");
    if (mode == "Location" && anchor != nullptr && is_pronoun(*anchor)) {
      Binding binding{bound_, anchor->name};
      binding.set(id);
      return existence(scope);
    }
  }
  not_understood("have");
}

Truth Evaluation::are_near_each_other(const Nominal& subject) {
  auto things = members(subject);
  auto result = truth_of(things.size() > 1);
  for (auto& a : things)
    for (auto& b : things)
      if (a != b)
        result = both(result, scene_.is_related("near", a, b));
  return result;
}

/// The things that a subject means together.
Evaluation::Things Evaluation::members(const Nominal& subject) {
  Things things;
  if (subject.sort == "conjunction") {
    for (const auto* mode : {"First", "Next"})
      for (auto& id : members(need(subject, mode)))
        things.push_back(id);
  } else if (is_definite_phrase(subject))
    things = meant(subject);
  else
    things = described(subject).best();
  return things;
}

/// "The colour of the ball is red", "the number of balls is greater than the number of cubes".
Truth Evaluation::about_qualities(const Nominal& subject, const Nominal& scope) {
  auto& owner = need(subject, "Owner");
  if (scope.sort == "region")
    not_understood(scope.proposition);
  if (subject.proposition != "number")
    return quantified(owner, [&](const std::string& id) { return is(id, scope); });
  const auto* other = dependent(form_, scope, "Than");
  if (scope.sort != "comparison" || other == nullptr || other->sort != "quality")
    not_understood(scope.proposition);
  auto a = described(owner).count();
  auto b = described(need(*other, "Owner")).count();
  auto more = [](const Count& x, const Count& y) {
    if (x.certain > y.possible)
      return Truth::yes;
    return x.possible <= y.certain ? Truth::no : Truth::unknown;
  };
  if (scope.proposition == "greater" || scope.proposition == "more")
    return more(a, b);
  if (scope.proposition == "smaller" || scope.proposition == "fewer")
    return more(b, a);
  if (scope.proposition != "same")
    not_understood(scope.proposition);
  return both(negation(more(a, b)), negation(more(b, a)));
}

Truth Evaluation::existence(const Nominal& subject) {
  if (const auto* quantity = dependent(form_, subject, "Quantity");
      quantity != nullptr && quantity->sort == "comparison")
    return compared_counts(subject, *quantity);
  if (subject.sort == "conjunction") {
    auto first = existence(need(subject, "First"));
    auto next = existence(need(subject, "Next"));
    return subject.proposition == "or" ? either(first, next) : both(first, next);
  }
  return quantified(subject, [](auto&) { return Truth::yes; });
}

/// "More cubes than balls", "an equal number of cubes and balls".
Truth Evaluation::compared_counts(const Nominal& subject, const Nominal& quantity) {
  const auto* other = dependent(form_, quantity, "Than");
  const auto* one = &subject;
  if (other == nullptr && subject.sort == "conjunction") {
    one = &need(subject, "First");
    other = &need(subject, "Next");
  }
  if (other == nullptr)
    not_understood(quantity.proposition);
  auto a = described(*one).count();
  auto b = described(*other).count();
  auto more = [](const Count& x, const Count& y) {
    if (x.certain > y.possible)
      return Truth::yes;
    return x.possible <= y.certain ? Truth::no : Truth::unknown;
  };
  if (quantity.proposition == "more")
    return more(a, b);
  if (quantity.proposition == "fewer")
    return more(b, a);
  if (quantity.proposition != "same")
    not_understood(quantity.proposition);
  return both(negation(more(a, b)), negation(more(b, a)));
}

/// "The ball and the cube are the same colour", "all cubes have different colours".
Truth Evaluation::collectively(const Nominal& subject, const Nominal& comparison) {
  auto& quality = need(comparison, "Quality");
  auto things = members(subject);
  const bool same = comparison.proposition == "same";
  if (!same && comparison.proposition != "different")
    not_understood(comparison.proposition);
  auto result = Truth::yes;
  for (std::size_t i = 0; i < things.size(); ++i)
    for (std::size_t k = i + 1; k < things.size(); ++k) {
      auto shared = shares(things[i], things[k], quality.proposition);
      result = both(result, same ? shared : negation(shared));
    }
  return result;
}

// -- phrases

/// "Both" and "either" are said of two phrases.
void Evaluation::check_coordination(const Nominal& x) {
  if (x.sort != "conjunction" && !feature(x, "Coordination").empty())
    not_understood(std::string{feature(x, "Coordination")});
}

Fitting Evaluation::answers(const Nominal& e, const Nominal& asked) {
  Fitting result;
  auto candidates = described(asked);
  const auto* topic = dependent(form_, e, "Topic");
  const auto* excepted = dependent(form_, e, "Except");
  for (auto& id : candidates.possible) {
    auto is_certain = std::ranges::find(candidates.certain, id) != candidates.certain.end();
    auto truth = is_certain ? Truth::yes : Truth::unknown;
    if (topic != nullptr && asked.proposition == "one")
      truth = both(truth, is_one_of(id, *topic));
    if (excepted != nullptr)
      truth = both(truth, negation(is_one_of(id, *excepted)));
    Binding binding{bound_, asked.name};
    binding.set(id);
    truth = both(truth, clause(e));
    if (truth != Truth::no)
      result.possible.push_back(id);
    if (truth == Truth::yes)
      result.certain.push_back(id);
  }
  return result;
}

Fitting Evaluation::described(const Nominal& phrase) {
  Fitting result;
  for (auto& id : scene_.things()) {
    auto truth = fits(id, phrase);
    if (truth != Truth::no)
      result.possible.push_back(id);
    if (truth == Truth::yes)
      result.certain.push_back(id);
  }
  return result;
}

Evaluation::Things Evaluation::antecedents_of(const std::string& name) {
  Things result;
  auto known = antecedents_.find(name);
  if (known == antecedents_.end())
    return result;
  for (auto& id : scene_.things())
    for (auto& proxy : known->second)
      if (scene_.has(id, binding::feature(FeatureKind::existing_proxy_id, proxy)) == Truth::yes) {
        result.push_back(id);
        break;
      }
  return result;
}

/// How many things a definite phrase such as "the two balls" or "both" is about; one or more if it
/// does not say.
NumberRange Evaluation::wanted_number(const Nominal& phrase) const {
  if (delimitation(phrase) == "both" || delimitation(phrase) == "neither")
    return {2, 2};
  const auto* quantity = dependent(form_, phrase, "Quantity");
  return quantity == nullptr ? NumberRange{1} : number_range(*quantity).value_or(NumberRange{1});
}

std::vector<std::string> Evaluation::meant(const Nominal& phrase) {
  using Reason = Uninterpretable::Reason;
  if (auto known = bound_.find(phrase.name); known != bound_.end())
    return {known->second};
  if (is_pronoun(phrase)) {
    // "The ball, what colour is it?"
    const auto* root = find_nominal(form_, form_.root);
    const auto* topic = root == nullptr ? nullptr : dependent(form_, *root, "Topic");
    if (topic != nullptr && topic->name != phrase.name)
      return meant(*topic);
    if (const auto* earlier = earlier_phrase(phrase))
      return meant(*earlier);
    auto result = antecedents_of(phrase.name);
    if (result.empty() && scene_.open_questions().empty()) {
      // Something that is shown is the only thing there is, if it is not pointed at.
      if (!is_plural(phrase) && is_deictic(phrase) && scene_.things().size() == 1)
        return scene_.things();
      throw Uninterpretable{Reason::ambiguous, phrase.name};
    }
    return result;
  }
  auto found = described(phrase);
  if (found.possible.empty()) {
    is_lenient_ = true;
    found = described(phrase);
    is_lenient_ = false;
  }
  if (!scene_.open_questions().empty())
    return {};
  const auto range = wanted_number(phrase);
  if (is_plural(phrase) || range.least > 1) {
    const auto number = found.best().size();
    if (number == 0 || found.possible.size() < range.least)
      throw Uninterpretable{Reason::nothing_like, phrase.name};
    if (is_within({number, number}, range) != Truth::yes)
      throw Uninterpretable{Reason::ambiguous, phrase.name};
    return found.best();
  }
  if (found.certain.empty() && found.possible.size() != 1)
    throw Uninterpretable{Reason::nothing_like, phrase.name};
  if (found.certain.size() > 1)
    throw Uninterpretable{Reason::ambiguous, phrase.name};
  return found.best();
}

/// Of how many things that the phrase describes `scope` is true.
Count Evaluation::count(const Nominal& phrase, const Property& scope) {
  Count result;
  auto candidates = described(phrase);
  for (auto& id : candidates.possible) {
    auto is_certain = std::ranges::find(candidates.certain, id) != candidates.certain.end();
    result.add(both(scope(id), is_certain ? Truth::yes : Truth::unknown));
  }
  return result;
}

Truth Evaluation::quantified(const Nominal& phrase, const Property& scope) {
  check_coordination(phrase);
  auto result = unfocused(phrase, scope);
  if (feature(phrase, "Focus") != "only")
    return result;
  // Nothing else is so.
  for (auto& id : scene_.things())
    result = both(result, either(negation(scope(id)), is_one_of(id, phrase)));
  return result;
}

Truth Evaluation::unfocused(const Nominal& phrase, const Property& scope) {
  if (auto known = bound_.find(phrase.name); known != bound_.end())
    return scope(known->second);
  if (phrase.sort == "conjunction") {
    auto first = quantified(need(phrase, "First"), scope);
    auto next = quantified(need(phrase, "Next"), scope);
    if (phrase.proposition == "or")
      return either(first, next);
    return phrase.proposition == "nor" ? both(negation(first), negation(next)) : both(first, next);
  }
  if (phrase.sort != "thing" && phrase.sort != "entity")
    not_understood(phrase.proposition);
  const auto delimited = delimitation(phrase);
  if (is_definite_phrase(phrase)) {
    auto result = Truth::yes;
    for (auto& id : meant(phrase)) {
      auto truth = scope(id);
      result = both(result, delimited == "neither" ? negation(truth) : truth);
    }
    return scene_.open_questions().empty() ? result : Truth::unknown;
  }
  const auto* quantity = dependent(form_, phrase, "Quantity");
  auto so = count(phrase, scope);
  if (quantity != nullptr) {
    auto range = number_range(*quantity);
    if (quantity->proposition == "several" || quantity->proposition == "many")
      range = NumberRange{2};
    if (!range)
      not_understood(quantity->proposition);
    return is_within(so, *range);
  }
  if (delimited == "none")
    return is_within(so, {0, 0});
  auto not_so = count(phrase, [&](const std::string& id) { return negation(scope(id)); });
  if (delimited == "most") {
    if (so.certain > not_so.possible)
      return Truth::yes;
    return so.possible <= not_so.certain ? Truth::no : Truth::unknown;
  }
  if (delimited == "all") {
    auto none = scene_.open_questions().empty() && described(phrase).possible.empty();
    if (none)
      throw Uninterpretable{Uninterpretable::Reason::nothing_like, phrase.name};
    return is_within(not_so, {0, 0});
  }
  return is_within(so, {1});
}

Truth Evaluation::is_one_of(const std::string& id, const Nominal& phrase) {
  if (is_definite_phrase(phrase)) {
    auto things = meant(phrase);
    return truth_of(std::ranges::find(things, id) != things.end());
  }
  return fits(id, phrase);
}

/// Fits the phrase without one of its modifiers.
Truth Evaluation::fits_but_for(const std::string& id, const Nominal& phrase,
                               const Nominal& modifier) {
  auto without = phrase;
  std::erase_if(without.relations, [&](auto& x) { return x.dependent == modifier.name; });
  return fits(id, without);
}

Truth Evaluation::fits(const std::string& id, const Nominal& phrase, bool with_selection) {
  if (phrase.sort == "conjunction") {
    // "Cubes and balls" are all that are one or the other.
    auto result = either(fits(id, need(phrase, "First")), fits(id, need(phrase, "Next")));
    for (auto& [mode, name] : phrase.relations)
      if (const auto* x = find_nominal(form_, name);
          x != nullptr && mode != "First" && mode != "Next")
        result = both(result, modified(id, phrase, mode, *x));
    return result;
  }
  auto result = is_called(id, phrase);
  const Nominal* selection = nullptr;
  for (auto& [mode, name] : phrase.relations) {
    const auto* x = find_nominal(form_, name);
    if (x == nullptr || result == Truth::no)
      continue;
    if (mode == "Selection")
      selection = x;
    else
      result = both(result, modified(id, phrase, mode, *x));
  }
  if (selection == nullptr || !with_selection || result == Truth::no)
    return result;
  Things among;
  for (auto& other : scene_.things())
    if (fits(other, phrase, false) != Truth::no)
      among.push_back(other);
  return both(result, is_selected(id, *selection, among));
}

Truth Evaluation::is_called(const std::string& id, const Nominal& phrase) {
  if (auto known = bound_.find(phrase.name); known != bound_.end() && is_pronoun(phrase))
    return truth_of(known->second == id);
  if (is_pronoun(phrase)) {
    auto things = meant(phrase);
    return truth_of(std::ranges::find(things, id) != things.end());
  }
  auto& noun = phrase.proposition;
  if (is_general_noun(noun))
    return Truth::yes;
  auto named = scene_.has(id, binding::feature(FeatureKind::concept_name, noun));
  auto shape = shape_of_noun(noun);
  // "Box" may mean a container or a cube: what there is.
  if (!shape || named == Truth::yes)
    return named;
  return has_shape(id, *shape);
}

/// A shape that looks like another may be meant where nothing else can be.
Truth Evaluation::has_shape(const std::string& id, const std::string& shape) {
  auto result = scene_.has(id, binding::feature(FeatureKind::shape, shape));
  if (result == Truth::unknown && !is_lenient_ && !scene_.words(id, FeatureKind::shape).empty())
    return Truth::no;
  return result;
}

/// The first definite phrase before a pronoun in the same sentence: "is the ball large, and is it
/// red?" Null if there is none.
const Nominal* Evaluation::earlier_phrase(const Nominal& pronoun) {
  const auto* root = find_nominal(form_, form_.root);
  if (root == nullptr || root->sort != "conjunction" || is_plural(pronoun))
    return nullptr;
  const auto* first = dependent(form_, *root, "First");
  const auto* subject = first == nullptr ? nullptr : dependent(form_, *first, "Cop-Restr");
  const bool is_before = subject != nullptr && subject->sort == "thing" && is_definite(*subject) &&
                         !is_pronoun(*subject) && !is_plural(*subject);
  return is_before ? subject : nullptr;
}

Truth Evaluation::modified(const std::string& id, const Nominal& phrase, const std::string& mode,
                           const Nominal& x) {
  if (mode == "Quantity")
    return Truth::yes;
  if (mode == "PartOf")
    return is_one_of(id, x);
  if (mode == "Except")
    return negation(is_one_of(id, x));
  if (mode == "GenRelation") {
    // "That you see" says nothing new.
    if (x.sort == "perception" && x.proposition == "see")
      return Truth::yes;
    Binding binding{bound_, phrase.name};
    binding.set(id);
    return clause(x);
  }
  if (mode == "Owner" || mode == "Accompaniment" || mode == "Name")
    not_understood(x.proposition);
  if (mode == "Property" && x.proposition == "only") {
    Count so;
    for (auto& other : scene_.things())
      so.add(other == id ? Truth::no : fits_but_for(other, phrase, x));
    return is_within(so, {0, 0});
  }
  if (mode == "Property" && x.proposition == "other") {
    auto contains = [&](const Things& things) {
      return truth_of(std::ranges::find(things, id) != things.end());
    };
    auto all = antecedents_of(phrase.name + std::string{chosen_from});
    auto others = negation(contains(antecedents_of(phrase.name)));
    return all.empty() ? others : both(contains(all), others);
  }
  return is(id, x, &phrase);
}

} // namespace castor::communication
