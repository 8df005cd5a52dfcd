#include "castor/tests/communication/grid_phrases.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace castor::communication::test {

using namespace oracle;

namespace {

Predicate related_to_one(const Relation& relation, const Thing& to) {
  return [&relation, &to](auto&, auto& x) { return x.id == to.id ? Verdict::no : relation(x, to); };
}

/// What is not said of landmarks.
Predicate but_for(const Predicate& landmark, Predicate is) {
  return all_of({std::move(is), is_not(landmark)});
}

Scope joined(const Scope& a, const std::string& before, const std::string& word, const Scope& b,
             Predicate is) {
  return {before + a.singular + word + b.singular,
          before + a.plural + word + b.plural,
          std::move(is),
          together(a.needs, b.needs),
          any_of({a.landmark, b.landmark}),
          false};
}

} // namespace

// -- what is taken for granted

Presupposition exactly_one(Predicate is) {
  return [is = std::move(is)](auto& world) {
    auto number = number_of(world, is);
    if (number.most == 0)
      return Presence::missing;
    if (number.least > 1)
      return Presence::several;
    return number.least == number.most ? Presence::there : Presence::unknown;
  };
}

Presupposition at_least_one(Predicate is) {
  return [is = std::move(is)](auto& world) {
    auto number = number_of(world, is);
    if (number.least > 0)
      return Presence::there;
    return number.most > 0 ? Presence::unknown : Presence::missing;
  };
}

Presupposition exactly_two(Predicate is) {
  return [is = std::move(is)](auto& world) {
    auto number = number_of(world, is);
    if (number.most < 2)
      return Presence::missing;
    if (number.least > 2)
      return Presence::several;
    return number.least == number.most ? Presence::there : Presence::unknown;
  };
}

Presuppositions together(Presuppositions a, const Presuppositions& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// -- nouns

NounPhrase noun(const std::string& words) {
  std::istringstream in{words};
  std::vector<Predicate> so;
  for (std::string word; in >> word;) {
    if (word == "small" || word == "large")
      so.push_back(has_size(word));
    else if (word == "cube" || word == "ball" || word == "cylinder" || word == "pyramid")
      so.push_back(has_shape(word));
    else if (word != "thing")
      so.push_back(has_colour(word));
  }
  return {words, words + "s", all_of(so)};
}

NounPhrase with_place(const NounPhrase& of, const Scope& place) {
  return {of.singular + ' ' + place.singular, of.plural + ' ' + place.singular,
          all_of({of.is, place.is}), together(of.needs, place.needs)};
}

NounPhrase that_is(const NounPhrase& of, const Scope& scope, bool is_so) {
  auto is = is_so ? scope.is : but_for(scope.landmark, is_not(scope.is));
  const std::string negation = is_so ? "" : "not ";
  return {of.singular + " that is " + negation + scope.singular,
          of.plural + " that are " + negation + scope.plural, all_of({of.is, std::move(is)}),
          together(of.needs, scope.needs)};
}

// -- scopes

Scope adjective(const std::string& word) {
  return {word, word, word == "small" || word == "large" ? has_size(word) : has_colour(word)};
}

Scope a_kind(const std::string& words) {
  auto kind = noun(words);
  return {"a " + kind.singular, kind.plural, kind.is};
}

Scope no_such(const Scope& x) {
  return {"not " + x.singular,
          "not " + x.plural,
          but_for(x.landmark, is_not(x.is)),
          x.needs,
          x.landmark,
          false};
}

Scope and_both(const Scope& a, const Scope& b) {
  return joined(a, "", " and ", b, all_of({a.is, b.is}));
}

Scope or_one(const Scope& a, const Scope& b) {
  return joined(a, "", " or ", b, any_of({a.is, b.is}));
}

Scope nor_any(const Scope& a, const Scope& b) {
  return joined(a, "neither ", " nor ", b, all_of({no_such(a).is, no_such(b).is}));
}

Scope related_to_the(const std::string& words, const Relation& relation, const std::string& of) {
  auto landmark = noun(of);
  auto text = words + " the " + landmark.singular;
  auto is = [relation, landmark](auto& world, auto& x) {
    auto result = Verdict::no;
    for (auto& y : world)
      result =
        std::max(result, std::min(landmark.is(world, y), related_to_one(relation, y)(world, x)));
    return result;
  };
  return {text, text, is, {exactly_one(landmark.is)}, landmark.is};
}

Scope related_to(const std::string& words, const Relation& relation, const Quantifier& quantifier,
                 const std::string& of) {
  auto landmark = noun(of);
  auto text = words + ' ' + quantifier.before + ' ' +
              (quantifier.is_plural ? landmark.plural : landmark.singular);
  auto is = [relation, landmark, quantifier](auto& world, auto& x) {
    return quantifier.holds(world, landmark.is, [&](auto&, auto& y) {
      return x.id == y.id ? Verdict::no : relation(x, y);
    });
  };
  return {text, text, is, quantifier.needs(landmark)};
}

Scope the_most(const std::string& words, const Before& before, const std::string& of) {
  auto kind = noun(of);
  auto is = in_order(kind.is, before);
  auto text = words + ' ' + kind.singular;
  return {text, text, is, {exactly_one(is)}};
}

// -- quantifiers

Quantifier some(const std::string& before, bool is_plural) {
  return counted(before, is_plural, 1, 1000);
}

Quantifier none(const std::string& before, bool is_plural) {
  return counted(before, is_plural, 0, 0);
}

Quantifier all(const std::string& before, bool is_plural) {
  return {before, is_plural,
          [](auto& world, auto& noun, auto& scope) {
            return is_from_to(number_of(world, all_of({noun, is_not(scope)})), 0, 0);
          },
          [](auto& x) { return Presuppositions{at_least_one(x.is)}; }};
}

Quantifier most(const std::string& before) {
  return {before, true,
          [](auto& world, auto& noun, auto& scope) {
            auto so = number_of(world, all_of({noun, scope}));
            auto not_so = number_of(world, all_of({noun, is_not(scope)}));
            if (so.least > not_so.most)
              return Verdict::yes;
            return so.most <= not_so.least ? Verdict::no : Verdict::unknown;
          },
          [](auto& x) { return Presuppositions{at_least_one(x.is)}; }};
}

Quantifier counted(const std::string& before, bool is_plural, std::size_t least, std::size_t most) {
  return {before, is_plural, [least, most](auto& world, auto& noun, auto& scope) {
            return is_from_to(number_of(world, all_of({noun, scope})), least, most);
          }};
}

Quantifier of_the(Quantifier x) {
  x.before += " of the";
  x.needs = [](auto& of) { return Presuppositions{at_least_one(of.is)}; };
  return x;
}

} // namespace castor::communication::test
