#pragma once

#include "castor/tests/communication/grid_fillers.hpp"
#include "castor/tests/communication/question_grid.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace castor::communication::test {

std::string replaced(std::string text, const std::string& what, const std::string& by);

// -- claims

oracle::Claim there_is(const oracle::Predicate& is, std::size_t least = 1, std::size_t most = 1000);
oracle::Claim not_so(const oracle::Claim& x);
oracle::Claim both_so(const oracle::Claim& a, const oracle::Claim& b);
oracle::Claim either_so(const oracle::Claim& a, const oracle::Claim& b);

/// Fills forms in. In them, N and Ns are nouns, P is what is said of one thing, Ps of several.
class GridMaker {
public:
  std::vector<GridSentence> sentences;

  /// What is so or not, asked and stated (grid_claims.cpp).
  void claims();

  /// Which things, how many, and what they are like (grid_questions.cpp).
  void open_questions();

  /// That there is something, stated (grid_claims.cpp).
  void statements_of_existence();

private:
  using Kind = GridSentence::Kind;

  void existence();
  void existence_of_several();
  void indefinite_pronouns();
  void definite_subjects();
  void quantified_subjects();
  void several_subjects();
  void things_asked_for();
  void numbers_asked_for();
  void qualities_asked_for();

  void add(Kind kind, const std::string& form, const std::string& text, Presuppositions needs,
           oracle::Claim claim, oracle::Predicate asked = {});

  /// The quantifier's words are <Q>.
  void add_quantified(Kind kind, const std::string& form, const Quantifier& q, const NounPhrase& n,
                      const Scope& p);

  static std::string fill(std::string form, const NounPhrase& n, const Scope* p = nullptr);
  static bool is_about_itself(const oracle::World& world, const NounPhrase& n, const Scope& p);
  void odd_if_any(const oracle::Predicate& is);

  /// Nothing is said of landmarks, if there is something else.
  static oracle::Predicate domain(const oracle::World& world, const NounPhrase& n, const Scope& p);
};

} // namespace castor::communication::test
