#include "castor/benchmarks/semeval/lexicon_training.hpp"

#include "castor/benchmarks/semeval/robot_commands/command_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <tuple>

namespace castor::semeval {

namespace {

/// What a phrase may stand for: a family of the lexicon and a predicate.
using Use = std::pair<std::string, std::string>;

/// Words that do not stand for a relation that no word was annotated with.
const std::set<std::string> no_relation = {"the", "a", "an", "which", "that", "is", "are", ","};

std::string family_of_type(const std::string& type) {
  if (type == "reference" || type == "tile")
    return type;
  if (type == "corner" || type == "edge" || type == "region" || type == "board" || type == "robot")
    return "place";
  return "block";
}

/// Finds the phrases of one command.
class Alignment {
public:
  explicit Alignment(const Command& command)
    : words_(command_tokens(command.text)), is_used_(words_.size(), false) {
    collect(command.tree);
    for (const auto* relation : unannotated_)
      guess(*relation);
  }

  const std::vector<std::string>& words() const { return words_; }
  const std::vector<bool>& is_used() const { return is_used_; }
  const std::vector<std::pair<std::string, Use>>& phrases() const { return phrases_; }

private:
  void add(const RclTree& leaf, const std::string& family) {
    const auto begin = static_cast<std::size_t>(leaf.first_token - 1);
    const auto end = static_cast<std::size_t>(leaf.last_token);
    if (leaf.first_token < 1 || begin >= end || end > words_.size())
      return;
    std::string phrase;
    for (auto i = begin; i < end; ++i) {
      phrase += (phrase.empty() ? "" : "_") + words_[i];
      is_used_[i] = true;
    }
    phrases_.emplace_back(phrase, Use{family, leaf.value});
  }

  void collect(const RclTree& tree) {
    if (tree.label == "entity") {
      const auto* type = tree.child("type");
      const bool is_implied = type != nullptr && type->value == "region" && type->first_token == 0;
      const RclTree* last_indicator = nullptr;
      for (const auto& child : tree.children)
        if (child.label == "indicator" && child.first_token > 0 &&
            (last_indicator == nullptr || child.first_token > last_indicator->first_token))
          last_indicator = &child;
      for (const auto& child : tree.children) {
        if (child.label == "type")
          add(child, family_of_type(child.value));
        else if (child.label == "indicator")
          add(child, is_implied && &child == last_indicator ? "region" : "indicator");
        else if (child.label == "color" || child.label == "cardinal")
          add(child, child.label);
      }
    } else if (const auto* action = tree.child("action")) {
      add(*action, action->value);
    } else if (const auto* relation = tree.child("relation")) {
      add(*relation, "relation");
      if (relation->first_token == 0)
        unannotated_.push_back(&tree);
    }
    for (const auto& child : tree.children)
      collect(child);
  }

  static int first_token(const RclTree& tree) {
    int first = tree.first_token == 0 ? 10000 : tree.first_token;
    for (const auto& child : tree.children)
      first = std::min(first, first_token(child));
    return first;
  }

  /// The relation is what the words before its entity say that were annotated with nothing.
  void guess(const RclTree& relation) {
    const auto* entity = relation.child("entity");
    if (entity == nullptr)
      return;
    auto begin = static_cast<std::size_t>(first_token(*entity) - 1);
    if (begin > words_.size())
      return;
    const auto end = begin;
    while (begin > 0 && !is_used_[begin - 1])
      --begin;
    for (auto i = begin; i < end; ++i)
      if (!no_relation.contains(words_[i])) {
        RclTree leaf = *relation.child("relation");
        leaf.first_token = leaf.last_token = static_cast<int>(i) + 1;
        add(leaf, "relation");
        return;
      }
  }

  std::vector<std::string> words_;
  std::vector<bool> is_used_;
  std::vector<std::pair<std::string, Use>> phrases_;
  std::vector<const RclTree*> unannotated_;
};

std::string weight(double part, double whole) {
  char text[32];
  std::snprintf(text, sizeof text, "{%.2f}", std::min(0.0, std::log(part / whole)));
  return text;
}

std::size_t word_count(const std::string& phrase) {
  return static_cast<std::size_t>(std::count(phrase.begin(), phrase.end(), '_')) + 1;
}

} // namespace

std::string learn_words(std::span<const Command* const> commands) {
  std::map<std::string, std::map<Use, int>> phrases;
  std::map<std::string, int> fillers;
  std::vector<std::vector<std::string>> sentences;
  std::size_t longest = 1;
  for (const auto* command : commands) {
    const Alignment alignment(*command);
    for (const auto& [phrase, use] : alignment.phrases()) {
      ++phrases[phrase][use];
      longest = std::max(longest, word_count(phrase));
    }
    for (std::size_t i = 0; i < alignment.words().size(); ++i)
      if (!alignment.is_used()[i])
        ++fillers[alignment.words()[i]];
    sentences.push_back(alignment.words());
  }
  std::map<std::string, int> occurrences;
  for (const auto& words : sentences)
    for (std::size_t begin = 0; begin < words.size(); ++begin) {
      std::string phrase;
      for (auto end = begin; end < std::min(begin + longest, words.size()); ++end) {
        phrase += (end == begin ? "" : "_") + words[end];
        ++occurrences[phrase];
      }
    }

  std::map<std::string, std::string> blocks;
  for (const auto& [phrase, uses] : phrases)
    for (const auto& [use, count] : uses)
      blocks[use.first] += "  " + phrase + (phrase == use.second ? "" : "=" + use.second) +
                           weight(count, occurrences[phrase]) + "\n";
  std::string text;
  for (const auto& [family, words] : blocks)
    text += "words " + family + "\n" + words;
  for (const auto& [word, count] : fillers)
    text += "filler " + word + weight(count, occurrences[word]) + "\n";
  return text;
}

} // namespace castor::semeval
