#include "castor/tools/cli/usage_errors.hpp"

#include "castor/base/suggestion.hpp"

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string_view>
#include <vector>

namespace castor::cli {

namespace {

using Names = std::vector<std::string>;

/// The command that the line is about: "castor", "castor wm", "castor wm get".
struct ChosenCommand {
  const CLI::App* app;
  std::string name;
};

ChosenCommand command_of(const CLI::App& app) {
  ChosenCommand result{&app, "castor"};
  for (;;) {
    auto chosen = result.app->get_subcommands();
    if (chosen.empty())
      return result;
    result.app = chosen.front();
    result.name += ' ' + result.app->get_name();
  }
}

/// Those of the command and of all that it is a part of: they may stand behind it, too.
std::vector<const CLI::Option*> options_of(const ChosenCommand& command) {
  std::vector<const CLI::Option*> result;
  for (auto* app = command.app; app; app = app->get_parent())
    for (auto* x : app->get_options())
      result.push_back(x);
  return result;
}

Names names_of(const CLI::Option& option) {
  Names result;
  for (auto& x : option.get_lnames())
    result.push_back("--" + x);
  for (auto& x : option.get_snames())
    result.push_back('-' + x);
  return result;
}

Names commands_of(const CLI::App& app) {
  Names result;
  for (auto* x : app.get_subcommands([](const CLI::App*) { return true; }))
    // Those without a group are not for people.
    if (!x->get_name().empty() && !x->get_group().empty())
      result.push_back(x->get_name());
  return result;
}

std::string nearest_of(std::string_view word, const Names& names) {
  return std::string{nearest(word, {names.begin(), names.end()})};
}

std::string unknown_option(const ChosenCommand& command, const std::string& word) {
  auto name = word.substr(0, word.find('='));
  Names known;
  for (auto* x : options_of(command))
    for (auto& y : names_of(*x))
      known.push_back(y);
  // Dashes do not make names alike.
  Names bare;
  for (auto& x : known)
    bare.push_back(x.substr(x.find_first_not_of('-')));
  auto letters = name.find_first_not_of('-');
  auto guess = letters == name.npos ? std::string{} : nearest_of(name.substr(letters), bare);
  if (letters != name.npos && guess.empty() && std::ranges::count(bare, name.substr(letters)) > 0)
    guess = name.substr(letters);
  auto text = fmt::format("{}: there is no option {}; ", command.name, name);
  if (guess.empty())
    return text + fmt::format("`{} --help` lists the options", command.name);
  auto found = known.at(static_cast<std::size_t>(std::ranges::find(bare, guess) - bare.begin()));
  return text + fmt::format("did you mean {}?", found);
}

std::string unknown_command(const ChosenCommand& command, const std::string& word) {
  auto names = commands_of(*command.app);
  auto text = fmt::format("there is no command `{} {}`; ", command.name, word);
  if (auto guess = nearest_of(word, names); !guess.empty())
    return text + fmt::format("did you mean `{} {}`?", command.name, guess);
  if (word == "help")
    return text + fmt::format("`{0} --help` and `{0} COMMAND --help` help", command.name);
  if (!command.app->get_parent() && word.ends_with(".cast"))
    return text + fmt::format("write `castor run {}` to run the system of a file", word);
  return text + fmt::format("the commands are: {}", fmt::join(names, ", "));
}

/// "FILE", "FILE [FILTER...]": what a command takes besides options.
std::string positionals_of(const CLI::App& app) {
  Names result;
  for (auto* x : app.get_options())
    if (x->get_positional() && !x->get_name(true).empty())
      result.push_back(x->get_name(true) + (x->get_items_expected_max() > 1 ? "..." : ""));
  return fmt::format("{}", fmt::join(result, " "));
}

std::string unexpected_argument(const ChosenCommand& command, const std::string& word) {
  auto takes = positionals_of(*command.app);
  return fmt::format("{}: the argument {} is one too many; {}", command.name, word,
                     takes.empty()
                       ? "the command takes options only"
                       : "the command takes " + takes + " only; put names with blanks into quotes");
}

std::string something_missing(const ChosenCommand& command) {
  auto names = commands_of(*command.app);
  if (!names.empty())
    return fmt::format("{} needs a command: {}; `{} --help` says what they do", command.name,
                       fmt::join(names, ", "), command.name);
  for (auto* x : options_of(command))
    if (x->get_required() && x->count() == 0) {
      auto name = x->get_positional() ? x->get_name(true) : names_of(*x).front();
      return fmt::format("{}: {} is missing: {}; write `{} {}`", command.name, name,
                         x->get_description(), command.name,
                         x->get_positional() ? positionals_of(*command.app)
                                             : name + ' ' + x->get_type_name());
    }
  return {};
}

/// The option that a message of CLI11 begins with.
const CLI::Option* option_of(const ChosenCommand& command, std::string_view message) {
  const CLI::Option* result = nullptr;
  std::size_t longest = 0;
  for (auto* x : options_of(command)) {
    auto names = names_of(*x);
    if (x->get_positional())
      names.push_back(x->get_name(true));
    for (auto& name : names)
      if (name.size() > longest && message.find(name) != message.npos) {
        result = x;
        longest = name.size();
      }
  }
  return result;
}

std::string name_of(const CLI::Option& x) {
  auto names = names_of(x);
  return names.empty() ? x.get_name(true) : names.front();
}

/// An option that was written more often than it may be.
const CLI::Option* repeated(const ChosenCommand& command) {
  for (auto* x : options_of(command))
    if (x->get_multi_option_policy() != CLI::MultiOptionPolicy::TakeAll &&
        static_cast<int>(x->results().size()) > x->get_items_expected_max() &&
        x->get_items_expected_max() > 0)
      return x;
  return nullptr;
}

std::string wrong_count(const ChosenCommand& command, const std::string& message) {
  if (auto* x = repeated(command))
    return fmt::format("{}: {} is written {} times; write it once", command.name, name_of(*x),
                       x->results().size());
  auto* x = option_of(command, message);
  if (!x)
    return fmt::format("{}: {}", command.name, message);
  if (x->get_items_expected_max() == 0)
    return fmt::format("{}: {} takes no value", command.name, name_of(*x));
  return fmt::format("{}: {} needs a value: write {} {}", command.name, name_of(*x), name_of(*x),
                     x->get_type_name());
}

std::string wrong_value(const ChosenCommand& command, const std::string& message) {
  auto* x = option_of(command, message);
  if (!x || x->results().empty())
    return fmt::format("{}: {}", command.name, message);
  if (x->get_items_expected_max() == 0)
    return fmt::format("{}: {} takes no value, such as {}", command.name, name_of(*x),
                       x->results().back());
  return fmt::format("{}: {} takes {}, a number, not {}", command.name, name_of(*x),
                     x->get_type_name(), x->results().back());
}

/// What a check of ours, or one of CLI11's, says of a value.
std::string refused_value(const ChosenCommand& command, const std::string& message) {
  std::smatch part;
  // Of CLI::Range and CLI::PositiveNumber, whose numbers are not for people.
  if (std::regex_match(message, part, std::regex{"(.*): Value (.*) not in range (.*) to (.*)"})) {
    auto upper = part[4].length() > 20 ? std::string{} : part[4].str();
    return fmt::format("{}: {} takes a number {}, not {}", command.name, part[1].str(),
                       upper.empty() ? "above 0" : "from " + part[3].str() + " to " + upper,
                       part[2].str());
  }
  // Of CLI::IsMember.
  if (std::regex_match(message, part, std::regex{R"((.*): (.*) not in \{(.*)\})"})) {
    Names known;
    std::istringstream all{part[3].str()};
    for (std::string x; std::getline(all, x, ',');)
      known.push_back(x);
    auto guess = nearest_of(part[2].str(), known);
    return fmt::format("{}: {} takes {}, not {}{}", command.name, part[1].str(),
                       fmt::format("{}", fmt::join(known, ", ")), part[2].str(),
                       guess.empty() ? "" : "; did you mean " + guess + "?");
  }
  return fmt::format("{}: {}", command.name, message);
}

} // namespace

void take_one_value_each(CLI::App& app) {
  auto is_option = [](const std::string& value) {
    return value.size() > 2 && value.starts_with("--")
             ? "a value is missing: " + value + " looks like an option"
             : std::string{};
  };
  for (auto* x : app.get_options([](const CLI::Option*) { return true; })) {
    if (x->get_positional() || x->get_items_expected_max() == 0)
      continue;
    if (x->get_items_expected_max() > 1)
      x->expected(1)->take_all()->allow_extra_args(false);
    x->check(is_option);
  }
  for (auto* x : app.get_subcommands([](CLI::App*) { return true; }))
    take_one_value_each(*x);
}

std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  auto command = command_of(app);
  auto rest = app.remaining(true);
  std::erase(rest, "--");
  if (!rest.empty()) {
    auto& word = rest.front();
    if (word.starts_with('-') && word.size() > 1)
      return unknown_option(command, word);
    return commands_of(*command.app).empty() ? unexpected_argument(command, word)
                                             : unknown_command(command, word);
  }
  const auto name = error.get_name();
  const std::string message = error.what();
  if (name == "RequiredError")
    if (auto text = something_missing(command); !text.empty())
      return text;
  if (name == "ArgumentMismatch")
    return wrong_count(command, message);
  if (name == "ConversionError" || name == "InvalidError")
    return wrong_value(command, message);
  if (name == "ValidationError")
    return refused_value(command, message);
  std::smatch part;
  if (name == "ExcludesError" && std::regex_match(message, part, std::regex{"(.*) excludes (.*)"}))
    return fmt::format("{}: {} and {} exclude each other; leave one of them out", command.name,
                       part[1].str(), part[2].str());
  if (name == "RequiresError" && std::regex_match(message, part, std::regex{"(.*) requires (.*)"}))
    return fmt::format("{}: {} needs {}; write both, or none of them", command.name, part[1].str(),
                       part[2].str());
  return fmt::format("{}: {}", command.name, message);
}

} // namespace castor::cli
