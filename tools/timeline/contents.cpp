#include "castor/tools/timeline/contents.hpp"

#include "castor/wm/values/encoding.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace castor::timeline {

namespace {

constexpr int max_depth = 100;

template <std::size_t N>
bool has_fields(const RecordDescriptor& x, std::string_view name,
                const std::array<std::pair<std::string_view, WireKind>, N>& fields) {
  return x.name == name &&
         std::ranges::equal(x.fields, fields, [](const FieldDescriptor& a, const auto& b) {
           return a.name == b.first && a.type.kind == b.second;
         });
}

bool is_address(const RecordDescriptor& x) {
  static constexpr std::array<std::pair<std::string_view, WireKind>, 2> fields{
    {{"subarchitecture", WireKind::string}, {"id", WireKind::string}}};
  return has_fields(x, "Address", fields);
}

bool is_picture(const RecordDescriptor& x) {
  static constexpr std::array<std::pair<std::string_view, WireKind>, 4> fields{
    {{"width", WireKind::uint32},
     {"height", WireKind::uint32},
     {"channels", WireKind::uint32},
     {"bytes", WireKind::bytes}}};
  return has_fields(x, "Image", fields);
}

class Reader {
public:
  explicit Reader(const TypeDescriptor& type) : type_(type) {}

  void read(Decoder& in, const RecordDescriptor& record) {
    if (is_address(record))
      read_address(in);
    else if (is_picture(record))
      read_picture(in);
    else
      for (auto& field : record.fields)
        read(in, field.type);
  }

  Contents take() {
    std::ranges::sort(found_.texts);
    auto repeated = std::ranges::unique(found_.texts);
    found_.texts.erase(repeated.begin(), repeated.end());
    return std::move(found_);
  }

private:
  static std::string text(Decoder& in) {
    auto data = in.take(in.take_length());
    return {data.begin(), data.end()};
  }

  void read_address(Decoder& in) {
    Address result;
    result.subarchitecture = text(in);
    result.id = text(in);
    if (!result.id.empty())
      found_.addresses.push_back(std::move(result));
  }

  void read_picture(Decoder& in) {
    PictureView result;
    result.width = in.take_scalar<std::uint32_t>();
    result.height = in.take_scalar<std::uint32_t>();
    result.channels = in.take_scalar<std::uint32_t>();
    result.bytes = in.take(in.take_length());
    auto pixels = std::uint64_t{result.width} * result.height;
    bool is_known = result.channels == 1 || result.channels == 3;
    if (pixels > 0 && is_known && pixels * result.channels == result.bytes.size())
      found_.pictures.push_back(result);
  }

  void read(Decoder& in, const WireType& type) {
    switch (type.kind) {
      case WireKind::string:
        if (auto x = text(in); !x.empty())
          found_.texts.push_back(std::move(x));
        break;
      case WireKind::list: {
        Decoder inner{in.take(in.take_length())};
        read_elements(inner, type, inner.take_length());
        break;
      }
      case WireKind::array:
        read_elements(in, type, type.extent);
        break;
      case WireKind::optional:
        if (in.take_scalar<std::uint8_t>() != 0)
          read(in, type.element.front());
        break;
      case WireKind::record: {
        if (++depth_ > max_depth)
          throw DecodeError("value is nested too deeply");
        Decoder inner{in.take(in.take_length())};
        read(inner, type_.records.at(type.index));
        --depth_;
        break;
      }
      default:
        in.skip(type_, type);
    }
  }

  void read_elements(Decoder& in, const WireType& type, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i)
      read(in, type.element.front());
  }

  const TypeDescriptor& type_;
  Contents found_;
  int depth_ = 0;
};

} // namespace

Contents contents_of(const Value& x) {
  if (!x.has_value())
    return {};
  Reader reader{x.type()};
  try {
    Decoder in{x.bytes()};
    reader.read(in, x.type().records.front());
  } catch (const DecodeError&) {
    // What is of no use to those who look at it is shown as far as it goes.
  }
  return reader.take();
}

} // namespace castor::timeline
