#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/planning/motivation/types.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The language of motive files. `#` begins a comment; lines that belong to a motive are indented.
///
///     motive recharge
///       when      (battery-low ?robot)          # facts, all of them; ?robot is any object
///       goal      (is-charged {robot})          # {robot} is what ?robot was
///       words     recharge
///       because   my battery is low
///       priority  9
///       resources base
///
///     motive explore
///       when      idle 30s                      # nothing was pursued for so long
///       goal      (explored)
///       words     look around
///
///     motive find
///       on        Find                          # a request for an action, with the parts of it
///       goal      (K robby (perceived-position {patient}))
///       words     find {patient}
///       because   {speaker} said '{text}'
///       about     {patient}
///       priority  3
///       cost      2
///       resources base camera
///       patience  10min                         # it is dropped if it has not begun by then
namespace castor::planning {

/// Values of the names in braces.
using MotiveValues = std::map<std::string, std::string, std::less<>>;

struct MotiveTemplate {
  std::string name;
  /// Facts that occasion it; empty for none.
  std::vector<std::string> when;
  std::optional<std::chrono::microseconds> idle;
  /// Type of a requested action, or `question` or `statement`; empty for none.
  std::string on;
  std::string goal;
  std::string words;
  std::string because;
  std::string about;
  double priority = 1;
  double cost = 1;
  std::vector<std::string> resources;
  std::chrono::microseconds patience{0};

  /// Names in braces that it uses.
  std::vector<std::string> names() const;
};

struct MotiveTemplates {
  std::vector<MotiveTemplate> templates;
  /// All of them, in the order of lines.
  std::vector<Diagnostic> problems;
};

MotiveTemplates parse_motives(const std::string& file, std::string_view text);

/// The motive with these values; nothing if one that it uses is missing.
std::optional<Motive> make_motive(const MotiveTemplate& x, const MotiveValues& values);

/// All values with which all patterns are among the facts.
std::vector<MotiveValues> matches(const std::vector<std::string>& patterns,
                                  const std::vector<std::string>& facts);

} // namespace castor::planning
