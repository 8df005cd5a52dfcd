#include "castor/communication/dialogue/realiser.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/realisation_target.hpp"
#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cctype>
#include <deque>
#include <limits>
#include <queue>
#include <set>
#include <span>
#include <sstream>
#include <tuple>
#include <utility>

namespace castor::communication {

namespace {

/// So that nothing is raised that need not be.
constexpr double raising_cost = 0.01;

/// Words that are put together, and what they say of the target.
struct PartialSentence {
  std::uint64_t coverage = 0;
  CategoryId category = 0;
  std::vector<TargetIndex> indices;
  /// Words, less the weights of their entries.
  double cost = 0;
  /// Of equal costs, words are said in the lexicon's order.
  std::vector<std::uint32_t> entries;
  /// The words of one entry; empty if the sentence has parts.
  std::string text;
  /// Null if there are none.
  const PartialSentence* left = nullptr;
  const PartialSentence* right = nullptr;
};

std::string text_of(const PartialSentence& sentence) {
  if (sentence.left == nullptr)
    return sentence.text;
  const auto text = text_of(*sentence.left);
  return sentence.right == nullptr ? text : text + ' ' + text_of(*sentence.right);
}

std::size_t word_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), ' ')) + 1;
}

/// Gives every free index the number that it has in order, so that equal sentences look equal.
void canonicalise(std::vector<TargetIndex>& indices) {
  std::vector<TargetIndex> free;
  for (auto& index : indices)
    if (index < 0) {
      const auto known = std::find(free.begin(), free.end(), index);
      const auto number = static_cast<TargetIndex>(known - free.begin());
      if (known == free.end())
        free.push_back(index);
      index = -1 - number;
    }
}

/// What free indices of two parts are bound to when these are combined.
class IndexSubstitution {
public:
  /// \returns false if these are different nominals
  bool unify(TargetIndex a, TargetIndex b) {
    a = resolve(a);
    b = resolve(b);
    if (a == b)
      return true;
    if (a >= 0 && b >= 0)
      return false;
    bound_.emplace_back(a < 0 ? a : b, a < 0 ? b : a);
    return true;
  }

  TargetIndex resolve(TargetIndex index) const {
    while (index < 0) {
      const auto known =
        std::ranges::find(bound_, index, [](const auto& pair) { return pair.first; });
      if (known == bound_.end())
        break;
      index = known->second;
    }
    return index;
  }

private:
  std::vector<std::pair<TargetIndex, TargetIndex>> bound_;
};

/// The indices of a combination; nothing if two that meet are different nominals.
std::optional<std::vector<TargetIndex>> unite(const std::vector<TargetIndex>& function,
                                              const std::vector<TargetIndex>& argument,
                                              std::size_t result_atoms) {
  // Lower than those of the function.
  const auto of_argument = [&argument](std::size_t i) {
    constexpr TargetIndex apart = 1000;
    return argument[i] < 0 ? argument[i] - apart : argument[i];
  };
  IndexSubstitution same;
  const auto shared = function.size() - result_atoms;
  for (std::size_t i = 0; i < shared; ++i)
    if (!same.unify(function[result_atoms + i], of_argument(i)))
      return std::nullopt;
  std::vector<TargetIndex> result;
  result.reserve(result_atoms + argument.size() - shared);
  for (std::size_t i = 0; i < result_atoms; ++i)
    result.push_back(same.resolve(function[i]));
  for (std::size_t i = shared; i < argument.size(); ++i)
    result.push_back(same.resolve(of_argument(i)));
  canonicalise(result);
  return result;
}

/// Most sentences need application only, which makes far fewer partial ones.
enum class Combining { application, all };

class Realisation {
public:
  /// \param words all that may be of use, in the lexicon's order
  Realisation(const RealisationTarget& target, std::span<const std::uint32_t> words,
              CombinatoryGrammar& grammar, std::size_t limit, Combining combining)
    : target_(target), words_(words), grammar_(grammar), limit_(limit), combining_(combining) {
    // nop
  }

  std::optional<std::string> find() {
    add_words();
    while (!agenda_.empty() && done_.size() < limit_) {
      const auto& sentence = *agenda_.top();
      agenda_.pop();
      if (is_complete(sentence))
        return text_of(sentence);
      if (!seen_.insert({sentence.category, sentence.indices, sentence.coverage}).second)
        continue;
      if (combining_ == Combining::all)
        raise(sentence);
      done_.push_back(&sentence);
      for (const auto* other : done_)
        if ((other->coverage & sentence.coverage) == 0) {
          combine(*other, sentence);
          if (other != &sentence)
            combine(sentence, *other);
        }
    }
    return std::nullopt;
  }

private:
  struct CostsMore {
    bool operator()(const PartialSentence* a, const PartialSentence* b) const {
      return std::tie(a->cost, a->entries) > std::tie(b->cost, b->entries);
    }
  };

  void add(PartialSentence sentence) {
    made_.push_back(std::move(sentence));
    agenda_.push(&made_.back());
  }

  void add_words() {
    for (const auto number : words_) {
      const auto& entry = grammar_.lexicon.entry(number);
      for (auto& use : target_.uses(entry)) {
        canonicalise(use.indices);
        const auto cost = static_cast<double>(word_count(use.text)) - entry.weight;
        add({use.coverage,
             entry.category,
             std::move(use.indices),
             cost,
             {number},
             std::move(use.text)});
      }
    }
  }

  bool is_complete(const PartialSentence& sentence) const {
    if (sentence.coverage != target_.all() || sentence.indices.front() != target_.root())
      return false;
    return grammar_.is_root(sentence.category);
  }

  /// Whether something remains to be said of a nominal that nothing more can be said of.
  bool is_left_behind(const std::vector<TargetIndex>& before, const std::vector<TargetIndex>& after,
                      std::uint64_t coverage) const {
    return std::any_of(before.begin(), before.end(), [&](TargetIndex index) {
      return index >= 0 && (target_.about(index) & ~coverage) != 0 &&
             std::find(after.begin(), after.end(), index) == after.end();
    });
  }

  /// \pre nothing is said by both
  void combine(const PartialSentence& left, const PartialSentence& right) {
    for (const auto& how : grammar_.combinators.combine(left.category, right.category)) {
      if (combining_ == Combining::application && is_composition(how.combinator))
        continue;
      const auto& function = is_forward(how.combinator) ? left : right;
      const auto& argument = is_forward(how.combinator) ? right : left;
      auto indices = unite(function.indices, argument.indices, how.result_atoms);
      const auto coverage = left.coverage | right.coverage;
      if (!indices || is_left_behind(function.indices, *indices, coverage) ||
          is_left_behind(argument.indices, *indices, coverage))
        continue;
      auto entries = left.entries;
      entries.insert(entries.end(), right.entries.begin(), right.entries.end());
      add({coverage,
           how.result,
           std::move(*indices),
           left.cost + right.cost,
           std::move(entries),
           {},
           &left,
           &right});
    }
  }

  void raise(const PartialSentence& sentence) {
    constexpr TargetIndex free_result = std::numeric_limits<TargetIndex>::min() / 2;
    PartialSentence raised = sentence;
    raised.cost += raising_cost;
    raised.left = &sentence;
    raised.right = nullptr;
    raised.indices.insert(raised.indices.begin(), {free_result, free_result});
    canonicalise(raised.indices);
    for (const auto category : grammar_.raised(sentence.category)) {
      raised.category = category;
      add(raised);
    }
  }

  const RealisationTarget& target_;
  std::span<const std::uint32_t> words_;
  CombinatoryGrammar& grammar_;
  std::size_t limit_;
  Combining combining_;
  /// A deque, because the others point into it.
  std::deque<PartialSentence> made_;
  std::priority_queue<const PartialSentence*, std::vector<const PartialSentence*>, CostsMore>
    agenda_;
  std::vector<const PartialSentence*> done_;
  std::set<std::tuple<CategoryId, std::vector<TargetIndex>, std::uint64_t>> seen_;
};

/// Writes words as people do: a capital at the beginning, "an" before vowels, no blank before what
/// is written together with the word before it.
std::string sentence_written(const std::string& words, DialogueMoveType move) {
  std::istringstream in(words);
  std::vector<std::string> parts;
  for (std::string word; in >> word;)
    parts.push_back(word);
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto word = parts[i];
    if (word == "a" && i + 1 < parts.size() && begins_with_vowel(parts[i + 1]))
      word = "an";
    if (word == "i")
      word = "I";
    const bool is_joined = word == "n't" || (word.front() == '\'' && word.back() != '\'');
    text += (text.empty() || is_joined ? "" : " ") + word;
    const bool is_marker = i == 0 && parts.size() > 1 &&
                           (word == "yes" || word == "no" || word == "ok" || word == "hello") &&
                           move != DialogueMoveType::none;
    if (is_marker)
      text += ",";
  }
  if (!text.empty())
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  const bool asks = move == DialogueMoveType::question_w || move == DialogueMoveType::question_yn;
  return text + (asks ? "?" : ".");
}

/// The list at the end of a sentence, such as "there is a ball, a cube and a disc" or "they are
/// red, green and blue".
struct FinalList {
  /// The sentence with the first item only.
  LogicalForm sentence;
  /// The others.
  std::vector<LogicalForm> rest;
};

/// Nothing for other sentences.
std::optional<FinalList> final_list(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  if (root == nullptr || is_negated(*root))
    return std::nullopt;
  const std::string mode = root->sort == "existence" ? "Subject" : "Cop-Scope";
  const auto is_list = [](const Nominal& x) {
    return x.sort == "conjunction" && x.proposition == "and" && x.features.empty() &&
           x.relations.size() == 2;
  };
  const auto* rest = dependent(form, *root, mode);
  if (rest == nullptr || !is_list(*rest) || dependent(form, *rest, "First") == nullptr)
    return std::nullopt;
  FinalList result;
  auto shorter = form;
  for (auto& x : shorter.nominals)
    for (auto& relation : x.relations)
      if (x.name == form.root && relation.mode == mode)
        relation.dependent = dependent(form, *rest, "First")->name;
  result.sentence = part_of(shorter, form.root);
  for (rest = dependent(form, *rest, "Next"); rest != nullptr;) {
    const auto* item = is_list(*rest) ? dependent(form, *rest, "First") : rest;
    if (item == nullptr || item->sort == "conjunction")
      return std::nullopt;
    result.rest.push_back(part_of(form, item->name));
    rest = item == rest ? nullptr : dependent(form, *rest, "Next");
  }
  return result;
}

} // namespace

Realiser::Realiser(std::shared_ptr<const Lexicon> lexicon, RealiserLimits limits)
  : lexicon_(std::move(lexicon)), limits_(limits), grammar_(*lexicon_), entries_(*lexicon_) {
  // nop
}

std::optional<std::string> Realiser::realise(const LogicalForm& form) {
  const auto list = final_list(form);
  if (!list)
    return realise_whole(form);
  auto text = realise_whole(list->sentence);
  for (auto& x : list->rest) {
    auto item = realise_whole(x);
    if (!item || !text)
      return std::nullopt;
    item->front() = static_cast<char>(std::tolower(static_cast<unsigned char>(item->front())));
    item->pop_back();
    text->pop_back();
    *text += (&x == &list->rest.back() ? " and " : ", ") + *item + '.';
  }
  return text;
}

std::optional<std::string> Realiser::realise_whole(const LogicalForm& form) {
  const RealisationTarget target(form, *lexicon_);
  if (!target.is_sayable())
    return std::nullopt;
  const auto words = entries_.candidates(target.predications());
  for (const auto combining : {Combining::application, Combining::all})
    if (const auto said = Realisation(target, words, grammar_, limits_.edges, combining).find())
      return sentence_written(*said, dialogue_move_type(form));
  return std::nullopt;
}

} // namespace castor::communication
