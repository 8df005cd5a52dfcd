#include "castor/tools/timeline/text_width.hpp"

#include <array>
#include <cstdint>

namespace castor::timeline {

namespace {

/// Of the letters from blank to tilde, in thousandths of the size (Adobe's font metrics of
/// Helvetica).
constexpr std::array<std::uint16_t, 95> widths{
  278,  278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, //
  556,  556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, //
  1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778, //
  667,  778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556, //
  333,  556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, //
  556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};

constexpr double widest = 1000;
constexpr double bold_factor = 1.09;
constexpr std::string_view ellipsis = "\u2026";

bool begins_letter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

double letter_width(char c) {
  if (!begins_letter(c))
    return 0;
  auto i = static_cast<unsigned char>(c);
  return i >= ' ' && i <= '~' ? widths[static_cast<std::size_t>(i - ' ')] : widest;
}

} // namespace

double text_width(std::string_view text, double size, bool bold) {
  double result = 0;
  for (char c : text)
    result += letter_width(c);
  return result / 1000 * size * (bold ? bold_factor : 1);
}

std::string fitted(std::string_view text, double width, double size, bool bold) {
  if (text_width(text, size, bold) <= width)
    return std::string{text};
  auto room = width - text_width(ellipsis, size, bold);
  std::size_t end = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && !begins_letter(text[i]))
      continue;
    if (text_width(text.substr(0, i), size, bold) > room)
      break;
    end = i;
  }
  while (end > 0 && text[end - 1] == ' ')
    --end;
  return std::string{text.substr(0, end)}.append(ellipsis);
}

std::vector<std::string> wrapped(std::string_view text, double width, double size,
                                 std::size_t most_lines) {
  std::vector<std::string> result;
  while (!text.empty() && result.size() < most_lines) {
    std::size_t end = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
      if (i < text.size() && text[i] != ' ')
        continue;
      if (text_width(text.substr(0, i), size) > width)
        break;
      end = i;
    }
    bool is_last = result.size() + 1 == most_lines || end == 0;
    if (is_last) {
      result.push_back(fitted(text, width, size));
      break;
    }
    result.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }
  return result;
}

} // namespace castor::timeline
