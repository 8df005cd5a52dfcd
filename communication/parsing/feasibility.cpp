#include "castor/communication/parsing/feasibility.hpp"

#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

bool is_negation(const std::string& word) {
  return is_among(word, {"not", "n't", "no", "never", "insufficient"});
}

/// What is possible where it is so, and impossible where it is not.
bool is_feasible(const std::string& word) {
  return is_among(word, {"possible", "work", "works", "worked", "fit", "fits", "room", "space",
                         "able", "free", "manage", "succeed", "feasible", "succeeds", "reachable",
                         "enough", "clear", "doable"});
}

bool is_infeasible(const std::string& word) {
  return is_among(word, {"impossible", "occupied", "taken", "fails", "full", "unreachable",
                         "blocked", "failing", "fail", "failed"});
}

/// "If you cannot", "if you cannot reach it".
bool is_of_ability(const WordList& words) {
  const auto can = std::ranges::find_if(words, [](const auto& x) {
    return is_among(x, {"can", "could", "ca"});
  });
  return can != words.end() && std::ranges::all_of(can + 1, words.end(), [](const auto& x) {
           return is_negation(x) ||
                  is_among(x, {"do",   "reach", "put",    "place", "fit",     "get", "go",
                               "move", "it",    "that",   "this",  "there",   "be",  "done",
                               "so",   "them",  "safely", "stack", "balance", "make"});
         });
}

} // namespace

bool says_it_fails(const WordList& words) {
  const bool is_negated = std::ranges::any_of(words, is_negation);
  if (!is_negated)
    return std::ranges::any_of(words, is_infeasible);
  return std::ranges::any_of(words, is_feasible) || is_of_ability(words);
}

bool says_it_succeeds(const WordList& words) {
  const bool is_about_it = std::ranges::any_of(words, is_feasible) || is_of_ability(words);
  return is_about_it && std::ranges::all_of(words, [](const auto& x) {
           return !is_negation(x) &&
                  (is_feasible(x) ||
                   is_among(x, {"there",  "is",   "'s",    "for",     "it",    "that", "this",
                                "you",    "can",  "could", "at",      "all",   "do",   "the",
                                "place",  "spot", "still", "somehow", "reach", "are",  "be",
                                "should", "them", "to",    "both",    "so"}));
         });
}

} // namespace castor::communication
