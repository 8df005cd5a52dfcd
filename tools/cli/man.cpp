#include "castor/tools/cli/command_tree.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/man_page.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/writable.hpp"

#include "castor/base/suggestion.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cli {

namespace {

struct ManArguments {
  std::vector<std::string> command;
  std::filesystem::path output;
};

/// Today, or the day that SOURCE_DATE_EPOCH names, so that the same sources give the same pages.
std::string date() {
  auto now = std::time(nullptr);
  if (auto* epoch = std::getenv("SOURCE_DATE_EPOCH"))
    now = static_cast<std::time_t>(std::strtoll(epoch, nullptr, 10));
  std::tm day{};
  gmtime_r(&now, &day);
  return fmt::format("{:04}-{:02}-{:02}", day.tm_year + 1900, day.tm_mon + 1, day.tm_mday);
}

const Command& find(const Command& program, const std::vector<std::string>& words) {
  auto* result = &program;
  for (auto& word : words) {
    std::vector<std::string_view> known;
    const Command* found = nullptr;
    for (auto& x : result->commands) {
      known.push_back(x.path.back());
      if (x.path.back() == word)
        found = &x;
    }
    if (!found) {
      auto call = fmt::format("{}", fmt::join(result->path, " "));
      auto guess = did_you_mean(word, known);
      if (guess.empty() && !known.empty())
        guess = fmt::format("it has {}", fmt::join(known, ", "));
      throw std::runtime_error(
        fmt::format("`{}` has no command {}{}", call, word, guess.empty() ? "" : "; " + guess));
    }
    result = found;
  }
  return *result;
}

/// Lets man(1) show the page; false if that cannot be.
bool show_page(const std::string& page) {
  auto* pipe = popen("man -l - 2>/dev/null", "w");
  if (!pipe)
    return false;
  std::fputs(page.c_str(), pipe);
  return pclose(pipe) == 0;
}

int man(const CLI::App& app, const ManArguments& arguments) {
  auto program = command_tree(app, "castor");
  Edition edition{CASTOR_VERSION, date()};
  auto& command = find(program, arguments.command);
  if (arguments.output.empty()) {
    auto page = man_page(command, program, edition);
    if (!isatty(STDOUT_FILENO) || !show_page(page))
      std::fputs(page.c_str(), stdout);
    return success;
  }
  std::error_code problem;
  std::filesystem::create_directories(arguments.output, problem);
  if (problem)
    throw std::runtime_error(
      fmt::format("cannot make the folder {}: {}", arguments.output.string(), problem.message()));
  for (auto* x : all_commands(command)) {
    auto file = create(arguments.output / (man_page_name(*x) + ".1"));
    file << man_page(*x, program, edition) << std::flush;
    if (!file)
      throw std::runtime_error("cannot write " + arguments.output.string());
  }
  return success;
}

} // namespace

void add_man(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand("man", "show the manual page of a command");
  auto arguments = std::make_shared<ManArguments>();
  command
    ->add_option("COMMAND", arguments->command,
                 "which command, in as many words as it has; without it, castor itself")
    ->type_name("");
  command
    ->add_option("--output", arguments->output,
                 "write the pages of the command and of all its parts into this folder")
    ->type_name("DIR")
    ->check(check_output_folder);
  command->footer("In a terminal man(1) shows the page; otherwise it is printed in roff. Where "
                  "Castor is installed, "
                  "`man castor-run` shows the same.\n"
                  "Examples: castor man run\n"
                  "          castor man journal replay\n"
                  "          castor man --output ~/.local/share/man/man1");
  command->callback(
    [&app, &chosen, arguments] { chosen = [&app, arguments] { return man(app, *arguments); }; });
}

} // namespace castor::cli
