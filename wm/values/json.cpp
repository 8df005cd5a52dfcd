#include "castor/wm/values/json.hpp"

#include "castor/wm/values/base64.hpp"
#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/field_access.hpp"
#include "castor/wm/values/value.hpp"

#include <nlohmann/json.hpp>

#include <type_traits>
#include <variant>

namespace castor {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const FieldValue& x) {
  return std::visit(
    [](const auto& v) -> Json {
      if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>)
        return nullptr;
      else
        return v;
    },
    x);
}

class Printer {
public:
  Printer(const TypeDescriptor& descriptor, const JsonOptions& options)
    : descriptor_(descriptor), options_(options) {}

  Json record(Decoder& in, const RecordDescriptor& record) {
    auto result = Json::object();
    for (auto& field : record.fields)
      result[field.name] = value(in, field.type);
    return result;
  }

private:
  Json value(Decoder& in, const WireType& type) {
    switch (type.kind) {
      case WireKind::bytes: {
        auto data = in.take(in.take_length());
        if (data.size() > options_.max_bytes)
          return {{"bytes", data.size()}};
        return base64(data);
      }
      case WireKind::list: {
        Decoder inner{in.take(in.take_length())};
        auto result = elements(inner, type, inner.take_length());
        inner.expect_end();
        return result;
      }
      case WireKind::array:
        return elements(in, type, type.extent);
      case WireKind::optional:
        if (in.take_scalar<std::uint8_t>() == 0)
          return nullptr;
        return value(in, type.element.front());
      case WireKind::record: {
        if (++depth_ > max_depth)
          throw DecodeError("value is nested too deeply");
        Decoder inner{in.take(in.take_length())};
        auto result = record(inner, descriptor_.records.at(type.index));
        inner.expect_end();
        --depth_;
        return result;
      }
      default:
        return to_json(take_field(in, descriptor_, type));
    }
  }

  Json elements(Decoder& in, const WireType& type, std::uint32_t count) {
    auto result = Json::array();
    for (std::uint32_t i = 0; i < count; ++i)
      result.push_back(value(in, type.element.front()));
    return result;
  }

  static constexpr int max_depth = 100;

  const TypeDescriptor& descriptor_;
  const JsonOptions& options_;
  int depth_ = 0;
};

} // namespace

std::string to_json(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
                    const JsonOptions& options) {
  Decoder in{bytes};
  auto json = Printer{descriptor, options}.record(in, descriptor.records.front());
  in.expect_end();
  // Entries hold what sensors and people gave them: text that is no UTF-8 must not end the
  // printing.
  return json.dump(options.indent, ' ', false, Json::error_handler_t::replace);
}

std::string to_json(const Value& x, const JsonOptions& options) {
  return to_json(x.type(), x.bytes(), options);
}

} // namespace castor
