#include "castor/base/suggestion.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <array>

namespace castor {

namespace {

constexpr std::size_t longest_name = 64;

} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  auto longer = std::max(a.size(), b.size());
  if (longer > longest_name || longer - std::min(a.size(), b.size()) > limit)
    return limit + 1;
  using Row = std::array<std::size_t, longest_name + 1>;
  Row before_last{};
  Row last{};
  Row current{};
  for (std::size_t j = 0; j <= b.size(); ++j)
    last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      auto replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = current;
  }
  return std::min(last[b.size()], limit + 1);
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
