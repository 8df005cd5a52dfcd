#include "castor/tools/cli/timeline.hpp"

#include "castor/base/duration.hpp"
#include "castor/base/text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <string_view>

namespace castor::cli {

namespace {

constexpr std::string_view bold_letters = "\033[1m";
constexpr std::string_view green = "\033[32m";
constexpr std::string_view yellow = "\033[33m";
constexpr std::string_view red = "\033[31m";
constexpr std::string_view blue = "\033[34m";

std::string_view colour_of(std::string_view operation) {
  if (operation == to_string(Operation::add))
    return green;
  return operation == to_string(Operation::remove) ? red : yellow;
}

std::string_view colour_of(TaskStep x) {
  switch (x) {
    case TaskStep::adopted:
      return green;
    case TaskStep::waiting:
      return yellow;
    case TaskStep::rejected:
    case TaskStep::retracted:
      return red;
    case TaskStep::completed:
      return blue;
  }
  return {};
}

std::string seconds(double x) {
  return fmt::format("{:.6f}", x);
}

std::string in_columns(std::string_view time, std::string_view subarchitecture,
                       std::string_view what, std::string_view of, std::string_view id,
                       std::string_view component, std::string_view detail) {
  auto line = fmt::format("{:>11}  {:<12} {:<14}  {:<18} {:<10} {:<20} {}", time, subarchitecture,
                          what, of, id, component, detail);
  line.erase(line.find_last_not_of(' ') + 1);
  return printable(line);
}

std::string painted(const std::string& line, std::string_view colour, bool coloured) {
  return coloured ? fmt::format("{}{}\033[0m", colour, line) : line;
}

std::string change_line(double time, std::string_view subarchitecture, std::string_view operation,
                        std::string_view type, std::string_view id, std::string_view component,
                        Version version, bool coalesced, bool coloured) {
  return painted(in_columns(seconds(time), subarchitecture, operation, type, id, component,
                            fmt::format("v{}{}", version, coalesced ? " coalesced" : "")),
                 colour_of(operation), coloured);
}

} // namespace

std::string timeline_line(const ChangeEvent& event, bool coloured) {
  return change_line(in_seconds(event.time), event.address.subarchitecture,
                     to_string(event.operation), event.type_name(), event.address.id, event.source,
                     event.version, event.coalesced, coloured);
}

std::string timeline_line(const nlohmann::ordered_json& event, bool coloured) {
  auto text = [&](const char* key) { return event.at(key).get<std::string>(); };
  return change_line(event.at("time"), text("subarchitecture"), text("operation"), text("type"),
                     text("id"), text("component"), event.at("version"), event.at("coalesced"),
                     coloured);
}

std::string timeline_line(const TaskEvent& event, bool coloured) {
  return painted(in_columns(seconds(in_seconds(event.time)), event.subarchitecture,
                            fmt::format("TASK {}", to_string(event.step)), event.task.name,
                            event.task.id, event.task.component, event.detail),
                 colour_of(event.step), coloured);
}

std::string timeline_head(bool coloured) {
  return painted(
    in_columns("seconds", "subarch.", "operation", "type", "id", "component", "version"),
    bold_letters, coloured);
}

} // namespace castor::cli
