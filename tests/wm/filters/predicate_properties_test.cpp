#include "castor/wm/filters/bound_predicate.hpp"
#include "castor/wm/filters/predicate.hpp"
#include "castor/wm/values/value.hpp"

#include "castor/tests/wm/filters/random_predicates.hpp"
#include "castor/tests/wm/values/opaque_value.hpp"
#include "castor/tests/wm/values/seeded_random.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace castor::test {

RC_GTEST_PROP(PredicateProperties, MeanWhatTheySay, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto wanted = random_predicate(random, 3);
    auto predicate = Predicate::parse(wanted.text);
    predicate.check(*descriptor_of<Thing>());
    BoundPredicate bound{predicate.tree(), *descriptor_of<Thing>()};
    for (int j = 0; j < 5; ++j) {
      auto thing = random_thing(random);
      auto value = Value::of(thing);
      auto far = opaque(value);
      bool expected = wanted.is_true(thing);
      if (predicate.matches(value) != expected || predicate.matches(far) != expected ||
          bound.matches(value) != expected || bound.matches(far) != expected)
        RC_FAIL(wanted.text + " should be " + (expected ? "true" : "false"));
    }
  }
}

RC_GTEST_PROP(PredicateProperties, MeanTheSameOfDerivedTypes, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto wanted = random_predicate(random, 2);
    auto thing = random_thing(random);
    SpecialThing special;
    static_cast<Thing&>(special) = thing;
    auto predicate = Predicate::parse(wanted.text);
    RC_ASSERT(predicate.matches(Value::of(special)) == wanted.is_true(thing));
    RC_ASSERT(predicate.matches(opaque(Value::of(special))) == wanted.is_true(thing));
  }
}

RC_GTEST_PROP(PredicateProperties, TravelAsText, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto predicate = Predicate::parse(random_predicate(random, 5).text);
    auto there = Predicate::parse(predicate.text());
    RC_ASSERT(there == predicate);
    RC_ASSERT(there.text() == predicate.text());
  }
}

RC_GTEST_PROP(PredicateProperties, ComposeLikeTheirTexts, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto a = random_predicate(random, 2).text;
    auto b = random_predicate(random, 2).text;
    auto x = Predicate::parse(a);
    auto y = Predicate::parse(b);
    RC_ASSERT((x && y) == Predicate::parse(a + "&&" + b));
    RC_ASSERT((x || y) == Predicate::parse(a + "||" + b));
    RC_ASSERT(!x == Predicate::parse("!" + a));
    RC_ASSERT(!!x == x);
  }
}

RC_GTEST_PROP(PredicateProperties, AnyTextIsReadOrRefused, ()) {
  static const std::vector<std::string> tokens{
    "a",     "a.b",   "x",    "has(", "distance(", "[",  "]",   ",",  "1",  "-2.5",
    "1e999", "\"s\"", "\"",   "\\",   "true",      "(",  ")",   "!",  "&&", "||",
    "==",    "!=",    "<",    "<=",   ">",         "=",  "&",   "|",  " ",  "\n",
    "e",     ".",     "\xff", "-",    "+",         "0x", "nan", "inf"};
  auto random = seeded();
  int read = 0;
  for (int i = 0; i < 20 * rounds; ++i) {
    std::string text;
    for (int j = between(random, 0, 12); j > 0; --j)
      if (i % 4 == 0)
        text += static_cast<char>(random());
      else
        text += tokens[between<std::size_t>(random, 0, tokens.size() - 1)];
    try {
      auto predicate = Predicate::parse(text);
      RC_ASSERT(Predicate::parse(predicate.text()) == predicate);
      predicate.matches(Value::of(Thing{}));
      ++read;
    } catch (const PredicateError& e) {
      RC_ASSERT(e.position() <= text.size());
    }
  }
  RC_ASSERT(read > 0);
}

RC_GTEST_PROP(PredicateProperties, DamagedTextsAreReadOrRefused, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto text = random_predicate(random, 4).text;
    Bytes bytes{text.begin(), text.end()};
    damage(bytes, random);
    try {
      auto predicate = Predicate::parse(std::string{bytes.begin(), bytes.end()});
      RC_ASSERT(Predicate::parse(predicate.text()) == predicate);
    } catch (const PredicateError& e) {
      RC_ASSERT(e.position() <= bytes.size());
    }
  }
}

RC_GTEST_PROP(PredicateProperties, SurviveDamagedValues, ()) {
  auto random = seeded();
  auto original = Value::of(random_thing(random)).bytes();
  for (int i = 0; i < rounds; ++i) {
    auto bytes = original;
    damage(bytes, random);
    auto value = Value::from_bytes(descriptor_of<Thing>(), bytes);
    Predicate::parse(random_predicate(random, 3).text).matches(value);
  }
}

} // namespace castor::test
