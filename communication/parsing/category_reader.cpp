#include "castor/communication/parsing/category_reader.hpp"

#include <algorithm>
#include <cctype>

namespace castor::communication {

namespace {

/// Deeper nesting than any category has.
constexpr int max_category_depth = 20;

class CategoryReader {
public:
  CategoryReader(std::string_view text, const FeatureDeclarations& declarations,
                 SymbolTable& symbols)
    : text_(text), declarations_(declarations), symbols_(symbols) {
    // nop
  }

  IndexedCategory read() {
    result_.category = read_category(0);
    skip_blanks();
    if (at_ < text_.size())
      fail("this does not belong to a category", "A slash joins two categories: s\\np.");
    return std::move(result_);
  }

private:
  [[noreturn]] void fail(const std::string& message, const std::string& remedy) {
    throw CategoryError(message, remedy, at_);
  }

  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ')
      ++at_;
  }

  bool accept(char c) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != c)
      return false;
    ++at_;
    return true;
  }

  std::string read_name(const std::string& what) {
    skip_blanks();
    const auto begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '-'))
      ++at_;
    if (begin == at_)
      fail("expected " + what, "Names are made of letters, digits and hyphens.");
    return std::string(text_.substr(begin, at_ - begin));
  }

  Category read_category(int depth) {
    if (depth > max_category_depth)
      fail("this category is nested too deeply", "Leave out some parentheses.");
    auto category = read_primary(depth);
    for (;;) {
      SlashDirection direction{};
      if (accept('/'))
        direction = SlashDirection::forward;
      else if (accept('\\'))
        direction = SlashDirection::backward;
      else
        return category;
      auto mode = SlashMode::composition;
      if (accept('*'))
        mode = SlashMode::application;
      else if (accept('+'))
        mode = SlashMode::crossed;
      category.arguments.push_back({direction, mode, read_primary(depth)});
    }
  }

  Category read_primary(int depth) {
    if (!accept('('))
      return {read_atom(), {}};
    auto category = read_category(depth + 1);
    if (!accept(')'))
      fail("a parenthesis is not closed", "Add \")\".");
    return category;
  }

  AtomicCategory read_atom() {
    AtomicCategory atom;
    atom.name = symbols_.intern(read_name("a category"));
    if (accept('[')) {
      do
        read_feature(atom);
      while (accept(','));
      if (!accept(']'))
        fail("a bracket is not closed", "Add \"]\".");
    }
    std::string index;
    if (accept('<')) {
      index = read_name("a variable");
      if (!accept('>'))
        fail("a variable is not closed", "Add \">\".");
    }
    result_.indices.push_back(std::move(index));
    return atom;
  }

  void read_feature(AtomicCategory& atom) {
    skip_blanks();
    const auto begin = at_;
    const auto count = declarations_.features.size();
    if (accept('?')) {
      const auto name = read_name("a feature");
      auto bare = name;
      while (!bare.empty() && std::isdigit(static_cast<unsigned char>(bare.back())) != 0)
        bare.pop_back();
      const auto place = declarations_.find(bare);
      if (place == count) {
        at_ = begin;
        fail("there is no feature \"" + bare + "\"", "Declare it: feature " + bare + " VALUE...");
      }
      const auto variable = -static_cast<FeatureValue>(result_.feature_variables.size()) - 1;
      atom.features[place] = result_.feature_variables.emplace("?" + name, variable).first->second;
      return;
    }
    const auto value = read_name("the value of a feature");
    const auto place = declarations_.find_value(value);
    if (place == count) {
      at_ = begin;
      fail("no feature has the value \"" + value + "\"",
           "Add it to a line that begins with \"feature\".");
    }
    atom.features[place] = static_cast<FeatureValue>(symbols_.intern(value));
  }

  std::string_view text_;
  const FeatureDeclarations& declarations_;
  SymbolTable& symbols_;
  std::size_t at_ = 0;
  IndexedCategory result_;
};

} // namespace

std::size_t FeatureDeclarations::find(std::string_view name) const {
  const auto place = std::find_if(features.begin(), features.end(),
                                  [name](const Feature& feature) { return feature.name == name; });
  return static_cast<std::size_t>(place - features.begin());
}

std::size_t FeatureDeclarations::find_value(std::string_view value) const {
  const auto place =
    std::find_if(features.begin(), features.end(), [value](const Feature& feature) {
      return std::find(feature.values.begin(), feature.values.end(), value) != feature.values.end();
    });
  return static_cast<std::size_t>(place - features.begin());
}

IndexedCategory parse_category(std::string_view text, const FeatureDeclarations& declarations,
                               SymbolTable& symbols) {
  return CategoryReader(text, declarations, symbols).read();
}

} // namespace castor::communication
