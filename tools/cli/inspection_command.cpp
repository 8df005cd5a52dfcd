#include "castor/tools/cli/inspection_command.hpp"

#include "castor/tools/cli/inspection_text.hpp"
#include "castor/tools/cli/timeline.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <stdexcept>

namespace castor::cli {

CLI::App* inspection_command(CLI::App& app, const std::string& name, const std::string& help,
                             std::string& system) {
  auto* result = app.add_subcommand(name, help);
  result
    ->add_option(
      "--system", system,
      "name of a running system on this machine, or the beginning of it; `castor ps` lists them")
    ->type_name("NAME");
  return result;
}

void add_json_flag(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print JSON, one object on a line");
}

void add_wait_flag(CLI::App& command, bool& wait) {
  command.add_flag(
    "--wait", wait,
    "accept names of types, components and subarchitectures that the system does not know yet");
}

void add_where_option(CLI::App& command, std::string& where) {
  command.add_option("WHERE", where, "the subarchitecture, and perhaps an id or a type")
    ->type_name("SUBARCHITECTURE[/ID|TYPE]");
}

Json entries_request(const std::string& where) {
  auto [subarchitecture, what] = split_where(where);
  Json result{{"do", "wm"}, {"subarchitecture", subarchitecture}};
  if (!what.empty())
    result["what"] = what;
  return result;
}

Json values_request(const std::string& where, bool full) {
  auto result = entries_request(where);
  result["values"] = true;
  result["full"] = full;
  return result;
}

int print_changes(const RunningSystem& system, const Json& request, bool json) {
  const bool coloured = isatty(STDOUT_FILENO) != 0;
  if (!json)
    print(timeline_head(coloured) + '\n');
  ask(system, request,
      [&](const Json& x) { print(json ? x.dump() + '\n' : change_as_text(x, coloured)); });
  return success;
}

void print(const std::string& x) {
  std::fputs(x.c_str(), stdout);
  std::fflush(stdout);
}

std::pair<std::string, std::string> split_where(const std::string& where) {
  auto slash = where.find('/');
  return {where.substr(0, slash), slash == where.npos ? "" : where.substr(slash + 1)};
}

nlohmann::ordered_json read_json(const std::string& argument) {
  auto text = argument == "-" ? std::string{std::istreambuf_iterator<char>{std::cin},
                                            std::istreambuf_iterator<char>{}}
                              : argument;
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    auto at = std::min(text.size(), e.byte > 0 ? e.byte - 1 : 0);
    if (at >= text.size())
      throw std::runtime_error("this is no JSON: it ends too early, behind '" +
                               text.substr(text.size() - std::min<std::size_t>(text.size(), 20)) +
                               "'");
    auto from = at - std::min<std::size_t>(at, 10);
    throw std::runtime_error(fmt::format("this is no JSON: character {} is wrong, in '{}'. Names "
                                         "and texts stand in double quotes, and "
                                         "the whole in single ones: '{{\"number\": 3}}'",
                                         at + 1, text.substr(from, at - from + 10)));
  }
}

} // namespace castor::cli
