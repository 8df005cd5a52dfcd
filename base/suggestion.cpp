#include "castor/base/suggestion.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace castor {

namespace {

constexpr std::size_t longest_name = 64;

} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  auto longer = std::max(a.size(), b.size());
  if (longer > longest_name || longer - std::min(a.size(), b.size()) > limit)
    return limit + 1;
  using Row = std::array<std::size_t, longest_name + 1>;
  std::array<Row, 3> rows{};
  auto* before_last = &rows[0];
  auto* last = &rows[1];
  auto* current = &rows[2];
  const auto above = limit + 1;
  // What is farther from the diagonal than the limit is above it, on either side of what is
  // computed.
  for (std::size_t j = 0; j <= b.size(); ++j)
    (*last)[j] = std::min(j, above);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    const auto begin = i > limit ? i - limit : 1;
    const auto end = std::min(b.size(), i + limit);
    (*current)[begin - 1] = begin == 1 ? std::min(i, above) : above;
    auto least = (*current)[begin - 1];
    for (auto j = begin; j <= end; ++j) {
      const auto replaced = (*last)[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      auto distance = std::min({(*last)[j] + 1, (*current)[j - 1] + 1, replaced, above});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        distance = std::min(distance, (*before_last)[j - 2] + 1);
      (*current)[j] = distance;
      least = std::min(least, distance);
    }
    if (end < b.size())
      (*current)[end + 1] = above;
    if (least > limit)
      return above;
    auto* const free = std::exchange(before_last, last);
    last = std::exchange(current, free);
  }
  return (*last)[b.size()];
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  auto lower_word = lower_case(word.substr(0, longest_name + 1));
  std::size_t best = std::clamp<std::size_t>(word.size() / 3, 1, 3) + 1;
  std::string_view result;
  auto count = std::min(candidates.size(), most_candidates);
  for (std::size_t i = 0; i < count; ++i) {
    auto candidate = candidates[i];
    if (candidate.empty() || candidate.size() > longest_name || best == 0)
      continue;
    auto distance = edit_distance(lower_word, lower_case(candidate), best);
    if (distance < best && distance < std::max(candidate.size(), word.size())) {
      best = distance;
      result = candidate;
    }
  }
  return result;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
  auto best = nearest(word, candidates);
  return best.empty() || best == word ? std::string{} : "did you mean " + in_quotes(best) + "?";
}

} // namespace castor
