#include "castor/tools/timeline/summary.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

namespace castor::timeline {

namespace {

using Json = nlohmann::ordered_json;

/// What is told, the most telling first.
enum class SnippetRank { speech, list, word, link, truth, number, count };

/// Hypotheses that are less sure than this are left out of lists.
constexpr double least_confidence = 0.1;

struct Snippet {
  SnippetRank rank;
  std::string text;
};

/// Longer lists are counted.
constexpr std::size_t most_records = 12;
constexpr std::size_t most_words = 4;
constexpr std::size_t most_numbers = 4;

const std::string arrow = "\u2192 ";

/// Fields whose names say no more than their values.
bool names_itself(std::string_view field) {
  static constexpr std::array<std::string_view, 17> names{
    "value", "text", "label",   "name",   "kind",    "type", "relation",    "mode", "number",
    "data",  "sort", "address", "source", "numbers", "root", "proposition", "state"};
  return std::ranges::find(names, field) != names.end();
}

bool is_time(std::string_view field) {
  return field == "time" || field.ends_with("_time") || field.ends_with(" time");
}

std::string words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string named(const std::string& field, const std::string& value) {
  return names_itself(field) || field.empty() ? value : words(field) + ' ' + value;
}

std::string number(const Json& x) {
  return x.is_number_float() ? fmt::format("{:.2g}", x.get<double>()) : x.dump();
}

bool is_zero(const Json& x) {
  return x.is_number() && x.get<double>() == 0;
}

bool are_zeros(const Json& x) {
  return std::all_of(x.begin(), x.end(), is_zero);
}

bool all(const Json& x, bool (Json::*is)() const noexcept) {
  return std::all_of(x.begin(), x.end(), [&](const Json& y) { return (y.*is)(); });
}

/// "(0.1, 0.2, 0)"
std::string tuple(const Json& x) {
  std::string result;
  for (auto& y : x)
    result += (result.empty() ? "" : ", ") + number(y);
  return '(' + result + ')';
}

bool is_picture(const Json& x) {
  return x.is_object() && x.size() == 4 && x.contains("width") && x.contains("height") &&
         x.contains("channels") && x.contains("bytes");
}

bool is_address(const Json& x) {
  return x.is_object() && x.size() == 2 && x.contains("subarchitecture") && x.contains("id");
}

/// A word and how sure it is.
struct Hypothesis {
  std::string word;
  double confidence = 0;

  std::string text() const {
    return word.empty() || confidence == 0 ? word : fmt::format("{} {:.2g}", word, confidence);
  }
};

std::optional<Hypothesis> hypothesis(const Json& x) {
  if (!x.is_object() || x.size() != 2)
    return std::nullopt;
  const Json* word = nullptr;
  const Json* value = nullptr;
  for (auto& y : x) {
    if (y.is_string())
      word = &y;
    if (y.is_number())
      value = &y;
  }
  if (!word || !value)
    return std::nullopt;
  return Hypothesis{word->get<std::string>(), value->get<double>()};
}

class Teller {
public:
  explicit Teller(const IsId& is_id) : is_id_(is_id) {}

  void tell(const std::string& field, const Json& x, std::vector<Snippet>& into) const {
    if (is_time(field) || is_picture(x))
      return;
    auto add = [&](SnippetRank rank, const std::string& text) {
      if (!text.empty())
        into.push_back({rank, text});
    };
    if (x.is_string())
      tell_text(field, x.get<std::string>(), into);
    else if (x.is_boolean())
      add(SnippetRank::truth, x.get<bool>() ? words(field) : "");
    else if (x.is_number())
      add(SnippetRank::number, is_zero(x) ? "" : words(field) + ' ' + number(x));
    else if (is_address(x))
      tell_address(field, x, into);
    else if (x.is_object())
      tell_record(field, x, into);
    else if (x.is_array() && !x.empty())
      tell_list(field, x, into);
  }

private:
  void tell_text(const std::string& field, const std::string& x, std::vector<Snippet>& into) const {
    if (x.empty())
      return;
    if (is_id_(x))
      into.push_back({SnippetRank::link, named(field, arrow + x)});
    else if (x.find(' ') != std::string::npos && !names_itself(field))
      into.push_back({SnippetRank::speech, "\u201c" + x + "\u201d"});
    else
      into.push_back({SnippetRank::word, named(field, x)});
  }

  static void tell_address(const std::string& field, const Json& x, std::vector<Snippet>& into) {
    auto id = x["id"].get<std::string>();
    if (!id.empty())
      into.push_back({SnippetRank::link,
                      named(field, arrow + x["subarchitecture"].get<std::string>() + '/' + id)});
  }

  void tell_record(const std::string& field, const Json& x, std::vector<Snippet>& into) const {
    if (auto word = hypothesis(x)) {
      if (auto text = word->text(); !text.empty())
        into.push_back({SnippetRank::word, named(field, text)});
    } else if (all(x, &Json::is_number)) {
      if (!are_zeros(x))
        into.push_back({SnippetRank::number, named(field, tuple(x))});
    } else {
      auto rank = SnippetRank::count;
      auto text = in_line(x, {}, &rank);
      if (!text.empty())
        into.push_back({rank, named(field, text)});
    }
  }

  void tell_list(const std::string& field, const Json& x, std::vector<Snippet>& into) const {
    if (all(x, &Json::is_number)) {
      if (are_zeros(x))
        return;
      auto text = x.size() <= most_numbers ? named(field, tuple(x))
                                           : fmt::format("{} {}", x.size(), words(field));
      into.push_back({x.size() <= most_numbers ? SnippetRank::number : SnippetRank::count, text});
    } else if (all(x, &Json::is_string) && x.size() <= most_words) {
      std::string text;
      bool are_ids = true;
      for (auto& y : x) {
        text += (text.empty() ? "" : ", ") + y.get<std::string>();
        are_ids = are_ids && is_id_(y);
      }
      into.push_back({are_ids ? SnippetRank::link : SnippetRank::word,
                      named(field, are_ids ? arrow + text : text)});
    } else if (std::all_of(x.begin(), x.end(), [](auto& y) { return hypothesis(y).has_value(); })) {
      std::string text;
      for (auto& y : x)
        if (auto word = hypothesis(y); word->confidence >= least_confidence)
          text += (text.empty() ? "" : ", ") + word->text();
      if (!text.empty())
        into.push_back({SnippetRank::list, named(field, text)});
    } else if (all(x, &Json::is_object) && x.size() <= most_records) {
      tell_records(x, into);
    } else {
      into.push_back({SnippetRank::count, fmt::format("{} {}", x.size(), words(field))});
    }
  }

  /// First what they say in words, then what they lead to, then what is not so.
  void tell_records(const Json& x, std::vector<Snippet>& into) const {
    auto usual = usual_truths(x);
    std::vector<std::string> by_kind[3];
    for (auto& y : x) {
      auto text = in_line(y, usual, nullptr);
      if (text.empty())
        continue;
      auto kind = text.starts_with("not ") ? 2 : text.find(arrow) != std::string::npos ? 1 : 0;
      by_kind[kind].push_back(std::move(text));
    }
    for (auto& kind : by_kind)
      for (auto& text : kind)
        into.push_back({SnippetRank::list, std::move(text)});
  }

  /// What most of these records say of a field that is true or false is not worth telling.
  static std::map<std::string, bool> usual_truths(const Json& records) {
    std::map<std::string, int> balance;
    for (auto& x : records)
      for (auto& [field, y] : x.items())
        if (y.is_boolean())
          balance[field] += y.get<bool>() ? 1 : -1;
    std::map<std::string, bool> result;
    for (auto& [field, x] : balance)
      result[field] = x >= 0;
    return result;
  }

  /// A record in few words; empty if there is nothing to it, or only a time.
  std::string in_line(const Json& x, const std::map<std::string, bool>& usual,
                      SnippetRank* best) const {
    std::vector<Snippet> parts;
    bool is_a_time = false;
    for (auto& [field, y] : x.items()) {
      if (y.is_string() && is_time(words(y.get<std::string>())))
        is_a_time = true;
      // As features of binding say it.
      if (y.is_boolean() && field == "negated") {
        if (y.get<bool>())
          parts.insert(parts.begin(), {SnippetRank::truth, "not"});
        continue;
      }
      if (auto i = usual.find(field); y.is_boolean() && i != usual.end()) {
        if (y.get<bool>() != i->second)
          parts.insert(parts.begin(), {SnippetRank::truth, y.get<bool>() ? words(field) : "not"});
        continue;
      }
      tell(field, y, parts);
    }
    if (is_a_time)
      return {};
    std::string result;
    for (auto& part : parts) {
      auto text = part.rank == SnippetRank::word ? words(part.text) : part.text;
      result += (result.empty() ? "" : " ") + text;
      if (best)
        *best = std::min(*best, part.rank);
    }
    return result;
  }

  const IsId& is_id_;
};

} // namespace

std::vector<std::string> summary(const Json& content, const IsId& is_id) {
  std::vector<Snippet> found;
  if (content.is_object())
    for (auto& [field, x] : content.items())
      Teller{is_id}.tell(field, x, found);
  std::ranges::stable_sort(found, {}, &Snippet::rank);
  std::vector<std::string> result;
  for (auto& x : found)
    result.push_back(std::move(x.text));
  return result;
}

} // namespace castor::timeline
