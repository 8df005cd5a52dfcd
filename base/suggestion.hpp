#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// Number of single-character insertions, deletions, replacements and swaps of neighbours that turn
/// one word into the other; anything above `limit` is reported as `limit + 1`.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit);

/// Maximum number of candidates compared, so that a hostile file cannot make its diagnosis
/// expensive.
inline constexpr std::size_t most_candidates = 4096;

/// Number of findings beyond which no names are suggested: suggestions cost more than findings.
inline constexpr std::size_t most_explained = 200;

/// The candidate nearest to a misspelt word, with at most a third of its letters wrong; empty if
/// there is none. Upper and lower case count as nearly the same. Names of more than 64 bytes are
/// not compared.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// "did you mean 'x'?", or empty if there is no near candidate.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

} // namespace castor
