#include "castor/base/ontology_reader.hpp"

#include "castor/base/suggestion.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace castor {

namespace {

/// Longer files are no ontologies.
constexpr std::size_t max_bytes = std::size_t{1} << 20;

const std::vector<std::string_view> keywords = {"concept", "disjoint", "partition", "alike"};

/// A line of a file, for findings.
struct Line {
  const std::string* file;
  std::size_t number;
  std::string text;
};

/// The words of a line; ":" and "," are words of their own.
std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> result;
  bool is_in_word = false;
  for (const char x : line.substr(0, line.find('#'))) {
    const bool is_mark = x == ':' || x == ',';
    if (x == ' ' || x == '\t' || x == '\r' || is_mark)
      is_in_word = false;
    else if (is_in_word)
      result.back() += x;
    else {
      result.emplace_back(1, x);
      is_in_word = true;
    }
    if (is_mark)
      result.emplace_back(1, x);
  }
  return result;
}

class OntologyReader {
public:
  OntologyText read(std::span<const NamedText> files) {
    for (auto& file : files)
      read_file(file);
    for (auto& [name, line] : related_)
      if (!concepts_.contains(name)) {
        const auto meant = did_you_mean(name, {concepts_.begin(), concepts_.end()});
        report(line, name, '"' + name + "\" is no concept",
               meant.empty() ? "State what it is: concept " + name : meant);
      }
    std::vector<OntologyProblem> problems;
    if (problems_.empty()) {
      const Ontology checked{statements_, &problems};
      for (auto& x : problems)
        report(origins_[x.statement], x.word, x.message, x.remedy);
    }
    if (!problems_.empty())
      statements_.clear();
    return {std::move(statements_), std::move(problems_)};
  }

private:
  using Words = std::vector<std::string>;

  void read_file(const NamedText& file) {
    if (file.text.size() > max_bytes) {
      report({&file.name, 0, {}}, {}, "this is longer than 1 MiB", "Give the name of an ontology.");
      return;
    }
    std::string_view rest = file.text;
    for (std::size_t number = 1; !rest.empty(); ++number) {
      const auto end = std::min(rest.find('\n'), rest.size());
      line_ = {&file.name, number, std::string{rest.substr(0, end)}};
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (const auto words = words_of(line_.text); !words.empty())
        read_line(words);
    }
  }

  void read_line(const Words& words) {
    const auto& keyword = words.front();
    const Words said(words.begin() + 1, words.end());
    if (std::ranges::find(keywords, keyword) == keywords.end()) {
      const auto meant = did_you_mean(keyword, keywords);
      report(line_, keyword, '"' + keyword + "\" does not begin a line",
             meant.empty() ? "Lines begin with concept, disjoint, partition or alike." : meant);
    } else if (keyword == "concept")
      read_concepts(said);
    else if (has_only_names(said))
      relate(keyword, said);
  }

  /// Reports marks among names, and their absence.
  bool has_only_names(const Words& words) {
    const auto mark = std::ranges::find_if(words, [](auto& x) { return x == ":" || x == ","; });
    if (mark != words.end())
      report(line_, *mark, '"' + *mark + "\" stands where a concept is expected",
             "Separate the concepts by blanks.");
    else if (words.empty())
      report(line_, {}, "the line names no concept", "Write concepts after the first word.");
    return mark == words.end() && !words.empty();
  }

  /// "kitchen office: room, place with size large".
  void read_concepts(const Words& words) {
    const auto colon = std::ranges::find(words, ":");
    const Words names(words.begin(), colon);
    if (!has_only_names(names))
      return;
    ConceptStatement statement;
    if (colon != words.end() && !read_kinds({colon + 1, words.end()}, statement))
      return;
    for (auto& name : names) {
      statement.name = name;
      concepts_.insert(name);
      add(statement);
    }
  }

  bool read_kinds(const Words& words, ConceptStatement& statement) {
    const auto with = std::ranges::find(words, "with");
    bool is_name_expected = true;
    for (auto word = words.begin(); word != with; ++word) {
      const bool is_comma = *word == ",";
      if (is_comma == is_name_expected || *word == ":") {
        report(line_, *word,
               is_name_expected ? "a kind is missing before \"" + *word + '"'
                                : '"' + *word + "\" does not follow a comma",
               "Separate kinds by commas: kitchen: room, place");
        return false;
      }
      if (!is_comma)
        statement.is_a.push_back(*word);
      is_name_expected = is_comma;
    }
    if (is_name_expected) {
      report(line_, {}, "a kind is missing", "Write one: kitchen: room");
      return false;
    }
    return with == words.end() || read_properties({with + 1, words.end()}, statement);
  }

  bool read_properties(const Words& words, ConceptStatement& statement) {
    if (words.empty() || words.size() % 2 != 0) {
      report(line_, "with", "a property has no value", "Write both: ball: thing with shape sphere");
      return false;
    }
    for (std::size_t i = 0; i < words.size(); i += 2)
      statement.defined_by.push_back({words[i], words[i + 1]});
    return true;
  }

  void relate(const std::string& keyword, const Words& names) {
    if (keyword != "partition" && names.size() < 2) {
      report(line_, names.front(), '"' + keyword + "\" takes several concepts",
             "Name another one, or remove the line.");
      return;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      ConceptStatement statement;
      statement.name = names[i];
      const Words others(names.begin() + static_cast<std::ptrdiff_t>(i) + 1, names.end());
      if (keyword == "partition")
        statement.is_partitioned = true;
      else if (keyword == "disjoint")
        statement.disjoint_with = others;
      else if (i == 0)
        statement.alike = others;
      if (keyword != "alike")
        related_.emplace_back(names[i], line_);
      if (keyword == "partition" || !others.empty())
        add(statement);
      if (keyword == "alike")
        break;
    }
  }

  void add(const ConceptStatement& statement) {
    statements_.push_back(statement);
    origins_.push_back(line_);
  }

  void report(const Line& line, std::string_view word, const std::string& message,
              const std::string& remedy) {
    Diagnostic found;
    found.where = {*line.file, line.number};
    found.line = line.text;
    if (const auto column = line.text.find(word); !word.empty() && column != std::string::npos)
      found.column = column + 1;
    found.message = message;
    found.remedy = remedy;
    problems_.push_back(std::move(found));
  }

  Line line_{};
  std::vector<ConceptStatement> statements_;
  /// The line of each statement.
  std::vector<Line> origins_;
  std::set<std::string, std::less<>> concepts_;
  /// Concepts that are said to exclude others, with their lines.
  std::vector<std::pair<std::string, Line>> related_;
  std::vector<Diagnostic> problems_;
};

} // namespace

OntologyText read_ontology(std::span<const NamedText> files) {
  return OntologyReader{}.read(files);
}

} // namespace castor
