#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/hosts.hpp"
#include "castor/actors/cast/preprocessor.hpp"
#include "castor/actors/cast/words.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace castor::cast {

/// Where a component line stands.
struct ComponentContext {
  /// Empty for a stand-alone component, whose line has no kind.
  std::string_view subarchitecture;
  /// For a line without a host of its own.
  std::string_view default_host;
};

struct ComponentLine {
  /// Set as soon as it was read, even if the rest of the line is in error.
  std::optional<ComponentKind> kind;
  /// Without a number. Absent if the line is in error.
  std::optional<ComponentDescription> component;
};

/// Reads `[host] LANG KIND [name] class [options]`, or `[host] LANG name class [options]` for a
/// stand-alone component. This runtime has C++ components only; the working memory and the task
/// manager of the Java toolkit are taken for their C++ namesakes, so that old files run.
/// @param words stands at the host or the language
ComponentLine parse_component_line(WordStream& words, const StructureLine& line,
                                   const ComponentContext& context, HostTable& hosts,
                                   DiagnosticLog& log);

/// Replaces `[Name]` and localhost, and remembers the use. An undefined name gets a warning.
std::string use_host(std::string_view expression, const StructureLine& line, HostTable& hosts,
                     DiagnosticLog& log);

/// Whether one of the first two words is a language or a kind, as in component lines only.
bool looks_like_component(std::string_view text) noexcept;

} // namespace castor::cast
