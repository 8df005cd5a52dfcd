#pragma once

#include "castor/tests/communication/table_oracle.hpp"

#include <string>
#include <vector>

/// Phrases of which sentences are made, each with its meaning.
namespace castor::communication::test {

using Presuppositions = std::vector<oracle::Presupposition>;

/// "Red cube", "thing left of the ball".
struct NounPhrase {
  std::string singular;
  std::string plural;
  oracle::Predicate is;
  Presuppositions needs = {};
};

/// What is said of things: "red", "a cube"; of several, "cubes".
struct Scope {
  std::string singular;
  std::string plural;
  oracle::Predicate is;
  Presuppositions needs = {};
  /// The one thing that others are compared with: of itself nothing is said, neither that it is so
  /// nor that it is not. No thing by default.
  oracle::Predicate landmark = oracle::is_not(oracle::anything());
  /// Neither negated nor several: "not" before it is about all of it.
  bool is_plain = true;
};

/// How many of the things of a noun a scope is said of.
struct Quantifier {
  std::string before;
  bool is_plural = false;
  std::function<oracle::Verdict(const oracle::World&, const oracle::Predicate& noun,
                                const oracle::Predicate& scope)>
    holds;
  std::function<Presuppositions(const NounPhrase&)> needs = [](auto&) { return Presuppositions{}; };
};

// -- what is taken for granted

oracle::Presupposition exactly_one(oracle::Predicate is);
oracle::Presupposition at_least_one(oracle::Predicate is);
oracle::Presupposition exactly_two(oracle::Predicate is);
Presuppositions together(Presuppositions a, const Presuppositions& b);

// -- nouns

/// "Small red cube".
NounPhrase noun(const std::string& words);
NounPhrase with_place(const NounPhrase& of, const Scope& place);
NounPhrase that_is(const NounPhrase& of, const Scope& scope, bool is_so);

// -- scopes

/// A colour or a size.
Scope adjective(const std::string& word);
Scope a_kind(const std::string& words);
Scope no_such(const Scope& x);
Scope and_both(const Scope& a, const Scope& b);
Scope or_one(const Scope& a, const Scope& b);
Scope nor_any(const Scope& a, const Scope& b);

using Relation = std::function<oracle::Verdict(const oracle::Thing&, const oracle::Thing&)>;

/// "Left of the red cube".
Scope related_to_the(const std::string& words, const Relation& relation, const std::string& noun);
/// "Left of a cube", "left of two cubes".
Scope related_to(const std::string& words, const Relation& relation, const Quantifier& quantifier,
                 const std::string& noun);
/// "The largest cube".
Scope the_most(const std::string& words, const oracle::Before& before, const std::string& noun);

// -- quantifiers

Quantifier some(const std::string& before, bool is_plural);
Quantifier none(const std::string& before, bool is_plural);
Quantifier all(const std::string& before, bool is_plural);
Quantifier most(const std::string& before);
Quantifier counted(const std::string& before, bool is_plural, std::size_t least, std::size_t most);
/// The same of things that are there: "two of the cubes".
Quantifier of_the(Quantifier x);

} // namespace castor::communication::test
