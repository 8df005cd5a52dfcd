#pragma once

#include "castor/communication/parsing/category_reader.hpp"
#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/types.hpp"

#include <string>
#include <vector>

namespace castor::communication {

/// One line of a lexical family: a category and meaning of each of its words.
struct FamilyEntry {
  IndexedCategory category;
  /// Its nominals are the variables; `*` is the word's predicate.
  LogicalForm meaning;
  double weight = 0;
};

struct Family {
  std::string name;
  std::vector<FamilyEntry> entries;
};

/// A word or phrase of a family.
struct FamilyWord {
  std::string phrase;
  std::string predicate;
  double weight = 0;
  /// The values of features that the word has.
  std::vector<std::string> features;
};

/// Adds the entries of a word to a lexicon. A feature of `word` applies to categories with a
/// variable for it.
void add_word(const Family& family, const FamilyWord& word, const FeatureDeclarations& declarations,
              Lexicon& lexicon);

/// The regular plural: boxes, cherries, balls.
std::string plural_of(const std::string& singular);

} // namespace castor::communication
