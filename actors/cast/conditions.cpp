#include "castor/actors/cast/conditions.hpp"

#include "castor/actors/cast/option_flags.hpp"
#include "castor/base/text.hpp"

#include <utility>

namespace castor::cast {

namespace {

constexpr std::string_view true_words = ".true.yes.on.1.2.3.4.5.6.7.8.9.";
constexpr std::string_view false_words = ".false.no.off.0..";
constexpr std::string_view truth_remedy = "write true, yes, on or 1, or false, no, off or 0";

ConditionResult failure(std::string problem, std::string remedy) {
  return {std::nullopt, std::move(problem), std::move(remedy)};
}

std::string usage(std::string_view word) {
  std::string example(word);
  if (word.starts_with("IFOPT"))
    return "write " + example + "(%(name), flag !other)";
  if (word == "IFEQ" || word == "IFNEQ")
    return "write " + example + "(%(name), value)";
  return "write " + example + "(%(name))";
}

/// Whether a comment with a closing parenthesis of its own has become part of the parameters.
bool reaches_into_comment(std::string_view parameters) noexcept {
  for (auto close = parameters.find(')'); close != std::string_view::npos;
       close = parameters.find(')', close + 1)) {
    auto next = parameters.find_first_not_of(" \t", close + 1);
    if (next != std::string_view::npos && parameters[next] == '#')
      return true;
  }
  return false;
}

/// A remark about what stands around the parameters, if it does not do what it seems to.
std::string surprise_around(std::string_view before, std::string_view parameters,
                            std::string_view after) {
  if (reaches_into_comment(parameters))
    return "the parameters reach to the last closing parenthesis of the line, comments included";
  if (!trim(before).empty())
    return in_quotes(trim(before)) + " before the parameters is ignored";
  if (after = trim(after); !after.empty() && after.front() != '#')
    return in_quotes(after) + " behind the parameters is ignored";
  return {};
}

} // namespace

ConditionResult evaluate_truth(std::string_view text) {
  auto value = lower_case(trim(text));
  auto is_exact = value.find('.') == std::string::npos;
  auto listed = "." + value + ".";
  std::optional<bool> result;
  if (true_words.find(listed) != std::string_view::npos)
    result = true;
  else if (false_words.find(listed) != std::string_view::npos)
    result = false;
  if (!result)
    return failure(in_quotes(text) + " is neither true nor false", std::string(truth_remedy));
  if (is_exact)
    return {result, {}, {}};
  return {result, in_quotes(text) + " is taken for " + (*result ? "true" : "false"),
          std::string(truth_remedy)};
}

ConditionResult evaluate_condition(const KeywordMatch<Directive>& directive, std::string_view line,
                                   const Expander& expand) {
  auto open = line.find('(');
  auto close = line.rfind(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open)
    return failure(std::string(directive.word) + " needs parameters in parentheses",
                   usage(directive.word));
  auto parameters = trim(line.substr(open + 1, close - open - 1));
  auto surprise = surprise_around(line.substr(directive.word.size(), open - directive.word.size()),
                                  parameters, line.substr(close + 1));
  auto too_long = [] { return failure({}, {}); };
  auto result = [&](bool value) -> ConditionResult { return {value, surprise, {}}; };
  if (directive.keyword == Directive::if_true || directive.keyword == Directive::if_false) {
    auto text = expand(parameters);
    if (!text)
      return too_long();
    auto truth = evaluate_truth(*text);
    if (truth.value && directive.keyword == Directive::if_false)
      truth.value = !*truth.value;
    if (truth.problem.empty())
      truth.problem = surprise;
    return truth;
  }
  auto comma = parameters.find(',');
  if (comma == std::string_view::npos)
    return failure(std::string(directive.word) + " needs two parameters with a comma between them",
                   usage(directive.word));
  auto first = expand(trim(parameters.substr(0, comma)));
  auto second = expand(trim(parameters.substr(comma + 1)));
  if (!first || !second)
    return too_long();
  switch (directive.keyword) {
    case Directive::if_equal:
      return result(*first == *second);
    case Directive::if_not_equal:
      return result(*first != *second);
    case Directive::if_any_option:
      return result(matches_any_flag(*first, *second));
    default:
      return result(matches_all_flags(*first, *second));
  }
}

void ConditionStack::open(const SourceLine& line, bool enabled) {
  blocks_.push_back({&line, enabled, false});
  disabled_count_ += enabled ? 0 : 1;
}

ConditionStack::Outcome ConditionStack::otherwise() {
  if (blocks_.empty())
    return Outcome::no_block_open;
  auto& block = blocks_.back();
  if (block.has_else)
    return Outcome::second_else;
  if (block.enabled)
    ++disabled_count_;
  else
    --disabled_count_;
  block.enabled = !block.enabled;
  block.has_else = true;
  return Outcome::done;
}

ConditionStack::Outcome ConditionStack::close() {
  if (blocks_.empty())
    return Outcome::no_block_open;
  if (!blocks_.back().enabled)
    --disabled_count_;
  blocks_.pop_back();
  return Outcome::done;
}

std::vector<const SourceLine*> ConditionStack::open_lines() const {
  std::vector<const SourceLine*> lines;
  for (const auto& block : blocks_)
    lines.push_back(block.line);
  return lines;
}

} // namespace castor::cast
