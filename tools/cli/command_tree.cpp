#include "castor/tools/cli/command_tree.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <regex>
#include <utility>

namespace castor::cli {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> result;
  std::size_t begin = 0;
  for (auto end = text.find(separator); end != text.npos; end = text.find(separator, begin)) {
    result.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  result.push_back(text.substr(begin));
  return result;
}

/// Words of {a,b} in the description of a validator; with {a->1,b->2} those before the arrows.
std::vector<std::string> listed_choices(const std::string& type) {
  auto begin = type.find('{');
  auto end = type.find('}', begin == type.npos ? 0 : begin);
  if (begin == type.npos || end == type.npos)
    return {};
  auto result = split(type.substr(begin + 1, end - begin - 1), ',');
  for (auto& x : result)
    x = x.substr(0, x.find("->"));
  return result;
}

/// Words of a value that is written as full|batched|off.
std::vector<std::string> written_choices(const std::string& value) {
  static const std::regex alternatives{"[a-z0-9-]+(\\|[a-z0-9-]+)+"};
  if (!std::regex_match(value, alternatives))
    return {};
  return split(value, '|');
}

bool has_word(const std::string& text, const std::string& words) {
  return std::regex_search(text, std::regex{"(^|[^A-Z])(" + words + ")($|[^A-Z])"});
}

ValueKind kind_of(const Argument& x, const std::string& type) {
  if (!x.choices.empty())
    return ValueKind::choice;
  auto text = x.value + ':' + type;
  // What is only a part of the value, as in NAME=FILE, is not offered.
  if (x.value.find('=') != text.npos)
    return ValueKind::text;
  if (has_word(text, "FILE|OUT|PATH|PLACE"))
    return ValueKind::file;
  if (has_word(text, "DIR|FOLDER"))
    return ValueKind::folder;
  if (x.value.rfind("SUBARCHITECTURE", 0) == 0)
    return ValueKind::place;
  if (std::find(x.names.begin(), x.names.end(), "--system") != x.names.end())
    return ValueKind::system;
  return ValueKind::text;
}

/// "the .cast file of the system": cast.
std::string suffix_of(const std::string& help) {
  std::smatch match;
  if (std::regex_search(help, match, std::regex{"^(?:the|a|an) \\.([a-z]+) file"}))
    return match[1];
  return {};
}

Argument read_argument(const CLI::Option& option) {
  Argument result;
  for (auto& x : option.get_snames())
    result.names.push_back('-' + x);
  for (auto& x : option.get_lnames())
    result.names.push_back("--" + x);
  result.help = option.get_description();
  result.required = option.get_required();
  result.repeatable = option.get_items_expected_max() > 1 ||
                      option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  // Flags may be written several times, but nobody wants that offered.
  if (option.get_items_expected_max() == 0) {
    result.repeatable = false;
    return result;
  }
  // "FILE", or with validators "N:INT in [1 - 100]"; CLI11's own name for no particular type is
  // TEXT.
  auto type = option.get_type_name();
  static const std::regex validator{
    ":(\\{|[A-Z]+ in \\[|POSITIVE|NONNEGATIVE|NUMBER|FILE$|DIR$|PATH\\(|IPV4).*$"};
  result.value = std::regex_replace(type, validator, "");
  if (auto in = type.find(" in ["); in != type.npos)
    result.range = type.substr(in + 4);
  if (result.names.empty() && (result.value.empty() || result.value == "TEXT"))
    result.value = option.get_name(true);
  if (result.value.empty())
    result.value = "VALUE";
  result.default_value = option.get_default_str();
  result.choices = listed_choices(type);
  if (result.choices.empty())
    result.choices = written_choices(result.value);
  // The name of a positional argument says what it takes where its type does not.
  result.kind = kind_of(result, type + (result.names.empty() ? ':' + option.get_name(true) : ""));
  if (result.kind == ValueKind::file)
    result.suffix = suffix_of(result.help);
  return result;
}

bool names_something(const std::vector<Argument>& options, const Argument& x) {
  return std::any_of(options.begin(), options.end(), [&](const Argument& other) {
    return std::find_first_of(x.names.begin(), x.names.end(), other.names.begin(),
                              other.names.end()) != x.names.end();
  });
}

/// Adds what `app` has to `command`; groups of options are apps without a name.
void read_into(Command& command, const CLI::App& app) {
  for (auto* option : app.get_options({})) {
    if (option->get_group().empty())
      continue;
    auto x = read_argument(*option);
    (x.names.empty() ? command.positionals : command.options).push_back(std::move(x));
  }
  for (auto* part : app.get_subcommands([](const CLI::App*) { return true; }))
    if (part->get_name().empty() && !part->get_group().empty())
      read_into(command, *part);
}

Command read_command(const CLI::App& app, std::vector<std::string> path,
                     const std::vector<Argument>& inherited) {
  Command result;
  result.path = std::move(path);
  result.help = app.get_description();
  // Commands without a footer get that of the command that they are part of from CLI11.
  auto* parent = app.get_parent();
  if (!parent || parent->get_footer() != app.get_footer())
    result.footer = app.get_footer();
  read_into(result, app);
  if (app.get_fallthrough())
    for (auto& x : inherited)
      if (!names_something(result.options, x))
        result.inherited.push_back(x);
  auto passed_on = result.options;
  passed_on.insert(passed_on.end(), result.inherited.begin(), result.inherited.end());
  for (auto* part : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (part->get_name().empty() || part->get_group().empty())
      continue;
    auto part_path = result.path;
    part_path.push_back(part->get_name());
    result.commands.push_back(read_command(*part, std::move(part_path), passed_on));
  }
  return result;
}

void append(const Command& command, std::vector<const Command*>& result) {
  result.push_back(&command);
  for (auto& x : command.commands)
    append(x, result);
}

} // namespace

Command command_tree(const CLI::App& app, const std::string& program) {
  return read_command(app, {program}, {});
}

std::vector<const Command*> all_commands(const Command& command) {
  std::vector<const Command*> result;
  append(command, result);
  return result;
}

} // namespace castor::cli
