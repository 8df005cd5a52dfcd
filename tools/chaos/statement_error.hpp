#pragma once

#include "castor/base/suggestion.hpp"

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace castor::faults {

/// A syntax error in a statement.
class StatementError : public std::runtime_error {
public:
  StatementError(const std::string& what, std::string remedy)
    : runtime_error(what), remedy_(std::move(remedy)) {}

  /// What to write instead.
  const std::string& remedy() const { return remedy_; }

private:
  std::string remedy_;
};

inline constexpr std::string_view rate_remedy = "write a rate such as 0.5/s, up to 100/s";
inline constexpr std::string_view time_remedy = "write a time such as 50ms, 1.5s or 2min";

/// Suggests the candidate nearest to `word`; `otherwise` if none is near.
inline std::string remedy_for(std::string_view word,
                              const std::vector<std::string_view>& candidates,
                              std::string otherwise) {
  auto remedy = did_you_mean(word, candidates);
  return remedy.empty() ? std::move(otherwise) : remedy;
}

/// Nothing unless the text is a whole number.
template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
  Number result{};
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  if (error != std::errc{} || end != text.data() + text.size())
    return std::nullopt;
  return result;
}

} // namespace castor::faults
