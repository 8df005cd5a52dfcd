#include "castor/actors/cast/keywords.hpp"

#include "castor/base/text.hpp"

#include <array>

namespace castor::cast {

namespace {

enum class Matching { by_prefix, whole_word };

template <class Keyword>
struct Rule {
  Keyword keyword;
  std::string_view word;
  Matching matching = Matching::by_prefix;
};

constexpr std::array section_rules{
  Rule<SectionKeyword>{SectionKeyword::subarchitecture, "SUBARCHITECTURE"},
  Rule<SectionKeyword>{SectionKeyword::architecture, "ARCHITECTURE"},
  Rule<SectionKeyword>{SectionKeyword::host, "HOST"},
  Rule<SectionKeyword>{SectionKeyword::connection, "CONNECTION"},
  Rule<SectionKeyword>{SectionKeyword::component, "COMPONENT"},
  Rule<SectionKeyword>{SectionKeyword::access, "ACCESS", Matching::whole_word},
  Rule<SectionKeyword>{SectionKeyword::supervise, "SUPERVISE", Matching::whole_word},
  Rule<SectionKeyword>{SectionKeyword::failover, "FAILOVER", Matching::whole_word},
};

constexpr std::array variable_rules{
  Rule<VariableCommand>{VariableCommand::set, "SETVAR"},
  Rule<VariableCommand>{VariableCommand::set_default, "VARDEFAULT"},
  Rule<VariableCommand>{VariableCommand::set_options, "SETOPT"},
  Rule<VariableCommand>{VariableCommand::default_options, "OPTDEFAULT"},
};

constexpr std::array directive_rules{
  Rule<Directive>{Directive::if_equal, "IFEQ"},
  Rule<Directive>{Directive::if_not_equal, "IFNEQ"},
  Rule<Directive>{Directive::if_true, "IFTRUE"},
  Rule<Directive>{Directive::if_false, "IFFALSE"},
  Rule<Directive>{Directive::if_any_option, "IFOPTANY"},
  Rule<Directive>{Directive::if_all_options, "IFOPTALL"},
  Rule<Directive>{Directive::otherwise, "ELSE"},
  Rule<Directive>{Directive::end, "ENDIF"},
};

template <class Rules>
auto match(const Rules& rules, std::string_view line) noexcept
  -> std::optional<KeywordMatch<decltype(rules.front().keyword)>> {
  for (const auto& rule : rules) {
    if (!line.starts_with(rule.word))
      continue;
    auto glued = line.size() > rule.word.size() && !is_blank(line[rule.word.size()]);
    if (rule.matching == Matching::by_prefix || !glued)
      return {{rule.keyword, rule.word, glued}};
  }
  return std::nullopt;
}

} // namespace

std::optional<KeywordMatch<SectionKeyword>> match_section_keyword(std::string_view line) noexcept {
  if (line.starts_with(host_name_keyword))
    return std::nullopt;
  auto result = match(section_rules, line);
  if (!result || result->keyword < SectionKeyword::access)
    return result;
  // A component line may begin with the name of a host that happens to be called like a keyword
  // which the language did not always have.
  auto rest = line.substr(result->word.size());
  if (match_language(take_word(rest)))
    return std::nullopt;
  return result;
}

std::optional<KeywordMatch<VariableCommand>>
match_variable_command(std::string_view line) noexcept {
  return match(variable_rules, line);
}

std::optional<KeywordMatch<Directive>> match_directive(std::string_view line) noexcept {
  return match(directive_rules, line);
}

std::optional<Language> match_language(std::string_view word) noexcept {
  if (word == "CPP")
    return Language::cpp;
  if (word == "JAVA")
    return Language::java;
  if (word == "PYTHON")
    return Language::python;
  return std::nullopt;
}

std::optional<ComponentKind> match_kind(std::string_view word) noexcept {
  if (word == "WM")
    return ComponentKind::working_memory;
  if (word == "TM")
    return ComponentKind::task_manager;
  if (word == "MG" || word == "GD")
    return ComponentKind::managed;
  if (word == "UM" || word == "DD")
    return ComponentKind::unmanaged;
  return std::nullopt;
}

const std::vector<std::string_view>& all_line_keywords() {
  static const std::vector<std::string_view> words = [] {
    std::vector<std::string_view> result{include_keyword, host_name_keyword};
    for (const auto& rule : section_rules)
      result.push_back(rule.word);
    for (const auto& rule : variable_rules)
      result.push_back(rule.word);
    for (const auto& rule : directive_rules)
      result.push_back(rule.word);
    return result;
  }();
  return words;
}

} // namespace castor::cast
