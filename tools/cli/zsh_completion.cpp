#include "castor/tools/cli/completion.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <string_view>

namespace castor::cli {

namespace {

std::string quoted_for_zsh(std::string_view text) {
  std::string result = "'";
  for (auto c : text)
    result += c == '\'' ? std::string{"'\\''"} : std::string(1, c);
  return result + "'";
}

/// Text as a part of a specification of _arguments, where colons and brackets separate.
std::string escaped_for_zsh(std::string_view text) {
  std::string result;
  for (auto c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\')
      result += '\\';
    result += c;
  }
  return result;
}

/// ":MESSAGE:ACTION" of what takes a value.
std::string value_action(const Argument& x, const std::string& program) {
  auto message = ':' + escaped_for_zsh(x.value) + ':';
  switch (x.kind) {
    case ValueKind::flag:
      return {};
    case ValueKind::choice:
      return message + fmt::format("({})", fmt::join(x.choices, " "));
    case ValueKind::file:
      return message + (x.suffix.empty() ? "_files" : "_files -g \"*." + x.suffix + "\"");
    case ValueKind::folder:
      return message + "_files -/";
    case ValueKind::system:
      return message + '_' + program + "_running systems";
    case ValueKind::place:
      return message + '_' + program + "_running places";
    case ValueKind::text:
      break;
  }
  // A blank as the action shows the message and offers nothing.
  return message + ' ';
}

/// One word for each spelling, for _arguments.
std::string specification(const Argument& option, const std::string& program) {
  std::string result;
  auto others = fmt::format("({})", fmt::join(option.names, " "));
  for (auto& name : option.names) {
    auto is_long = name.rfind("--", 0) == 0;
    auto text = option.repeatable ? "*" + name : others + name;
    if (option.kind != ValueKind::flag)
      text += is_long ? "=" : "+";
    text += '[' + escaped_for_zsh(option.help) + ']' + value_action(option, program);
    result += "    " + quoted_for_zsh(text) + " \\\n";
  }
  return result;
}

std::string function_name(const Command& command) {
  return fmt::format("_{}", fmt::join(command.path, "_"));
}

std::string function_of(const Command& command) {
  auto& program = command.path.front();
  auto name = function_name(command);
  std::string specifications;
  for (auto* options : {&command.options, &command.inherited})
    for (auto& x : *options)
      specifications += specification(x, program);
  if (command.commands.empty()) {
    for (auto& x : command.positionals)
      specifications += "    " +
                        quoted_for_zsh((x.repeatable ? "*"
                                        : x.required ? ""
                                                     : ":") +
                                       value_action(x, program)) +
                        " \\\n";
    return fmt::format("{}() {{\n  _arguments -s \\\n{}    && return 0\n}}\n\n", name,
                       specifications);
  }
  std::string parts;
  std::string cases;
  for (auto& x : command.commands) {
    auto part = escaped_for_zsh(x.path.back()) + ':' + x.help;
    parts += "    " + quoted_for_zsh(part) + '\n';
    cases += fmt::format("        {}) {} ;;\n", x.path.back(), function_name(x));
  }
  return fmt::format("{}() {{\n"
                     "  local curcontext=$curcontext state line\n"
                     "  typeset -A opt_args\n"
                     "  local -a commands=(\n{}  )\n"
                     "  _arguments -s -C -A '-*' \\\n{}"
                     "    '1:command:->command' \\\n"
                     "    '*::argument:->arguments' \\\n"
                     "    && return 0\n"
                     "  case $state in\n"
                     "    command) _describe -t commands command commands ;;\n"
                     "    arguments)\n"
                     "      case $line[1] in\n{}"
                     "      esac\n"
                     "      ;;\n"
                     "  esac\n"
                     "}}\n\n",
                     name, parts, specifications, cases);
}

} // namespace

std::string zsh_completion(const Command& program) {
  auto& name = program.path.front();
  std::string functions;
  for (auto* x : all_commands(program))
    functions += function_of(*x);
  return fmt::format(
    "#compdef {0}\n"
    "# zsh completion for {0}\n\n"
    "# _{0}_running KIND: offers what the running systems have\n"
    "_{0}_running() {{\n"
    "  local -a names=(${{(f)\"$(_call_program names {0} {1} $1 2>/dev/null)\"}})\n"
    "  compadd -a names\n"
    "}}\n\n"
    "{2}"
    "# Autoloaded as a function of this name, or sourced.\n"
    "if [[ $funcstack[1] == _{0} ]]; then\n"
    "  _{0} \"$@\"\n"
    "else\n"
    "  compdef _{0} {0}\n"
    "fi\n",
    name, completion_values, functions);
}

} // namespace castor::cli
