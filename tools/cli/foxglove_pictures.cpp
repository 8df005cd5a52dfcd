#include "castor/tools/cli/foxglove_pictures.hpp"

#include "castor/tools/cli/rasterise.hpp"
#include "castor/wm/values/crc32.hpp"
#include "castor/wm/values/encoding.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>

namespace castor::cli {

namespace {

const FieldDescriptor* field(const RecordDescriptor& x, WireKind kind,
                             std::initializer_list<std::string_view> names) {
  for (auto& field : x.fields)
    if (field.type.kind == kind && std::ranges::find(names, field.name) != names.end())
      return &field;
  return nullptr;
}

/// Finds the pictures of a value, those in lists apart.
class PictureReader {
public:
  explicit PictureReader(const TypeDescriptor& type) : type_(type) {}

  void read(Decoder& in, const RecordDescriptor& record, const std::string& path) {
    if (has_pixels(record))
      return read_pixels(in, path);
    auto* data = field(record, WireKind::bytes, {"bytes", "data"});
    auto* format = field(record, WireKind::string, {"mime_type", "mime", "format"});
    std::span<const std::uint8_t> bytes;
    std::string name;
    for (auto& x : record.fields) {
      if (format && &x == data) {
        bytes = in.take(in.take_length());
      } else if (data && &x == format) {
        auto text = in.take(in.take_length());
        name.assign(text.begin(), text.end());
      } else {
        read(in, x.type, path + '/' + x.name);
      }
    }
    add_encoded(bytes, name, path);
  }

  std::vector<Picture> take() { return std::move(found_); }

private:
  static bool has_pixels(const RecordDescriptor& x) {
    static constexpr std::array<std::pair<std::string_view, WireKind>, 4> fields{
      {{"width", WireKind::uint32},
       {"height", WireKind::uint32},
       {"channels", WireKind::uint32},
       {"bytes", WireKind::bytes}}};
    return std::ranges::equal(x.fields, fields, [](auto& a, auto& b) {
      return a.name == b.first && a.type.kind == b.second;
    });
  }

  void read_pixels(Decoder& in, const std::string& path) {
    timeline::PictureView x;
    x.width = in.take_scalar<std::uint32_t>();
    x.height = in.take_scalar<std::uint32_t>();
    x.channels = in.take_scalar<std::uint32_t>();
    x.bytes = in.take(in.take_length());
    auto pixels = std::uint64_t{x.width} * x.height;
    if (pixels == 0 || (x.channels != 1 && x.channels != 3) ||
        pixels * x.channels != x.bytes.size())
      return;
    if (auto png = as_png(x); !png.empty())
      add(path, "png", std::move(png), x.bytes);
  }

  void add_encoded(std::span<const std::uint8_t> bytes, std::string format,
                   const std::string& path) {
    constexpr std::string_view prefix = "image/";
    if (format.starts_with(prefix))
      format.erase(0, prefix.size());
    if (format == "jpg")
      format = "jpeg";
    static constexpr std::array<std::string_view, 4> known{"jpeg", "png", "webp", "avif"};
    if (!bytes.empty() && std::ranges::find(known, format) != known.end())
      add(path, format, {bytes.begin(), bytes.end()}, bytes);
  }

  void add(const std::string& path, std::string format, std::string encoded,
           std::span<const std::uint8_t> original) {
    Crc32 sum;
    sum.add(original);
    found_.push_back({path, std::move(format), std::move(encoded), sum.value()});
  }

  void read(Decoder& in, const WireType& type, const std::string& path) {
    if (type.kind == WireKind::record) {
      Decoder inner{in.take(in.take_length())};
      read(inner, type_.records.at(type.index), path);
    } else if (type.kind == WireKind::optional) {
      if (in.take_scalar<std::uint8_t>() != 0)
        read(in, type.element.front(), path);
    } else {
      in.skip(type_, type);
    }
  }

  const TypeDescriptor& type_;
  std::vector<Picture> found_;
};

} // namespace

std::vector<Picture> pictures_in(const Value& x) {
  PictureReader reader{x.type()};
  Decoder in{x.bytes()};
  reader.read(in, x.type().records.front(), {});
  return reader.take();
}

} // namespace castor::cli
