// Whatever is said, there is a reply in words: to sentences, to their beginnings and ends, to words
// in any order, to letters that are no words, to punctuation, and to nothing.
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/tests/communication/question_grid.hpp"
#include "castor/tests/communication/table_scene.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <sstream>

namespace castor::communication::test {

namespace {

using binding::FeatureKind;

#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t utterances = 300;
#else
constexpr std::size_t utterances = 2000;
#endif

class Utterances {
public:
  Utterances() {
    std::set<std::string> words;
    for (auto& entry : english_lexicon()->entries()) {
      std::string text = entry.phrase;
      std::ranges::replace(text, '_', ' ');
      std::istringstream in{text};
      for (std::string word; in >> word;)
        words.insert(word);
    }
    words_.assign(words.begin(), words.end());
    for (auto& x : question_grid())
      sentences_.push_back(x.text);
  }

  std::string next() {
    switch (number_++ % 6) {
      case 0:
        return words(1 + below(8), words_);
      case 1: {
        const auto sentence = any_of(sentences_);
        return sentence.substr(0, below(sentence.size()));
      }
      case 2: {
        const auto sentence = any_of(sentences_);
        return sentence.substr(below(sentence.size()));
      }
      case 3:
        return letters("abcdefghijklmnopqrstuvwxyz '-_()%\\\"0123456789", 1 + below(30));
      case 4:
        return letters(".,;:!?'\"- ", below(6));
      default: {
        // Two sentences or parts of them.
        const auto a = any_of(sentences_);
        const auto b = any_of(sentences_);
        return a.substr(0, below(a.size())) + ' ' + b.substr(below(b.size()));
      }
    }
  }

private:
  std::size_t below(std::size_t bound) { return random_() % bound; }

  std::string any_of(const std::vector<std::string>& from) { return from[below(from.size())]; }

  std::string words(std::size_t count, const std::vector<std::string>& from) {
    std::string result;
    for (std::size_t i = 0; i < count; ++i)
      result += (i == 0 ? "" : " ") + any_of(from);
    return result;
  }

  std::string letters(std::string_view from, std::size_t count) {
    std::string result;
    for (std::size_t i = 0; i < count; ++i)
      result += from[below(from.size())];
    return result;
  }

  std::vector<std::string> words_;
  std::vector<std::string> sentences_;
  std::size_t number_ = 0;
  std::mt19937 random_{17};
};

void put_some_things_on(TableScene& table) {
  const auto put = [&table](const std::string& id, const std::string& colour,
                            const std::string& shape, const std::string& size, double x, double y) {
    table.put(id,
              {feature(FeatureKind::colour, colour), feature(FeatureKind::shape, shape),
               feature(FeatureKind::size, size)},
              x, y);
  };
  put("ball", "red", "sphere", "small", 0, 0);
  put("other ball", "red", "sphere", "small", 0.3, 0.2);
  put("box", "blue", "cube", "large", 0.2, 0);
  table.put("blob", {feature(FeatureKind::colour, "grey")}, 0.5, 0.5);
  table.relate("left", "ball", "box");
  table.relate("right", "box", "ball");
}

} // namespace

TEST(AnyUtterance, IsRepliedToInWords) {
  TableScene table;
  put_some_things_on(table);
  Utterances generated;
  // In one conversation, so that replies depend on what was said before.
  TableTalk talk{[&](auto& asked) { return table.reply(asked); }};
  for (std::size_t i = 0; i < utterances; ++i) {
    const auto text = generated.next();
    const auto reply = talk.say(text);
    EXPECT_FALSE(reply.text.empty()) << '"' << text << '"';
    EXPECT_EQ(reply.silences, 0u) << '"' << text << "\": " << reply.text;
    if (i % 50 == 49)
      talk = TableTalk{[&](auto& asked) { return table.reply(asked); }};
    // In two of three conversations somebody points, in one of them at nothing.
    if (const auto conversation = (i + 1) / 50 % 3; conversation != 0)
      talk.point({conversation == 1 ? 0.0 : 2.0, 0, {}, true});
  }
}

} // namespace castor::communication::test
