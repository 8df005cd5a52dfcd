#include "castor/communication/parsing/lexicon_reader.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"
#include "castor/communication/parsing/family.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/line_pieces.hpp"
#include "castor/communication/parsing/word_meanings.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <stdexcept>

namespace castor::communication {

namespace {

/// Longer files are no lexicons.
constexpr std::size_t max_bytes = std::size_t{4} << 20;

/// Variables of an entry are numbered in a byte.
constexpr std::size_t max_variables = 60;

const std::vector<std::string_view> keywords = {
  "feature", "root",    "raise",       "call",         "filler",  "aside",     "frame",   "person",
  "name",    "telling", "decisive",    "reason",       "comment", "agreement", "refusal", "family",
  "words",   "nouns",   "paraphrases", "replacements", "list",    "examples"};

const std::map<std::string_view, WordClass> word_classes = {
  {"aside", WordClass::aside},         {"frame", WordClass::frame},
  {"person", WordClass::person},       {"name", WordClass::name},
  {"telling", WordClass::telling},     {"decisive", WordClass::decisive},
  {"reason", WordClass::reason},       {"comment", WordClass::comment},
  {"agreement", WordClass::agreement}, {"refusal", WordClass::refusal}};

/// Takes "{-1.5}" off the end of a piece.
double take_weight(Piece& piece) {
  while (!piece.text.empty() && piece.text.back() == ' ')
    piece.text.pop_back();
  const auto begin = piece.text.rfind('{');
  if (piece.text.empty() || piece.text.back() != '}' || begin == std::string::npos)
    return 0;
  double weight = 0;
  const auto* first = piece.text.data() + begin + 1;
  const auto* last = piece.text.data() + piece.text.size() - 1;
  const auto [end, error] = std::from_chars(first, last, weight);
  if (error != std::errc{} || end != last || !(weight > -1e6 && weight < 1e6))
    fail(piece, "a weight is a number", "Write it as in {-1.5}.", begin);
  piece.text.erase(begin);
  return weight;
}

class LexiconReader {
public:
  LexiconText read(std::span<const NamedText> files) {
    for (auto& file : files)
      read_file(file);
    if (problems_.empty() && lexicon_->roots().empty())
      report({1, 1, "nothing says what an utterance may be", "Add a line such as: root s np"});
    return {problems_.empty() ? lexicon_ : nullptr, std::move(problems_)};
  }

private:
  /// What belongs to a line that is wrong itself is skipped.
  enum class Block { none, skipped, family, words, nouns, paraphrases, replacements, examples };

  void read_file(const NamedText& file) {
    file_name_ = file.name;
    lines_.clear();
    block_ = Block::none;
    const auto before = static_cast<std::ptrdiff_t>(problems_.size());
    std::string_view text = file.text;
    if (text.size() > max_bytes) {
      report({1, 1, "this is longer than 4 MiB", "Give the name of a lexicon."});
      return;
    }
    int number = 0;
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      lines_.emplace_back(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      guarded([&] { read_line(lines_.back(), ++number); });
    }
    guarded([&] { end_family_line(); });
    std::ranges::stable_sort(problems_.begin() + before, problems_.end(), {}, [](auto& x) {
      return std::pair{x.where.line(), x.column};
    });
  }

  template <class F>
  void guarded(F&& f) {
    try {
      f();
    } catch (const ReadError& error) {
      report(error);
    }
  }

  void report(const ReadError& error) {
    const auto line = static_cast<std::size_t>(error.line);
    Diagnostic found;
    found.where = {file_name_, line};
    found.column = static_cast<std::size_t>(error.column);
    if (line > 0 && line <= lines_.size())
      found.line = lines_[line - 1];
    found.message = error.message;
    found.remedy = error.remedy;
    problems_.push_back(std::move(found));
  }

  void read_line(const std::string& line, int number) {
    const Piece content{line.substr(0, line.find('#')), number, 1};
    const auto pieces = split(content);
    if (pieces.empty())
      return;
    const bool is_indented = pieces.front().column > 1;
    if (is_indented && is_continuation(pieces.front().text)) {
      if (!family_line_)
        fail(pieces.front(), "nothing comes before this that could go on", "Remove this line.");
      continue_family_line(content);
      return;
    }
    end_family_line();
    if (!is_indented)
      read_keyword(pieces);
    else if (block_ == Block::family)
      family_line_ = content;
    else if (block_ == Block::none)
      fail(pieces.front(), "an indented line belongs to nothing",
           "Write \"family NAME\" or \"words FAMILY\" before it, or do not indent it.");
    else if (block_ == Block::paraphrases || block_ == Block::replacements)
      read_paraphrase(content, pieces.front());
    else if (block_ == Block::examples)
      read_example(content, pieces.front());
    else if (block_ != Block::skipped)
      for (const auto& piece : pieces)
        guarded([&] { read_word(piece); });
  }

  static bool is_continuation(const std::string& word) {
    return word.front() == ':' || word.front() == '^' || word.front() == '&';
  }

  /// Columns are kept: the line goes on where the other ends, as far as the reader can tell.
  void continue_family_line(const Piece& content) {
    family_line_->text += ' ' + content.text.substr(content.text.find_first_not_of(" \t"));
  }

  void read_keyword(const std::vector<Piece>& pieces) {
    const auto& keyword = pieces.front();
    block_ = Block::skipped;
    const std::vector<Piece> rest(pieces.begin() + 1, pieces.end());
    if (keyword.text == "paraphrases" || keyword.text == "replacements") {
      block_ = keyword.text == "paraphrases" ? Block::paraphrases : Block::replacements;
      return;
    }
    const bool is_meaning = is_meaning_keyword(keyword.text);
    if (!is_meaning && std::find(keywords.begin(), keywords.end(), keyword.text) == keywords.end())
      fail(keyword, "\"" + keyword.text + "\" does not begin a line",
           unknown_keyword_remedy(keyword.text));
    if (rest.empty())
      fail(keyword, "something is missing after \"" + keyword.text + "\"",
           "See the head of lexicon_reader.hpp for what it takes.");
    if (keyword.text == "family")
      return begin_family(rest);
    if (keyword.text == "examples") {
      block_ = Block::examples;
      example_meaning_.clear();
      for (const auto& piece : rest)
        example_meaning_ += piece.text + ' ';
      return;
    }
    if (keyword.text == "words" || keyword.text == "nouns")
      return begin_words(rest.front(), keyword.text == "nouns" ? Block::nouns : Block::words);
    block_ = Block::none;
    if (is_meaning)
      read_meaning(keyword, rest, lexicon_->meanings());
    else if (keyword.text == "feature")
      read_feature(rest);
    else if (keyword.text == "root")
      for (const auto& piece : rest)
        lexicon_->add_root(category(piece).category);
    else if (keyword.text == "raise")
      read_raising(rest);
    else if (keyword.text == "call")
      read_name(rest);
    else if (keyword.text == "list")
      read_list(rest);
    else if (const auto word_class = word_classes.find(keyword.text);
             word_class != word_classes.end())
      for (const auto& piece : rest)
        lexicon_->add_to(word_class->second, phrase_of(piece.text));
    else
      read_fillers(rest);
  }

  static std::string unknown_keyword_remedy(const std::string& word) {
    auto known = keywords;
    known.insert(known.end(), meaning_keywords().begin(), meaning_keywords().end());
    const auto meant = did_you_mean(word, known);
    if (!meant.empty())
      return meant;
    std::string list;
    for (const auto& x : known)
      list += (list.empty() ? "" : x == known.back() ? " or " : ", ") + std::string{x};
    return "Lines begin with " + list + "; what belongs to them is indented.";
  }

  void read_paraphrase(const Piece& line, const Piece& first) {
    try {
      lexicon_->add_paraphrase(Paraphrase{line.text, lists_}, block_ == Block::replacements);
    } catch (const std::invalid_argument& error) {
      fail(first, error.what(), "Write it as in: give X a push|shove = push X");
    }
  }

  void read_example(const Piece& line, const Piece& first) {
    try {
      lexicon_->add_example(example_meaning_, line.text);
    } catch (const std::invalid_argument& error) {
      fail(first, error.what(),
           "Write below \"examples give me X\" sentences such as: i need X over here");
    }
  }

  void read_feature(const std::vector<Piece>& pieces) {
    if (declarations_.find(pieces.front().text) < declarations_.features.size())
      fail(pieces.front(), "this feature is declared twice", "Put all its values in one line.");
    if (declarations_.features.size() == max_features)
      fail(pieces.front(), "there are more than " + std::to_string(max_features) + " features",
           "Leave one out.");
    FeatureDeclarations::Feature feature{pieces.front().text, {}};
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      if (declarations_.find_value(pieces[i].text) < declarations_.features.size())
        fail(pieces[i], "another feature has this value", "Give it another name.");
      feature.values.push_back(pieces[i].text);
    }
    declarations_.features.push_back(std::move(feature));
  }

  void read_raising(const std::vector<Piece>& pieces) {
    if (pieces.size() < 3 || pieces[1].text != "over")
      fail(pieces.front(), "it does not say what is raised over what",
           "Write: raise CATEGORY over CATEGORY");
    for (std::size_t i = 2; i < pieces.size(); ++i) {
      const auto result = category(pieces[i]).category;
      if (!result.arguments.empty())
        fail(pieces[i], "this is no atomic category", "Name one without slashes.");
      lexicon_->add_raising({category(pieces.front()).category, result.result});
    }
  }

  void read_name(const std::vector<Piece>& pieces) {
    if (pieces.size() < 2)
      fail(pieces.front(), "it does not say what this is called", "Write: call CATEGORY NAME");
    CategoryName name{category(pieces.front()).category, pieces[1].text};
    for (std::size_t i = 2; i < pieces.size(); ++i)
      name.name += " " + pieces[i].text;
    lexicon_->add_name(std::move(name));
  }

  void read_list(const std::vector<Piece>& pieces) {
    if (pieces.size() != 2)
      fail(pieces.front(), "a list has a name and words", "Write it as in: list side left|right");
    if (!lists_.emplace(pieces.front().text, pieces.back().text).second)
      fail(pieces.front(), "there is a list \"" + pieces.front().text + "\" already",
           "Give it another name.");
  }

  void read_fillers(const std::vector<Piece>& pieces) {
    for (auto piece : pieces) {
      const double weight = take_weight(piece);
      lexicon_->add_filler(phrase_of(piece.text), weight);
    }
  }

  void begin_family(const std::vector<Piece>& pieces) {
    const auto& name = pieces.front().text;
    if (!families_.emplace(name, Family{name, {}}).second)
      fail(pieces.front(), "there is a family \"" + name + "\" already", "Give it another name.");
    family_ = &families_[name];
    block_ = Block::family;
  }

  IndexedCategory category(const Piece& piece) {
    try {
      return parse_category(piece.text, declarations_, lexicon_->symbols());
    } catch (const CategoryError& error) {
      fail(piece, error.what(), error.remedy(), error.offset());
    }
  }

  void end_family_line() {
    if (!family_line_)
      return;
    auto line = *std::exchange(family_line_, std::nullopt);
    const auto begin = line.text.find_first_not_of(" \t");
    line.text.erase(0, begin);
    line.column += static_cast<int>(begin);
    FamilyEntry entry;
    entry.weight = take_weight(line);
    const auto colon = line.text.find(" : ");
    entry.category = category({line.text.substr(0, colon), line.line, line.column});
    if (colon != std::string::npos) {
      const Piece meaning{line.text.substr(colon + 3), line.line,
                          line.column + static_cast<int>(colon) + 3};
      try {
        entry.meaning = parse_logical_form(meaning.text);
      } catch (const HybridLogicError& error) {
        fail(meaning, error.what(), "Meanings look like @x:thing(ball ^ <Number>sg).",
             error.offset());
      }
    }
    if (entry.meaning.nominals.size() + entry.category.indices.size() > max_variables)
      fail(line, "this entry has too many variables", "Make several of it.");
    family_->entries.push_back(std::move(entry));
  }

  void begin_words(const Piece& piece, Block block) {
    const auto bracket = piece.text.find('[');
    const auto name = piece.text.substr(0, bracket);
    const auto known = families_.find(name);
    if (known == families_.end()) {
      std::vector<std::string_view> names;
      for (const auto& family : families_)
        names.push_back(family.first);
      const auto meant = did_you_mean(name, names);
      fail(piece, "there is no family \"" + name + "\"",
           meant.empty() ? "Write \"family " + name + "\" before it." : meant);
    }
    family_ = &known->second;
    word_features_.clear();
    if (bracket != std::string::npos) {
      auto values = piece.text.substr(bracket + 1);
      if (values.empty() || values.back() != ']')
        fail(piece, "a bracket is not closed", "Add \"]\".", bracket);
      values.pop_back();
      std::replace(values.begin(), values.end(), ',', ' ');
      for (const auto& value : split({values, piece.line, piece.column})) {
        if (declarations_.find_value(value.text) == declarations_.features.size())
          fail(piece, "no feature has the value \"" + value.text + "\"",
               "Add it to a line that begins with \"feature\".", bracket);
        word_features_.push_back(value.text);
      }
    }
    block_ = block;
  }

  void read_word(Piece piece) {
    FamilyWord word;
    word.features = word_features_;
    word.weight = take_weight(piece);
    const auto equals = piece.text.find('=');
    auto form = piece.text.substr(0, equals);
    if (form.empty() || (equals != std::string::npos && equals + 1 == piece.text.size()))
      fail(piece, "there is no word", "Write WORD or WORD=PREDICATE.");
    std::string plural;
    if (block_ == Block::nouns) {
      const auto slash = form.find('/');
      plural = slash == std::string::npos ? plural_of(form) : form.substr(slash + 1);
      form.erase(std::min(slash, form.size()));
    }
    word.predicate = equals == std::string::npos ? form : piece.text.substr(equals + 1);
    add(form, word, "sg");
    if (!plural.empty())
      add(plural, word, "pl");
  }

  void add(std::string form, FamilyWord word, const std::string& number) {
    std::replace(form.begin(), form.end(), '_', ' ');
    word.phrase = std::move(form);
    if (block_ == Block::nouns && declarations_.find_value(number) < declarations_.features.size())
      word.features.push_back(number);
    add_word(*family_, word, declarations_, *lexicon_);
  }

  std::string file_name_;
  std::vector<std::string> lines_;
  std::vector<Diagnostic> problems_;
  std::shared_ptr<Lexicon> lexicon_ = std::make_shared<Lexicon>();
  FeatureDeclarations declarations_;
  std::map<std::string, Family, std::less<>> families_;
  Paraphrase::Lists lists_;
  /// That the examples which follow have.
  std::string example_meaning_;
  Family* family_ = nullptr;
  std::optional<Piece> family_line_;
  std::vector<std::string> word_features_;
  Block block_ = Block::none;
};

} // namespace

LexiconText read_lexicon(std::span<const NamedText> files) {
  return LexiconReader{}.read(files);
}

LexiconText read_lexicon(std::string_view text, const std::string& file_name) {
  const NamedText file{file_name, std::string{text}};
  return read_lexicon({&file, 1});
}

} // namespace castor::communication
