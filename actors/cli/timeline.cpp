#include "castor/actors/cli/timeline.hpp"

#include <fmt/core.h>

#include <chrono>
#include <string_view>

namespace castor::cli {

namespace {

std::string_view colour_of(Operation x) {
  switch (x) {
    case Operation::add:
      return "\033[32m";
    case Operation::overwrite:
      return "\033[33m";
    case Operation::remove:
      return "\033[31m";
  }
  return "";
}

} // namespace

std::string timeline_line(const ChangeEvent& event, bool coloured) {
  auto seconds = std::chrono::duration<double>(event.time).count();
  auto line = fmt::format("{:>11.6f}  {:<12} {:<9}  {:<18} {:<10} {:<20} v{}", seconds,
                          event.address.subarchitecture, to_string(event.operation),
                          event.type_name(), event.address.id, event.source, event.version);
  if (!coloured)
    return line;
  return fmt::format("{}{}\033[0m", colour_of(event.operation), line);
}

std::string timeline_head(bool coloured) {
  auto line = fmt::format("{:>11}  {:<12} {:<9}  {:<18} {:<10} {:<20} {}", "seconds", "subarch.",
                          "operation", "type", "id", "component", "version");
  return coloured ? fmt::format("\033[1m{}\033[0m", line) : line;
}

} // namespace castor::cli
