#include "castor/tools/timeline/text_width.hpp"

#include <pango/pangocairo.h>

#include <algorithm>
#include <memory>

namespace castor::timeline {

namespace {

constexpr std::string_view ellipsis = "\u2026";

struct Release {
  void operator()(void* x) const { g_object_unref(x); }
  void operator()(PangoFontDescription* x) const { pango_font_description_free(x); }
  void operator()(cairo_font_options_t* x) const { cairo_font_options_destroy(x); }
  void operator()(char* x) const { g_free(x); }
};

template <class T>
using Owned = std::unique_ptr<T, Release>;

/// Measures lines of text. Pango's objects belong to one thread.
class TextMeasure {
public:
  TextMeasure() {
    Owned<cairo_font_options_t> options{cairo_font_options_create()};
    // Pictures are scaled: widths are those of the outlines, not of any raster.
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(context_.get(), options.get());
    pango_context_set_round_glyph_positions(context_.get(), FALSE);
    pango_layout_set_single_paragraph_mode(layout_.get(), TRUE);
  }

  double width(std::string_view text, double size, bool bold) {
    pango_font_description_set_absolute_size(font_.get(), size * PANGO_SCALE);
    pango_font_description_set_weight(font_.get(), bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout_.get(), font_.get());
    Owned<char> valid{g_utf8_make_valid(text.data(), static_cast<gssize>(text.size()))};
    pango_layout_set_text(layout_.get(), valid.get(), -1);
    PangoRectangle logical{};
    pango_layout_get_extents(layout_.get(), nullptr, &logical);
    return pango_units_to_double(logical.width);
  }

private:
  Owned<PangoContext> context_{pango_font_map_create_context(pango_cairo_font_map_get_default())};
  Owned<PangoLayout> layout_{pango_layout_new(context_.get())};
  Owned<PangoFontDescription> font_{pango_font_description_from_string(font_families)};
};

bool begins_letter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

/// The longest of the beginnings, which are sorted by length, that fits; the shortest if none does.
template <class Fits>
std::size_t longest(const std::vector<std::size_t>& ends, const Fits& fits) {
  auto i = std::partition_point(ends.begin(), ends.end(), fits);
  // With kerning, a longer beginning may be a little narrower.
  while (i != ends.begin() && !fits(*std::prev(i)))
    --i;
  return i == ends.begin() ? ends.front() : *std::prev(i);
}

std::string without_blanks_at_end(std::string_view x) {
  return std::string{x.substr(0, x.find_last_not_of(' ') + 1)};
}

} // namespace

double text_width(std::string_view text, double size, bool bold) {
  thread_local TextMeasure measure;
  return text.empty() ? 0 : measure.width(text, size, bold);
}

std::string fitted(std::string_view text, double width, double size, bool bold) {
  if (text_width(text, size, bold) <= width)
    return std::string{text};
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (i == 0 || begins_letter(text[i]))
      ends.push_back(i);
  auto shortened = [&](std::size_t end) {
    return without_blanks_at_end(text.substr(0, end)).append(ellipsis);
  };
  return shortened(longest(
    ends, [&](std::size_t end) { return text_width(shortened(end), size, bold) <= width; }));
}

std::vector<std::string> wrapped(std::string_view text, double width, double size,
                                 std::size_t most_lines) {
  std::vector<std::string> result;
  while (!text.empty() && result.size() < most_lines) {
    std::vector<std::size_t> ends{0};
    for (std::size_t i = 0; i <= text.size(); ++i)
      if (i == text.size() || text[i] == ' ')
        ends.push_back(i);
    auto end =
      longest(ends, [&](std::size_t i) { return text_width(text.substr(0, i), size) <= width; });
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
