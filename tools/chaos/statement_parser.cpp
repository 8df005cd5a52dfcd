#include "castor/tools/chaos/statement_parser.hpp"

#include "castor/base/text.hpp"
#include "castor/tools/chaos/fault_parser.hpp"
#include "castor/tools/chaos/fault_words.hpp"
#include "castor/tools/chaos/statement_error.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

#include <map>

namespace castor::faults {

namespace {


Timestamp trigger_time(std::string_view& rest) {
  auto word = take_word(rest);
  auto time = parse_time(word);
  if (!time)
    throw StatementError(word.empty() ? "the time is missing" : in_quotes(word) + " is not a time",
                         std::string{time_remedy});
  return *time;
}

Trigger at_trigger(std::string_view& rest) {
  return At{trigger_time(rest)};
}

Trigger every_trigger(std::string_view& rest) {
  auto period = trigger_time(rest);
  if (period < std::chrono::milliseconds{1})
    throw StatementError("nothing can happen every " + to_text(period),
                         "write a period of at least 1ms");
  return Every{period};
}

Trigger rate_trigger(std::string_view& rest) {
  auto word = take_word(rest);
  auto rate = parse_rate(word);
  if (!rate)
    throw StatementError(word.empty() ? "the rate is missing" : in_quotes(word) + " is not a rate",
                         std::string{rate_remedy});
  return AtRandom{*rate};
}

/// Reads a number at the beginning, if there is one.
std::optional<std::uint32_t> take_count(std::string_view& rest) {
  auto behind = rest;
  auto word = take_word(behind);
  if (word.empty() || !is_digit(word.front()))
    return std::nullopt;
  auto count = parse_whole<std::uint32_t>(word);
  if (!count || *count == 0)
    throw StatementError(in_quotes(word) + " is not a number of changes",
                         "write after FILTER: FAULT, or after 3 FILTER: FAULT");
  rest = behind;
  return count;
}

Trigger after_trigger(std::string_view& rest) {
  After result;
  auto end = end_of_filter(rest);
  if (end == rest.size())
    throw StatementError("the change filter has no end", "write after FILTER: FAULT");
  auto filter = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  auto behind = filter;
  if (take_word(behind) == "every") {
    auto count = take_count(behind);
    if (!count)
      throw StatementError("every how many changes is missing",
                           "write after every 3 FILTER: FAULT");
    result.repeated = true;
    result.count = *count;
    filter = behind;
  } else if (auto count = take_count(filter)) {
    result.count = *count;
  }
  try {
    result.filter = parse_change_filter(filter);
  } catch (const ChangeFilterError& e) {
    throw StatementError(e.what(), "for instance: after overwritten SceneObject in vision: FAULT");
  }
  return result;
}

using TriggerReader = Trigger (*)(std::string_view&);

const std::map<std::string_view, TriggerReader> triggers{
  {"at", at_trigger}, {"every", every_trigger}, {"rate", rate_trigger}, {"after", after_trigger}};

} // namespace

Trigger parse_trigger(std::string_view& rest) {
  auto word = take_word(rest);
  auto reader = triggers.find(word);
  if (reader == triggers.end())
    throw StatementError(in_quotes(word) + " does not say when something is to happen",
                         remedy_for(word, {"at", "every", "rate", "after", "seed"},
                                    "write at TIME, every TIME, rate NUMBER/s or after FILTER: "
                                    "before the fault"));
  return reader->second(rest);
}

std::optional<std::uint64_t> parse_seed(std::string_view line) {
  if (take_word(line) != "seed")
    return std::nullopt;
  auto word = take_word(line);
  auto rest = trim(line);
  auto seed = parse_whole<std::uint64_t>(word);
  if (!seed || (!rest.empty() && rest.front() != '#'))
    throw StatementError("the seed is not one whole number", "write seed 42");
  return seed;
}

Statement parse_statement(std::string_view line) {
  Statement result;
  result.trigger = parse_trigger(line);
  result.faults = parse_faults(line);
  return result;
}

} // namespace castor::faults
