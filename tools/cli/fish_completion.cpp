#include "castor/tools/cli/completion.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <string_view>

namespace castor::cli {

namespace {

std::string quoted_for_fish(std::string_view text) {
  std::string result = "'";
  for (auto c : text) {
    if (c == '\'' || c == '\\')
      result += '\\';
    result += c;
  }
  return result + "'";
}

/// What is offered as the value, as options of `complete`.
std::string value_options(const Argument& x, const std::string& program) {
  switch (x.kind) {
    case ValueKind::flag:
      return {};
    case ValueKind::choice:
      return fmt::format(" -x -a {}",
                         quoted_for_fish(fmt::format("{}", fmt::join(x.choices, " "))));
    case ValueKind::file:
      if (x.suffix.empty())
        return " -r -F";
      return fmt::format(" -x -k -a '(__fish_complete_suffix .{})'", x.suffix);
    case ValueKind::folder:
      return " -x -a '(__fish_complete_directories)'";
    case ValueKind::system:
      return fmt::format(" -x -a '({} {} systems 2>/dev/null)'", program, completion_values);
    case ValueKind::place:
      return fmt::format(" -x -a '({} {} places 2>/dev/null)'", program, completion_values);
    case ValueKind::text:
      break;
  }
  return " -x";
}

std::string lines_of(const Command& command) {
  auto& program = command.path.front();
  auto path = fmt::format("{}", fmt::join(command.path, " "));
  std::string result;
  for (auto& x : command.commands)
    result += fmt::format("complete -c {} -n '__{}_at \"{} 1\"' -f -a {} -d {}\n", program, program,
                          path, x.path.back(), quoted_for_fish(x.help));
  for (auto* options : {&command.options, &command.inherited})
    for (auto& x : *options) {
      std::string spellings;
      for (auto& name : x.names)
        spellings += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
      result += fmt::format("complete -c {} -n '__{}_at \"{}\"'{}{} -d {}\n", program, program,
                            path, spellings, value_options(x, program), quoted_for_fish(x.help));
    }
  int at = 0;
  for (auto& x : command.positionals) {
    ++at;
    auto value = value_options(x, program);
    if (x.kind == ValueKind::text)
      continue;
    result += fmt::format("complete -c {} -n '__{}_at \"{} {}{}\"'{} -d {}\n", program, program,
                          path, at, x.repeatable ? "+" : "", value, quoted_for_fish(x.help));
  }
  return result;
}

/// Finds the command and the number of the positional argument at the cursor, as the completions
/// below are conditioned on it.
constexpr const char* fish_driver = R"fish(
# __PROGRAM_at "COMMAND [NUMBER[+]]": whether the cursor is in the command, and at the positional argument
# of this number, or, with +, of this number or a later one
function __PROGRAM_at
    set -l path PROGRAM
    set -l count 1
    set -l skip no
    for word in (commandline -opc)[2..-1]
        if test $skip = yes
            set skip no
        else if string match -q -- '-*' $word
            contains -- "$path $word" $__PROGRAM_valued; and set skip yes
        else if contains -- "$path $word" $__PROGRAM_commands
            set path "$path $word"
            set count 1
        else
            set count (math $count + 1)
        end
    end
    test "$argv" = "$path"; and return 0
    test "$argv" = "$path $count"; and return 0
    set -l first (string match -r -g -- "^$path (\d+)\+\$" "$argv")
    and test $count -ge $first
end

complete -c PROGRAM -f
)fish";

} // namespace

std::string fish_completion(const Command& program) {
  auto& name = program.path.front();
  std::string commands;
  std::string valued;
  std::string lines;
  for (auto* x : all_commands(program)) {
    auto path = fmt::format("{}", fmt::join(x->path, " "));
    commands += " \\\n    " + quoted_for_fish(path);
    for (auto* options : {&x->options, &x->inherited})
      for (auto& option : *options)
        for (auto& option_name : option.names)
          if (option.kind != ValueKind::flag)
            valued += " \\\n    " + quoted_for_fish(path + ' ' + option_name);
    lines += lines_of(*x);
  }
  std::string rest = fish_driver;
  for (auto at = rest.find("PROGRAM"); at != rest.npos; at = rest.find("PROGRAM", at))
    rest.replace(at, 7, name);
  return fmt::format("# fish completion for {0}\n\n"
                     "set -g __{0}_commands{1}\n"
                     "# Options that take a value.\n"
                     "set -g __{0}_valued{2}\n{3}\n{4}",
                     name, commands, valued, rest, lines);
}

} // namespace castor::cli
