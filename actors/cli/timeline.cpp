#include "castor/actors/cli/timeline.hpp"

#include <fmt/core.h>

#include <chrono>
#include <string_view>

namespace castor::cli {

namespace {

constexpr std::string_view bold = "\033[1m";
constexpr std::string_view green = "\033[32m";
constexpr std::string_view yellow = "\033[33m";
constexpr std::string_view red = "\033[31m";
constexpr std::string_view blue = "\033[34m";

std::string_view colour_of(Operation x) {
  switch (x) {
    case Operation::add:
      return green;
    case Operation::overwrite:
      return yellow;
    case Operation::remove:
      return red;
  }
  return {};
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

std::string seconds(Timestamp x) {
  return fmt::format("{:.6f}", std::chrono::duration<double>(x).count());
}

std::string in_columns(std::string_view time, std::string_view subarchitecture,
                       std::string_view what, std::string_view of, std::string_view id,
                       std::string_view component, std::string_view detail) {
  auto line = fmt::format("{:>11}  {:<12} {:<14}  {:<18} {:<10} {:<20} {}", time, subarchitecture,
                          what, of, id, component, detail);
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string painted(const std::string& line, std::string_view colour, bool coloured) {
  return coloured ? fmt::format("{}{}\033[0m", colour, line) : line;
}

} // namespace

std::string timeline_line(const ChangeEvent& event, bool coloured) {
  return painted(
    in_columns(seconds(event.time), event.address.subarchitecture, to_string(event.operation),
               event.type_name(), event.address.id, event.source,
               fmt::format("v{}{}", event.version, event.coalesced ? " coalesced" : "")),
    colour_of(event.operation), coloured);
}

std::string timeline_line(const TaskEvent& event, bool coloured) {
  return painted(in_columns(seconds(event.time), event.subarchitecture,
                            fmt::format("TASK {}", to_string(event.step)), event.task.name,
                            event.task.id, event.task.component, event.detail),
                 colour_of(event.step), coloured);
}

std::string timeline_head(bool coloured) {
  return painted(
    in_columns("seconds", "subarch.", "operation", "type", "id", "component", "version"), bold,
    coloured);
}

} // namespace castor::cli
