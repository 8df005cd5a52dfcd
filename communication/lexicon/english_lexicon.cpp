#include "castor/communication/lexicon/english_lexicon.hpp"

#include "castor/base/input_file.hpp"
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
std::string_view tabletop_words_text();

namespace {

std::string names_of(const std::vector<NamedText>& files) {
  std::string result;
  for (auto& x : files)
    result += (result.empty() ? "" : ", ") + x.name;
  return result;
}

NamedText text_of(const std::string& name, const std::string& folder) {
  const auto& shared = shared_lexicon_files();
  const auto file = std::filesystem::path{folder} / name;
  try {
    return {name, read_input_file(file)};
  } catch (const InputFileError& e) {
    const auto known = std::ranges::find(shared, name, &NamedText::name);
    if (known != shared.end() && e.reason() == InputFileError::Reason::missing)
      return *known;
    throw std::runtime_error("the lexicon " + file.string() + " cannot be read: " + e.what() +
                             ". Name a file, or one that comes with Castor: " + names_of(shared));
  }
}

std::shared_ptr<const Lexicon> lexicon_of(const std::vector<NamedText>& files) {
  auto read = read_lexicon(files);
  if (!read.problems.empty())
    throw std::runtime_error("the lexicon has errors\n" + render(read.problems));
  return read.lexicon;
}

} // namespace

const std::vector<NamedText>& shared_lexicon_files() {
  static const std::vector<NamedText> files{{"english.ccg", std::string{english_lexicon_text()}},
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
    files.push_back(text_of(name, folder));
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
