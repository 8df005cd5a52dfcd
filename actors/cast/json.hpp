#pragma once

#include "castor/actors/cast/parser.hpp"

#include <string>

namespace castor {

/// The description as indented JSON, for tools: subarchitectures with working memory, task manager
/// and components, stand-alone components, host names and access rules, each with the place it
/// comes from. Bytes that are not UTF-8 are replaced.
std::string to_json(const ArchitectureDescription& architecture);

} // namespace castor

namespace castor::cast {

/// Everything a parse found: "ok", "diagnostics", "expansions", and "architecture", which is null
/// if there are errors.
std::string to_json(const ParseResult& result);

} // namespace castor::cast
