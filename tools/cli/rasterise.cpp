#include "castor/tools/cli/rasterise.hpp"

#include "castor/wm/values/base64.hpp"

#include <cairo.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

namespace castor::cli {

namespace {

/// What cairo can draw on.
constexpr double largest_side = 32767;

struct Destroy {
  void operator()(cairo_surface_t* x) const { cairo_surface_destroy(x); }
  void operator()(cairo_t* x) const { cairo_destroy(x); }
  void operator()(RsvgHandle* x) const { g_object_unref(x); }
  void operator()(GError* x) const { g_error_free(x); }
};

using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Pen = std::unique_ptr<cairo_t, Destroy>;

void check(cairo_status_t x) {
  if (x != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string{"cannot draw the picture: "} + cairo_status_to_string(x));
}

Surface make_surface(double width, double height) {
  Surface result{cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                            static_cast<int>(height))};
  check(cairo_surface_status(result.get()));
  return result;
}

std::string png_of(cairo_surface_t* surface) {
  std::string result;
  auto append = [](void* to, const unsigned char* data, unsigned size) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), size);
    return CAIRO_STATUS_SUCCESS;
  };
  check(cairo_surface_write_to_png_stream(surface, append, &result));
  return result;
}

/// The pixels as cairo has them.
Surface surface_of(const timeline::PictureView& x) {
  auto result = make_surface(x.width, x.height);
  auto* pixels = cairo_image_surface_get_data(result.get());
  auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(result.get()));
  auto from = x.bytes.begin();
  for (std::size_t row = 0; row < x.height; ++row)
    for (std::size_t column = 0; column < x.width; ++column) {
      std::uint32_t blue = from[0];
      std::uint32_t green = x.channels == 3 ? from[1] : blue;
      std::uint32_t red = x.channels == 3 ? from[2] : blue;
      from += x.channels;
      auto pixel = red << 16 | green << 8 | blue;
      std::memcpy(pixels + row * stride + column * sizeof pixel, &pixel, sizeof pixel);
    }
  cairo_surface_mark_dirty(result.get());
  return result;
}

} // namespace

std::optional<timeline::EmbeddedPicture> embedded(const timeline::PictureView& x, double width,
                                                  double height) {
  if (x.bytes.empty() || x.width > largest_side || x.height > largest_side)
    return std::nullopt;
  auto scale = std::min({width / x.width, height / x.height, 1.0});
  auto new_width = std::max(1.0, std::round(x.width * scale));
  auto new_height = std::max(1.0, std::round(x.height * scale));
  auto source = surface_of(x);
  auto target = make_surface(new_width, new_height);
  Pen pen{cairo_create(target.get())};
  cairo_scale(pen.get(), new_width / x.width, new_height / x.height);
  cairo_set_source_surface(pen.get(), source.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(pen.get()), CAIRO_FILTER_GOOD);
  // What lies at the edge is not mixed with nothing.
  cairo_pattern_set_extend(cairo_get_source(pen.get()), CAIRO_EXTEND_PAD);
  cairo_paint(pen.get());
  auto png = png_of(target.get());
  return timeline::EmbeddedPicture{
    new_width, new_height,
    "data:image/png;base64," +
      base64({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()})};
}

std::string as_png(const timeline::PictureView& x) {
  if (x.bytes.empty() || x.width > largest_side || x.height > largest_side)
    return {};
  return png_of(surface_of(x).get());
}

std::string as_png(const std::string& svg, double scale) {
  GError* problem = nullptr;
  auto check_problem = [&](bool done) {
    std::unique_ptr<GError, Destroy> owner{problem};
    if (!done)
      throw std::runtime_error("cannot draw the picture: " +
                               std::string{problem ? problem->message : "librsvg failed"});
  };
  auto flags = static_cast<RsvgHandleFlags>(RSVG_HANDLE_FLAG_UNLIMITED);
  std::unique_ptr<GInputStream, decltype(&g_object_unref)> in{
    g_memory_input_stream_new_from_data(svg.data(), static_cast<gssize>(svg.size()), nullptr),
    &g_object_unref};
  std::unique_ptr<RsvgHandle, Destroy> handle{
    rsvg_handle_new_from_stream_sync(in.get(), nullptr, flags, nullptr, &problem)};
  check_problem(handle != nullptr);
  double width = 0;
  double height = 0;
  check_problem(rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height) != 0);
  scale = std::min({scale, largest_side / width, largest_side / height});
  width = std::floor(width * scale);
  height = std::floor(height * scale);
  auto surface = make_surface(width, height);
  Pen pen{cairo_create(surface.get())};
  RsvgRectangle whole{0, 0, width, height};
  check_problem(rsvg_handle_render_document(handle.get(), pen.get(), &whole, &problem) != 0);
  return png_of(surface.get());
}

} // namespace castor::cli
