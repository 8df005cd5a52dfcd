#pragma once

#include "castor/communication/parsing/category.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

/// The features that categories can have, and their values.
struct FeatureDeclarations {
  struct Feature {
    std::string name;
    std::vector<std::string> values;
  };
  std::vector<Feature> features;

  /// Index of a feature; the number of features if there is none of that name.
  std::size_t find(std::string_view name) const;
  /// Index of the feature with this value; the number of features if none has it.
  std::size_t find_value(std::string_view value) const;
};

/// A category and the names of the variables of its atoms, in its order; empty for those that have
/// none.
struct IndexedCategory {
  Category category;
  std::vector<std::string> indices;
  /// "?number" and the like, and the variable that each is.
  std::map<std::string, FeatureValue> feature_variables;
};

/// A syntax error in a category.
class CategoryError : public std::runtime_error {
public:
  CategoryError(const std::string& message, const std::string& remedy, std::size_t offset)
    : std::runtime_error(message), remedy_(remedy), offset_(offset) {
    // nop
  }

  const std::string& remedy() const { return remedy_; }
  /// In bytes from the beginning of the text.
  std::size_t offset() const { return offset_; }

private:
  std::string remedy_;
  std::size_t offset_;
};

/// Parses a category such as (s[dcl]<e>\np[?number]<x>)/np<y>.
/// \throws CategoryError
IndexedCategory parse_category(std::string_view text, const FeatureDeclarations& declarations,
                               SymbolTable& symbols);

} // namespace castor::communication
