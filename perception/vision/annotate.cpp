#include "castor/perception/vision/annotate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/annotate_layout.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"

namespace castor::vision {

namespace {

constexpr std::array<BgrColour, 8> palette{{{60, 220, 255},
                                            {255, 200, 60},
                                            {120, 235, 90},
                                            {210, 120, 255},
                                            {60, 140, 255},
                                            {255, 255, 140},
                                            {90, 90, 255},
                                            {255, 130, 170}}};
constexpr int font = cv::FONT_HERSHEY_DUPLEX;
/// The height of capital letters at font scale 1, pixels.
constexpr double font_capital_height = 21;
/// Beyond this, coordinates say nothing, and would overflow in drawing.
constexpr double far_outside = 1e5;

cv::Scalar scalar(const BgrColour& colour) {
  return {static_cast<double>(colour.blue), static_cast<double>(colour.green),
          static_cast<double>(colour.red)};
}

/// What the font can show: ASCII, a question mark for each other letter of UTF-8.
std::string printable(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7F)
      result += c;
    else if (byte < 0x80 || byte >= 0xC0)
      result += '?';
  }
  return result;
}

std::string percentage(double confidence) {
  return std::to_string(std::lround(100 * std::clamp(confidence, 0.0, 1.0))) + "%";
}

/// The picture in which is drawn, and the sizes that suit it.
class Canvas {
public:
  Canvas(const Image& image, const AnnotateOptions& options) : options_(options) {
    const cv::Mat given(static_cast<int>(image.height), static_cast<int>(image.width),
                        image.channels == 1 ? CV_8UC1 : CV_8UC3,
                        const_cast<std::uint8_t*>(image.bytes.data()));
    if (image.channels == 1)
      cv::cvtColor(given, pixels_, cv::COLOR_GRAY2BGR);
    else
      pixels_ = given.clone();
    constexpr double max_factor = 8;
    const double longer = std::max(image.width, image.height);
    factor_ = std::clamp(std::ceil(options.min_side / longer), 1.0, max_factor);
    if (factor_ > 1)
      cv::resize(pixels_, pixels_, {}, factor_, factor_, cv::INTER_CUBIC);
    const double side = std::max(pixels_.cols, pixels_.rows);
    unit_ = std::max(1.0, side / 640);
    font_scale_ = std::clamp(options.text_scale, 0.1, 10.0) * 9.5 * unit_ / font_capital_height;
    line_width_ = std::max(1, static_cast<int>(std::lround(1.6 * unit_)));
    text_width_ = std::max(1, static_cast<int>(std::lround(unit_ * 0.8)));
  }

  LayoutRect bounds() const {
    return {0, 0, static_cast<double>(pixels_.cols), static_cast<double>(pixels_.rows)};
  }

  double gap() const { return 6 * unit_; }

  Point2 scaled(const Point2& point) const {
    // Enlarging keeps the corner of the picture, not the centre of the first pixel.
    return {std::clamp((point.x + 0.5) * factor_ - 0.5, -far_outside, far_outside),
            std::clamp((point.y + 0.5) * factor_ - 0.5, -far_outside, far_outside)};
  }

  /// The outline of a region; four corners if it is a box.
  std::vector<cv::Point> outline(const Annotation& annotation) const {
    std::vector<Point2> corners = annotation.contour;
    if (corners.size() < 3) {
      const auto& [centre, width, height] = annotation.box;
      corners = {{centre.x - width / 2, centre.y - height / 2},
                 {centre.x + width / 2, centre.y - height / 2},
                 {centre.x + width / 2, centre.y + height / 2},
                 {centre.x - width / 2, centre.y + height / 2}};
    }
    std::vector<cv::Point> result;
    for (const auto& corner : corners) {
      const Point2 point = scaled(corner);
      result.emplace_back(static_cast<int>(std::lround(point.x)),
                          static_cast<int>(std::lround(point.y)));
    }
    return result;
  }

  void fill(const std::vector<cv::Point>& outline, const BgrColour& colour) {
    const cv::Rect part = cv::boundingRect(outline) & cv::Rect({0, 0}, pixels_.size());
    if (part.empty())
      return;
    cv::Mat painted = pixels_(part).clone();
    const std::vector<std::vector<cv::Point>> outlines{outline};
    cv::fillPoly(painted, outlines, scalar(colour), cv::LINE_8, 0, -part.tl());
    blend(painted, part, options_.fill_opacity);
  }

  void draw_outline(const std::vector<cv::Point>& outline, const BgrColour& colour) {
    const std::vector<std::vector<cv::Point>> outlines{outline};
    // A dark rim keeps the line visible on a ground of its own colour.
    cv::polylines(pixels_, outlines, true, {20, 20, 20}, line_width_ + 2, cv::LINE_AA);
    cv::polylines(pixels_, outlines, true, scalar(colour), line_width_, cv::LINE_AA);
  }

  LayoutLabel label(const Annotation& annotation, const std::vector<cv::Point>& outline) const {
    const cv::Rect box = cv::boundingRect(outline);
    LayoutLabel result;
    result.region = {static_cast<double>(box.x), static_cast<double>(box.y),
                     static_cast<double>(box.width), static_cast<double>(box.height)};
    if (annotation.lines.empty())
      return result;
    double text = 0;
    bool has_confidence = false;
    for (const auto& line : annotation.lines) {
      text = std::max(text, text_extent(printable(line.text)));
      has_confidence = has_confidence || line.confidence;
    }
    const double bars = has_confidence ? 2 * padding() + bar_width() : 0;
    result.width = std::ceil(stripe() + 2 * padding() + text + bars);
    result.height =
      std::ceil(static_cast<double>(annotation.lines.size()) * line_height() + 2 * padding());
    return result;
  }

  /// From the label's nearest border to the region, if they are apart.
  void draw_leader(const LayoutRect& rect, const LayoutRect& region, const BgrColour& colour) {
    const double from_x = std::clamp(region.left + region.width / 2, rect.left, rect.right());
    const double from_y = std::clamp(region.top + region.height / 2, rect.top, rect.bottom());
    const double to_x = std::clamp(from_x, region.left, region.right());
    const double to_y = std::clamp(from_y, region.top, region.bottom());
    if (std::hypot(from_x - to_x, from_y - to_y) <= 2 * gap())
      return;
    cv::line(pixels_, point(from_x, from_y), point(to_x, to_y), scalar(colour), line_width_,
             cv::LINE_AA);
  }

  void draw_label(const LayoutRect& rect, const Annotation& annotation, const BgrColour& colour) {
    const cv::Rect whole(point(rect.left, rect.top),
                         cv::Size(static_cast<int>(rect.width), static_cast<int>(rect.height)));
    const cv::Rect part = whole & cv::Rect({0, 0}, pixels_.size());
    if (part.empty())
      return;
    blend(cv::Mat(part.size(), CV_8UC3, cv::Scalar(28, 24, 22)), part, options_.label_opacity);
    cv::rectangle(pixels_, cv::Rect(whole.tl(), cv::Size(static_cast<int>(stripe()), whole.height)),
                  scalar(colour), cv::FILLED);
    double baseline = rect.top + padding() + 0.78 * line_height();
    for (std::size_t i = 0; i < annotation.lines.size(); ++i, baseline += line_height()) {
      const auto& line = annotation.lines[i];
      const cv::Scalar ink = i == 0 ? cv::Scalar(255, 255, 255) : cv::Scalar(215, 215, 215);
      cv::putText(pixels_, printable(line.text), point(rect.left + stripe() + padding(), baseline),
                  font, font_scale_, ink, text_width_, cv::LINE_AA);
      if (line.confidence)
        draw_confidence(rect.right() - padding() - bar_width(), baseline, *line.confidence, colour);
    }
  }

  Image finished() const {
    Image image;
    image.width = static_cast<std::uint32_t>(pixels_.cols);
    image.height = static_cast<std::uint32_t>(pixels_.rows);
    image.bytes.assign(pixels_.datastart, pixels_.dataend);
    return image;
  }

private:
  static cv::Point point(double x, double y) {
    return {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))};
  }

  double padding() const { return 4 * unit_; }
  double stripe() const { return std::ceil(3 * unit_); }
  double line_height() const { return 1.75 * font_scale_ * font_capital_height; }
  double bar_width() const { return text_extent("100%") + padding(); }

  double text_extent(const std::string& text) const {
    int below = 0;
    return cv::getTextSize(text, font, font_scale_, text_width_, &below).width;
  }

  void draw_confidence(double left, double baseline, double confidence, const BgrColour& colour) {
    const double share = std::clamp(confidence, 0.0, 1.0);
    const double capital = font_scale_ * font_capital_height;
    const double top = baseline - capital - 0.18 * capital;
    const double height = 1.36 * capital;
    const auto bar = [&](double width) {
      return cv::Rect(point(left, top), point(left + width, top + height)) &
             cv::Rect({0, 0}, pixels_.size());
    };
    const cv::Rect ground = bar(bar_width());
    blend(cv::Mat(ground.size(), CV_8UC3, cv::Scalar(90, 90, 90)), ground, 0.6);
    const cv::Rect filled = bar(bar_width() * share);
    blend(cv::Mat(filled.size(), CV_8UC3, scalar(colour)), filled, 0.45);
    const std::string text = percentage(share);
    cv::putText(pixels_, text,
                point(left + bar_width() - padding() / 2 - text_extent(text), baseline), font,
                font_scale_, cv::Scalar(255, 255, 255), text_width_, cv::LINE_AA);
  }

  void blend(const cv::Mat& painted, const cv::Rect& part, double opacity) {
    if (part.empty())
      return;
    const double share = std::clamp(opacity, 0.0, 1.0);
    cv::Mat target = pixels_(part);
    cv::addWeighted(painted, share, target, 1 - share, 0, target);
  }

  AnnotateOptions options_;
  cv::Mat pixels_;
  double factor_ = 1;
  double unit_ = 1;
  double font_scale_ = 1;
  int line_width_ = 1;
  int text_width_ = 1;
};

bool is_drawable(const Annotation& annotation) {
  const auto& box = annotation.box;
  return std::isfinite(box.center.x) && std::isfinite(box.center.y) && std::isfinite(box.width) &&
         std::isfinite(box.height) &&
         std::all_of(annotation.contour.begin(), annotation.contour.end(),
                     [](const Point2& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

} // namespace

BgrColour annotation_colour(std::size_t index) {
  return palette[index % palette.size()];
}

Image annotate(const Image& image, std::span<const Annotation> annotations,
               const AnnotateOptions& options) {
  if (image.width == 0 || image.height == 0 || (image.channels != 1 && image.channels != 3) ||
      image.bytes.size() != std::size_t{image.width} * image.height * image.channels)
    throw std::invalid_argument(
      "annotate: the picture must have 1 or 3 channels and as many bytes as "
      "its width, height and channels say");
  Canvas canvas(image, options);
  struct Item {
    const Annotation* annotation;
    BgrColour colour;
    std::vector<cv::Point> outline;
  };
  std::vector<Item> items;
  std::vector<LayoutLabel> labels;
  for (std::size_t i = 0; i < annotations.size(); ++i) {
    if (!is_drawable(annotations[i]))
      continue;
    items.push_back({&annotations[i], annotations[i].colour.value_or(annotation_colour(i)),
                     canvas.outline(annotations[i])});
    labels.push_back(canvas.label(annotations[i], items.back().outline));
  }
  const auto places = place_labels(labels, canvas.bounds(), canvas.gap());
  for (const auto& item : items)
    canvas.fill(item.outline, item.colour);
  for (const auto& item : items)
    canvas.draw_outline(item.outline, item.colour);
  for (std::size_t i = 0; i < items.size(); ++i)
    if (places[i].width > 0)
      canvas.draw_leader(places[i], labels[i].region, items[i].colour);
  for (std::size_t i = 0; i < items.size(); ++i)
    canvas.draw_label(places[i], *items[i].annotation, items[i].colour);
  return canvas.finished();
}

Image shrunk(const Image& image, std::uint32_t width) {
  if (image.width <= width)
    return image;
  const auto& given = as_mat(image);
  const double factor = static_cast<double>(width) / image.width;
  const cv::Size size(static_cast<int>(width), std::max(1, cvRound(given.rows * factor)));
  cv::Mat result;
  cv::resize(given, result, size, 0, 0, cv::INTER_AREA);
  return to_image(result);
}

} // namespace castor::vision
