#include "castor/tools/cli/progress_line.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t bar_columns = 20;
/// Before that, an estimate of the time that is left would jump.
constexpr auto first_estimate = 3s;
/// The longest estimate that says anything.
constexpr double longest_estimate = 100 * 3600;

std::string time_text(std::chrono::seconds x) {
  auto seconds = x.count();
  if (seconds < 60)
    return fmt::format("{} s", seconds);
  if (seconds < 3600)
    return fmt::format("{} min {:02} s", seconds / 60, seconds % 60);
  return fmt::format("{} h {:02} min", seconds / 3600, seconds / 60 % 60);
}

/// The share of the total that is done, if it is known.
std::optional<double> share_of(const ProgressState& state) {
  if (!state.total || !(*state.total > 0) || !std::isfinite(*state.total) ||
      !std::isfinite(state.done))
    return std::nullopt;
  return std::clamp(state.done / *state.total, 0.0, 1.0);
}

std::string bar(double share) {
  auto filled = static_cast<std::size_t>(share * static_cast<double>(bar_columns));
  return '[' + std::string(filled, '#') + std::string(bar_columns - filled, '.') + "] ";
}

std::string times(const ProgressState& state, std::optional<double> share) {
  auto result = time_text(std::chrono::duration_cast<std::chrono::seconds>(state.elapsed));
  if (!share || state.elapsed < first_estimate || !(*share > 0) || *share >= 1)
    return result;
  auto left = std::chrono::duration<double>(state.elapsed).count() * (1 - *share) / *share;
  if (left > longest_estimate)
    return result;
  return result + ", " + time_text(std::chrono::seconds{std::llround(left)}) + " left";
}

bool continues_a_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

std::size_t columns_of(const std::string& text) {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues_a_character));
}

/// As much of a UTF-8 text as has room, with dots where something is left out.
std::string cut(const std::string& text, std::size_t columns) {
  if (columns_of(text) <= columns)
    return text;
  auto dots = std::min<std::size_t>(columns, 3);
  std::size_t end = 0;
  for (auto left = columns - dots;; ++end)
    if (!continues_a_character(text[end]) && left-- == 0)
      break;
  return text.substr(0, end) + std::string(dots, '.');
}

/// Line breaks and the like would leave the line.
std::string printable(std::string text) {
  for (auto& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      c = ' ';
  return text;
}

} // namespace

std::string progress_line(const ProgressState& state, std::size_t columns) {
  auto share = share_of(state);
  auto percent = share ? fmt::format("{:3.0f}%  ", std::floor(*share * 100)) : std::string{};
  auto head = printable(state.task) + "  ";
  auto tail = percent + times(state, share);
  if (!state.text.empty())
    tail += "  " + printable(state.text);
  if (share && columns_of(head + tail) + bar_columns + 3 <= columns)
    head += bar(*share);
  return cut(head + tail, columns);
}

} // namespace castor::cli
