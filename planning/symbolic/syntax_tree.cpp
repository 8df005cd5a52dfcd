#include "castor/planning/symbolic/syntax_tree.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace castor::planning {

PddlText::PddlText(std::string file, std::string text)
  : file_(std::move(file)), text_(std::move(text)), words_(text_) {
  line_starts_.push_back(0);
  bool in_comment = false;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    auto& c = words_[i];
    if (c == '\n') {
      line_starts_.push_back(i + 1);
      in_comment = false;
    } else if (c == ';') {
      in_comment = true;
    }
    if (in_comment)
      c = ' ';
    else if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  }
}

std::size_t PddlText::line_number(std::size_t offset) const {
  auto after = std::ranges::upper_bound(line_starts_, offset);
  return static_cast<std::size_t>(after - line_starts_.begin());
}

std::string PddlText::line_of(std::size_t offset) const {
  return "line " + std::to_string(line_number(offset));
}

Diagnostic PddlText::finding(Severity severity, std::size_t offset, std::string message,
                             std::string remedy) const {
  constexpr std::size_t most_shown = 200;
  const auto line = line_number(offset);
  const auto begin = line_starts_[line - 1];
  auto end = text_.find('\n', begin);
  if (end == std::string::npos)
    end = text_.size();
  if (end > begin && text_[end - 1] == '\r')
    --end;
  Diagnostic result;
  result.severity = severity;
  result.where = SourceLocation(file_, line);
  result.line = shorten(std::string_view(text_).substr(begin, end - begin), most_shown);
  result.column = offset - begin + 1;
  result.message = std::move(message);
  result.remedy = std::move(remedy);
  return result;
}

namespace {

/// Sections of a file: each is a list directly within (define ...), so one that stands deeper shows
/// where a parenthesis is missing.
constexpr std::array<std::string_view, 14> section_names{
  ":requirements", ":types",   ":constants", ":predicates",     ":functions",
  ":action",       ":derived", ":objects",   ":init",           ":goal",
  ":metric",       ":domain",  ":sensor",    ":state-variables"};

class SyntaxParser {
public:
  SyntaxParser(const PddlText& text, std::vector<Diagnostic>& problems)
    : text_(text), problems_(problems) {
    // nop
  }

  std::vector<SyntaxNode> parse() {
    const auto words = text_.words();
    std::size_t count = 0;
    for (std::size_t i = 0; i < words.size();) {
      if (is_blank(words[i])) {
        ++i;
        continue;
      }
      if (++count > most_pddl_words) {
        error(i, "the file has more than " + std::to_string(most_pddl_words) + " words",
              "divide the problem into smaller ones");
        return {};
      }
      if (words[i] == '(') {
        if (open_.size() >= most_pddl_depth) {
          error(i,
                "the parentheses are nested more than " + std::to_string(most_pddl_depth) + " deep",
                "write the formula with fewer levels");
          return {};
        }
        SyntaxNode node;
        node.offset = static_cast<std::uint32_t>(i);
        node.is_list = true;
        open_.push_back(std::move(node));
        ++i;
      } else if (words[i] == ')') {
        if (open_.empty())
          error(i, "this parenthesis closes nothing", "remove it");
        else
          close();
        ++i;
      } else {
        const auto begin = i;
        while (i < words.size() && !is_blank(words[i]) && words[i] != '(' && words[i] != ')')
          ++i;
        add_word(words.substr(begin, i - begin), begin);
      }
    }
    if (!open_.empty()) {
      error(open_.back().offset, "the parenthesis that is opened here is not closed",
            "add ')' where the list ends");
      while (!open_.empty())
        close();
    }
    return std::move(top_);
  }

private:
  void error(std::size_t offset, std::string message, std::string remedy) {
    problems_.push_back(
      text_.finding(Severity::error, offset, std::move(message), std::move(remedy)));
  }

  void close() {
    auto node = std::move(open_.back());
    open_.pop_back();
    auto& siblings = open_.empty() ? top_ : open_.back().children;
    siblings.push_back(std::move(node));
  }

  void add_word(std::string_view word, std::size_t offset) {
    if (open_.empty()) {
      error(offset, "the word " + in_quotes(word) + " stands outside of all parentheses",
            "remove it, or begin the file with (define ...");
      return;
    }
    // A section that is deeper than it can be: a list before it was not closed.
    const bool begins_list = open_.back().children.empty();
    if (begins_list && open_.size() > 2 && word.front() == ':' &&
        std::ranges::find(section_names, word) != section_names.end()) {
      auto list = std::move(open_.back());
      open_.pop_back();
      error(open_.back().offset,
            "the parenthesis that is opened here is not closed before the section " +
              in_quotes(word) + " in " + text_.line_of(offset),
            "add ')' where the list ends");
      while (open_.size() > 1)
        close();
      open_.push_back(std::move(list));
    }
    SyntaxNode node;
    node.word = word;
    node.offset = static_cast<std::uint32_t>(offset);
    open_.back().children.push_back(std::move(node));
  }

  const PddlText& text_;
  std::vector<Diagnostic>& problems_;
  std::vector<SyntaxNode> open_;
  std::vector<SyntaxNode> top_;
};

} // namespace

std::vector<SyntaxNode> parse_syntax(const PddlText& text, std::vector<Diagnostic>& problems) {
  if (text.size() > most_pddl_bytes) {
    problems.push_back(
      text.finding(Severity::error, 0,
                   "the file is longer than " + std::to_string(most_pddl_bytes >> 20) + " MiB",
                   "divide the problem into smaller ones"));
    return {};
  }
  return SyntaxParser(text, problems).parse();
}

} // namespace castor::planning
