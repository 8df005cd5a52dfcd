// What it costs to understand a sentence and to reply to it: parsing and packing alone, and all of
// a reply (parsing, evaluation in the scene, and the words to say), for each sentence of whole
// conversations about things on a table. As a yardstick: sorting a thousand words.
//
//   sentence_benchmark [FILE...]
//
// Files are as in tests/communication/table_sentences, whose dev.json is used if there is none.
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/spelling.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/tests/communication/sentence_set.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <exception>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// Of the processor, so that others do not disturb.
struct Clock {
  using duration = std::chrono::duration<double, std::milli>;

  static duration now() {
    return duration{1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC};
  }
};

constexpr int runs = 9;

/// Keeps results from being optimised away.
volatile std::size_t sink = 0;

struct Cost {
  double least = 0;
  double median = 0;
};

/// Milliseconds of one call, after one that is not counted: parser and realiser remember what they
/// have combined.
/// \param f returns the time that is to be counted
template <class F>
Cost cost(F&& f) {
  f();
  std::vector<double> times;
  for (int run = 0; run < runs; ++run)
    times.push_back(f().count());
  std::sort(times.begin(), times.end());
  return {times.front(), times[times.size() / 2]};
}

Cost yardstick() {
  std::mt19937 random(7);
  std::vector<std::string> words;
  for (int i = 0; i < 1000; ++i)
    words.push_back("word " + std::to_string(random()));
  return cost([&] {
    const auto begin = Clock::now();
    auto sorted = words;
    std::sort(sorted.begin(), sorted.end());
    sink = sorted.front().size();
    return Clock::now() - begin;
  });
}

std::vector<std::string> sentences_in(const test::SentenceSet& set) {
  std::vector<std::string> result;
  for (const auto& dialogue : set.dialogues)
    for (const auto& turn : dialogue.turns)
      for (auto& sentence : sentences_of(turn.said))
        result.push_back(std::move(sentence));
  return result;
}

/// \returns the number of edges
std::size_t parse(Parser& parser, const std::string& sentence) {
  auto words = words_of(sentence);
  correct_spelling(words, parser.lexicon());
  IncrementalParse parse{parser};
  for (auto& word : words)
    parse.add(std::move(word));
  parse.finish();
  sink = parse.form().readings.size();
  return parse.chart().size();
}

/// The time of all replies, without that of laying out the scenes.
Clock::duration talk(const test::SentenceSet& set) {
  Clock::duration total{};
  for (const auto& dialogue : set.dialogues) {
    test::TableScene table;
    lay_out(set.scenes.at(dialogue.scene), table);
    test::TableTalk talk{[&](auto& asked) { return table.reply(asked); }};
    const auto begin = Clock::now();
    for (const auto& turn : dialogue.turns)
      sink = talk.say(turn.said).text.size();
    total += Clock::now() - begin;
  }
  return total;
}

void print(const char* what, const Cost& x, double sentences, double unit) {
  fmt::print("{:<10} {:>8.3f} ({:>5.2f}) {:>8.3f} ({:>5.2f})\n", what, x.least / sentences,
             x.least / sentences / unit, x.median / sentences, x.median / sentences / unit);
}

void measure(const std::string& file) {
  const auto set = test::read_sentence_set(file);
  const auto sentences = sentences_in(set);
  const auto count = static_cast<double>(sentences.size());
  const double unit = yardstick().least;
  Parser parser{english_lexicon()};
  std::size_t edges = 0;
  const auto parsing = cost([&] {
    edges = 0;
    const auto begin = Clock::now();
    for (const auto& sentence : sentences)
      edges += parse(parser, sentence);
    return Clock::now() - begin;
  });
  const auto replies = cost([&] { return talk(set); });
  fmt::print("{}: {} sentences, {:.1f} edges each\n", file, sentences.size(),
             static_cast<double>(edges) / count);
  fmt::print("ms per sentence (and their ratio to those of sorting a thousand words, {:.3f} ms)\n",
             unit);
  fmt::print("{:<10} {:>16} {:>16}\n", "", "least", "median");
  print("parsing", parsing, count, unit);
  print("reply", replies, count, unit);
}

} // namespace

} // namespace castor::communication

int main(int argc, char** argv) {
  std::vector<std::string> files(argv + 1, argv + argc);
  if (files.empty())
    files.emplace_back(CASTOR_TABLE_SENTENCES "/dev.json");
  try {
    for (const auto& file : files)
      castor::communication::measure(file);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
