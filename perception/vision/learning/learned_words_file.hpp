#pragma once

#include "castor/perception/vision/types.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Text file of learned words, one word per line:
///
///     colour azure  examples 2  scatter 3.5  mean 61.2 -5.4 -38.9
///
/// Shapes are described by hidden values of the shape network: a line `network 1c09aef2` before
/// them says of which.
namespace castor::vision {

std::string to_text(const std::vector<LearnedWord>& words);

/// \throws TextFileError with all wrong lines, and those of shapes of another network.
std::vector<LearnedWord> parse_learned_words(std::string_view text, const std::string& file_name);

/// Loads the file; empty if there is no such file yet.
/// \throws TextFileError as above, and if the file cannot be read.
std::vector<LearnedWord> load_learned_words(const std::filesystem::path& path);

/// \throws TextFileError if it cannot be written.
void save_learned_words(const std::filesystem::path& path, const std::vector<LearnedWord>& words);

} // namespace castor::vision
