#pragma once

#include <nlohmann/json.hpp>

#include <set>
#include <string>

/// The run of section 5.1.3 of the paper (its figure 3): a blue square is put on the table, and
/// somebody says what it is.
namespace castor::test {

/// The entries that there are in the end, one line each, in every subarchitecture: those that the
/// paper names. What differs from run to run - ids, times, measurements - is left out of the lines.
std::set<std::string> figure_3_entries();

/// The line for an entry; empty for one of a type that the paper does not name.
std::string figure_3_line(const std::string& subarchitecture, const std::string& type,
                          const nlohmann::json& content);

} // namespace castor::test
