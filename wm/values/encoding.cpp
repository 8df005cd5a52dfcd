#include "castor/wm/values/encoding.hpp"

#include <limits>

namespace castor {

void Encoder::put_length(std::size_t n) {
  if (n > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("a string, list or record in an entry is limited to 4 GiB");
  auto x = static_cast<std::uint32_t>(n);
  put_raw(&x, sizeof(x));
}

std::size_t Encoder::begin_length() {
  auto at = out_.size();
  out_.resize(at + sizeof(std::uint32_t));
  return at;
}

void Encoder::end_length(std::size_t at) {
  auto n = out_.size() - at - sizeof(std::uint32_t);
  if (n > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("a string, list or record in an entry is limited to 4 GiB");
  auto x = static_cast<std::uint32_t>(n);
  std::memcpy(out_.data() + at, &x, sizeof(x));
}

std::span<const std::uint8_t> Decoder::take(std::size_t n) {
  if (n > in_.size())
    throw DecodeError("value ends early: " + std::to_string(n) + " bytes expected, " +
                      std::to_string(in_.size()) + " left");
  auto result = in_.first(n);
  in_ = in_.subspan(n);
  return result;
}

void Decoder::expect_end() const {
  if (!in_.empty())
    throw DecodeError(std::to_string(in_.size()) + " bytes too many");
}

std::optional<std::size_t> fixed_size(WireKind kind) {
  switch (kind) {
    case WireKind::boolean:
    case WireKind::int8:
    case WireKind::uint8:
      return 1;
    case WireKind::int16:
    case WireKind::uint16:
      return 2;
    case WireKind::int32:
    case WireKind::uint32:
    case WireKind::float32:
      return 4;
    case WireKind::int64:
    case WireKind::uint64:
    case WireKind::float64:
      return 8;
    default:
      return std::nullopt;
  }
}

void Decoder::skip(const TypeDescriptor& descriptor, const WireType& type) {
  if (auto size = fixed_size(type.kind)) {
    take(*size);
    return;
  }
  switch (type.kind) {
    case WireKind::enumeration:
      take(*fixed_size(descriptor.enums.at(type.index).underlying));
      break;
    case WireKind::array:
      for (std::uint32_t i = 0; i < type.extent; ++i)
        skip(descriptor, type.element.front());
      break;
    case WireKind::optional:
      if (take_scalar<std::uint8_t>() != 0)
        skip(descriptor, type.element.front());
      break;
    default: // string, bytes, list and record begin with their length
      take(take_length());
  }
}

} // namespace castor
