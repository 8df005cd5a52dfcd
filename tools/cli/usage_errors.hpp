#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace castor::cli {

/// Makes every option take one value each time that it is written, so that a repeatable one does
/// not take the arguments behind it, and no option another one.
void take_one_value_each(CLI::App& app);

/// What is wrong with a command line that CLI11 has refused, and what to write instead: one line.
std::string explain(const CLI::App& app, const CLI::ParseError& error);

} // namespace castor::cli
