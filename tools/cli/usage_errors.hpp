#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace castor::cli {

/// Makes every option take exactly one value per occurrence, so that a repeatable option does not
/// consume the arguments after it, nor any option another one.
void take_one_value_each(CLI::App& app);

/// Error message with a remedy for a command line that CLI11 has refused, in one line.
std::string explain(const CLI::App& app, const CLI::ParseError& error);

} // namespace castor::cli
