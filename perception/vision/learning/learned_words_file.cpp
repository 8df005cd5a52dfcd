#include "castor/perception/vision/learning/learned_words_file.hpp"

#include "castor/base/text_file.hpp"
#include "castor/perception/vision/learning/word_learner.hpp"
#include "castor/perception/vision/recognition/shape_classifier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace castor::vision {

namespace {

/// Where the mean begins in a line's words.
constexpr std::size_t mean_at = 7;

const std::string& this_network() {
  static const std::string result = identity(trained_shape_network());
  return result;
}

/// Throws std::invalid_argument, for people.
LearnedWord parse(const std::vector<std::string>& words) {
  if (words.size() < mean_at || words[2] != "examples" || words[4] != "scatter" ||
      words[6] != "mean")
    throw std::invalid_argument("this line is not a learned word");
  auto number = [&](std::size_t i) {
    auto x = parse_number(words[i]);
    if (!x)
      throw std::invalid_argument("'" + words[i] + "' is not a number");
    return *x;
  };
  LearnedWord result{words[0], words[1], number(3), {}, number(5)};
  for (auto i = mean_at; i < words.size(); ++i)
    result.mean.push_back(number(i));
  if (auto problem = WordLearner::problem_of(result); !problem.empty())
    throw std::invalid_argument(problem);
  return result;
}

} // namespace

std::string to_text(const std::vector<LearnedWord>& words) {
  std::string result = "# Learned words, with the statistics of their examples.\n";
  if (std::ranges::any_of(words, [](auto& x) { return x.kind == "shape"; }))
    result += "network " + this_network() + "\n";
  for (auto& x : words)
    result += fmt::format("{} {}  examples {}  scatter {}  mean {}\n", x.kind, x.word, x.examples,
                          x.scatter, fmt::join(x.mean, " "));
  return result;
}

std::vector<LearnedWord> parse_learned_words(std::string_view text, const std::string& file_name) {
  std::vector<LearnedWord> result;
  std::vector<Diagnostic> problems;
  std::string network;
  for (auto& line : text_lines(text)) {
    if (line.words.size() == 2 && line.words[0] == "network") {
      network = line.words[1];
      continue;
    }
    try {
      if (line.words[0] == "shape" && network != this_network())
        throw std::invalid_argument("this shape was learned with another shape network, whose "
                                    "numbers mean nothing to this one; it has to be taught again");
      auto word = parse(line.words);
      if (std::any_of(result.begin(), result.end(),
                      [&](auto& x) { return x.kind == word.kind && x.word == word.word; }))
        throw std::invalid_argument("there is a line for this word already");
      result.push_back(std::move(word));
    } catch (const std::invalid_argument& e) {
      problems.push_back(finding(Severity::error, file_name, line, e.what(),
                                 "Lines are: KIND WORD examples N scatter S mean NUMBER... Correct "
                                 "this line, or remove it."));
    }
  }
  if (!problems.empty())
    throw TextFileError(std::move(problems));
  return result;
}

std::vector<LearnedWord> load_learned_words(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    return {};
  return parse_learned_words(load_text(path), path.string());
}

void save_learned_words(const std::filesystem::path& path, const std::vector<LearnedWord>& words) {
  save_text(path, to_text(words));
}

} // namespace castor::vision
