#pragma once

#include "castor/base/diagnostic.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// The parentheses and words of a PDDL file, before they mean anything.
namespace castor::planning {

/// Limits of a file, beyond which it is refused with a message.
inline constexpr std::size_t most_pddl_bytes = std::size_t{32} << 20;
inline constexpr std::size_t most_pddl_words = std::size_t{4} << 20;
inline constexpr std::size_t most_pddl_depth = 200;

/// The text of a file: a node's offset becomes a line and a column. Comments are blanks in `words`,
/// and all letters are lower case, so both texts have the same offsets.
class PddlText {
public:
  PddlText(std::string file, std::string text);

  const std::string& file() const { return file_; }
  std::string_view words() const { return words_; }
  std::size_t size() const { return text_.size(); }

  /// A finding at the offset.
  Diagnostic finding(Severity severity, std::size_t offset, std::string message,
                     std::string remedy) const;

  /// "line 12".
  std::string line_of(std::size_t offset) const;

private:
  std::size_t line_number(std::size_t offset) const;

  std::string file_;
  std::string text_;
  std::string words_;
  std::vector<std::size_t> line_starts_;
};

/// A word, or a list of nodes in parentheses.
struct SyntaxNode {
  /// Of a word; a part of `PddlText::words`.
  std::string_view word;
  std::vector<SyntaxNode> children;
  std::uint32_t offset = 0;
  bool is_list = false;

  /// The word that a list begins with; empty if it does not begin with one.
  std::string_view head() const {
    return is_list && !children.empty() && !children.front().is_list ? children.front().word
                                                                     : std::string_view{};
  }
};

/// The lists of a file. Missing and surplus parentheses are added to `problems`.
std::vector<SyntaxNode> parse_syntax(const PddlText& text, std::vector<Diagnostic>& problems);

} // namespace castor::planning
