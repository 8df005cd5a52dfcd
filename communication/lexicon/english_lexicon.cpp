#include "castor/communication/lexicon/english_lexicon.hpp"

#include "castor/base/shared_text.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace castor::communication {

std::string_view english_lexicon_text();
std::string_view actions_text();
std::string_view paraphrases_text();
std::string_view examples_text();
std::string_view tabletop_words_text();

namespace {

std::shared_ptr<const Lexicon> lexicon_of(const std::vector<NamedText>& files) {
  auto read = read_lexicon(files);
  if (!read.problems.empty())
    throw std::runtime_error("the lexicon has errors\n" + render(read.problems));
  return read.lexicon;
}

} // namespace

const std::vector<NamedText>& shared_lexicon_files() {
  static const std::vector<NamedText> files{{"english.ccg", std::string{english_lexicon_text()}},
                                            {"actions.ccg", std::string{actions_text()}},
                                            {"paraphrases.words", std::string{paraphrases_text()}},
                                            {"examples.words", std::string{examples_text()}},
                                            {"tabletop.words", std::string{tabletop_words_text()}}};
  return files;
}

std::shared_ptr<const Lexicon> english_lexicon() {
  static const auto lexicon = lexicon_of(shared_lexicon_files());
  return lexicon;
}

std::shared_ptr<const Lexicon> lexicon_of_files(const std::string& names,
                                                const std::string& folder) {
  std::vector<NamedText> files;
  std::istringstream in{names};
  for (std::string name; in >> name;)
    files.push_back(read_or_shared("the lexicon", name, folder, shared_lexicon_files()));
  const auto& shared = shared_lexicon_files();
  if (std::ranges::equal(files, shared, {}, &NamedText::text, &NamedText::text))
    return english_lexicon();
  // All components of a process that have the same files use one lexicon.
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const Lexicon>> known;
  std::string key;
  for (auto& x : files)
    key += x.name + '\0' + x.text + '\0';
  const std::scoped_lock guard{mutex};
  auto& entry = known[key];
  auto result = entry.lock();
  if (!result)
    entry = result = lexicon_of(files);
  return result;
}

} // namespace castor::communication
