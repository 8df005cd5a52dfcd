#include "castor/base/text.hpp"
#include "castor/tools/cli/completion.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

namespace castor::cli {

namespace {

/// Splits the command line into words, and finds the command, the option before the cursor, and how
/// many positional arguments there are.
constexpr const char* bash_driver = R"sh(
# _PROGRAM_add WORD...: offers those that begin with what is typed
_PROGRAM_add() {
  local word
  for word in "$@"; do
    [[ $word == "$typed"* ]] && COMPREPLY+=("$word")
  done
}

# _PROGRAM_files [SUFFIX]: offers files; where some have the suffix, only these and folders
_PROGRAM_files() {
  local start=${typed#[\"\']} suffix=$1 found=()
  [[ -n $suffix ]] && mapfile -t found < <(compgen -f -X "!*.$suffix" -- "$start")
  if ((${#found[@]})); then
    mapfile -t -O ${#found[@]} found < <(compgen -d -- "$start")
  else
    mapfile -t found < <(compgen -f -- "$start")
  fi
  COMPREPLY+=("${found[@]}")
  compopt -o filenames 2>/dev/null
}

_PROGRAM_folders() {
  mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "${typed#[\"\']}")
  compopt -o filenames 2>/dev/null
}

# _PROGRAM_running KIND: offers what the running systems have
_PROGRAM_running() {
  local names
  mapfile -t names < <("${COMP_WORDS[0]}" VALUES_COMMAND "$1" 2>/dev/null)
  _PROGRAM_add "${names[@]}"
}

_PROGRAM() {
  COMPREPLY=()
  # Readline splits words at = and :, too; here they are whole again.
  local words=() word part joined=
  for part in "${COMP_WORDS[@]:0:COMP_CWORD+1}"; do
    if [[ ${#words[@]} -gt 0 && ( -n $joined || $part =~ ^[=:]+$ ) ]]; then
      words[-1]+=$part
    else
      words+=("$part")
    fi
    joined=
    [[ $part =~ ^[=:]+$ ]] && joined=yes
  done
  local typed=${words[-1]} path=PROGRAM option= count=0 only_arguments=
  unset 'words[-1]'
  local commands options valued
  _PROGRAM_command "$path"
  for word in "${words[@]:1}"; do
    if [[ -n $option ]]; then
      option=
    elif [[ $word == -- ]]; then
      only_arguments=yes
    elif [[ $word == -* && -z $only_arguments ]]; then
      [[ " $valued " == *" $word "* ]] && option=$word
    elif [[ " $commands " == *" $word "* ]]; then
      path+=" $word" count=0
      _PROGRAM_command "$path"
    else
      ((++count))
    fi
  done
  local prefix=
  if [[ -z $option && -z $only_arguments && $typed == --*=* ]]; then
    option=${typed%%=*} typed=${typed#*=}
    [[ $COMP_WORDBREAKS != *=* ]] && prefix=$option=
  fi
  if [[ -n $option ]]; then
    _PROGRAM_value "$path $option"
  elif [[ $typed == -* && -z $only_arguments ]]; then
    _PROGRAM_add $options
  else
    _PROGRAM_add $commands
    _PROGRAM_value "$path $((count + 1))"
    [[ ${#COMPREPLY[@]} -eq 0 && -z $typed ]] && _PROGRAM_add $options
  fi
  # What stands before the last = or : is on the command line already.
  local kept=${typed%"${typed##*[=:]}"}
  [[ $COMP_WORDBREAKS == *:* ]] || kept=
  local i
  for i in "${!COMPREPLY[@]}"; do
    COMPREPLY[i]=$prefix${COMPREPLY[i]#"$kept"}
  done
}

complete -F _PROGRAM PROGRAM
)sh";

std::string action(const Argument& x) {
  switch (x.kind) {
    case ValueKind::choice:
      return fmt::format("add {}", fmt::join(x.choices, " "));
    case ValueKind::file:
      return x.suffix.empty() ? "files" : "files " + x.suffix;
    case ValueKind::folder:
      return "folders";
    case ValueKind::system:
      return "running systems";
    case ValueKind::place:
      return "running places";
    case ValueKind::flag:
    case ValueKind::text:
      break;
  }
  return {};
}

std::vector<Argument> understood_options(const Command& command) {
  auto result = command.options;
  result.insert(result.end(), command.inherited.begin(), command.inherited.end());
  return result;
}

std::string names(const Command& command, bool with_value_only) {
  std::string result;
  for (auto& x : understood_options(command)) {
    if (with_value_only && x.kind == ValueKind::flag)
      continue;
    for (auto& name : x.names)
      result += (result.empty() ? "" : " ") + name;
  }
  return result;
}

} // namespace

std::string bash_completion(const Command& program) {
  auto& name = program.path.front();
  std::string commands;
  std::string values;
  for (auto* x : all_commands(program)) {
    auto path = fmt::format("{}", fmt::join(x->path, " "));
    std::string parts;
    for (auto& part : x->commands)
      parts += (parts.empty() ? "" : " ") + part.path.back();
    commands +=
      fmt::format("    '{}')\n      commands='{}'\n      options='{}'\n      valued='{}'\n"
                  "      ;;\n",
                  path, parts, names(*x, false), names(*x, true));
    auto add_value = [&](const Argument& argument, const std::string& pattern) {
      if (auto what = action(argument); !what.empty())
        values += fmt::format("    {}) _{}_{} ;;\n", pattern, name, what);
    };
    for (auto& option : understood_options(*x)) {
      std::string pattern;
      for (auto& option_name : option.names)
        pattern += fmt::format("{}'{} {}'", pattern.empty() ? "" : " | ", path, option_name);
      add_value(option, pattern);
    }
    int at = 0;
    for (auto& positional : x->positionals) {
      ++at;
      add_value(positional, positional.repeatable ? fmt::format("'{} '[0-9]*", path)
                                                  : fmt::format("'{} {}'", path, at));
    }
  }
  std::string rest = bash_driver;
  replace_all(rest, "PROGRAM", name);
  replace_all(rest, "VALUES_COMMAND", completion_values);
  return fmt::format(
    "# bash completion for {0}\n\n"
    "# _{0}_command COMMAND: its parts, its options, and those of them that take a "
    "value\n_{0}_command() {{\n  case $1 in\n{1}  esac\n}}\n\n"
    "# _{0}_value COMMAND OPTION|NUMBER: offers values of an option, or of a "
    "positional argument\n_{0}_value() {{\n  case $1 in\n{2}  esac\n}}\n{3}",
    name, commands, values, rest);
}

} // namespace castor::cli
