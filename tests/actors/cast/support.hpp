#pragma once

#include "castor/actors/cast/parser.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cast::test {

/// All that a parse may ask of the outside world.
struct World {
  /// Path to content.
  std::map<std::string, std::string> files;
  std::map<std::string, std::string> environment;
};

/// Options for a parse that sees the given world only; the working directory is /robot.
ParseOptions options_for(World world);

/// Parses a text that is called main.cast and stands in the working directory.
ParseResult parse(std::string_view text, World world = {});

/// A host, and a subarchitecture `sa` with working memory and task manager: four lines. What is
/// given follows from line 5 on.
std::string system_with(std::string_view lines);

/// What the text's `#EXPAND` lines come to, without the word and the blank behind it.
std::vector<std::string> values(std::string_view text, World world = {});

/// The file is correct, and there is nothing to remark.
testing::AssertionResult is_clean(const ParseResult& result);

/// There is such a diagnostic for that line of the main file, or for `file` if it is given.
testing::AssertionResult reports(const ParseResult& result, Severity severity, std::size_t line,
                                 std::string_view message_part, std::string_view remedy_part = {},
                                 std::string_view file = "main.cast");

std::size_t count(const ParseResult& result, Severity severity);

} // namespace castor::cast::test
