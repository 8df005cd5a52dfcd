#include "castor/wm/field_access.hpp"

#include "castor/wm/encoding.hpp"

#include <cmath>
#include <compare>
#include <type_traits>

namespace castor {

namespace {

template <class T>
FieldValue integer(Decoder& in) {
  if constexpr (std::is_signed_v<T>)
    return static_cast<std::int64_t>(in.take_scalar<T>());
  else
    return static_cast<std::uint64_t>(in.take_scalar<T>());
}

FieldValue take_scalar(Decoder& in, WireKind kind) {
  switch (kind) {
    case WireKind::boolean:
      return in.take_scalar<std::uint8_t>() != 0;
    case WireKind::int8:
      return integer<std::int8_t>(in);
    case WireKind::int16:
      return integer<std::int16_t>(in);
    case WireKind::int32:
      return integer<std::int32_t>(in);
    case WireKind::int64:
      return integer<std::int64_t>(in);
    case WireKind::uint8:
      return integer<std::uint8_t>(in);
    case WireKind::uint16:
      return integer<std::uint16_t>(in);
    case WireKind::uint32:
      return integer<std::uint32_t>(in);
    case WireKind::uint64:
      return integer<std::uint64_t>(in);
    case WireKind::float32:
      return static_cast<double>(in.take_scalar<float>());
    case WireKind::float64:
      return in.take_scalar<double>();
    case WireKind::string: {
      auto data = in.take(in.take_length());
      return std::string{data.begin(), data.end()};
    }
    default:
      throw FieldError("a list or a record cannot be compared as a whole: name one of its fields");
  }
}

FieldValue enumerator(const EnumDescriptor& descriptor, const FieldValue& number) {
  // An enumerator beyond the signed range keeps its bits, here as where the descriptor was made.
  auto value = std::visit(
    [](const auto& x) -> std::int64_t {
      if constexpr (std::is_integral_v<std::decay_t<decltype(x)>>)
        return static_cast<std::int64_t>(x);
      else
        return 0;
    },
    number);
  for (auto& [name, candidate] : descriptor.enumerators)
    if (candidate == value)
      return name;
  return std::to_string(value);
}

std::string field_names(const RecordDescriptor& record) {
  std::string result;
  for (auto& field : record.fields)
    result += (result.empty() ? "" : ", ") + field.name;
  return result;
}

FieldValue read_path(Decoder& in, const TypeDescriptor& descriptor, const RecordDescriptor& record,
                     std::string_view path) {
  auto dot = path.find('.');
  auto head = path.substr(0, dot);
  for (auto& field : record.fields) {
    if (field.name != head) {
      in.skip(descriptor, field.type);
      continue;
    }
    const WireType* type = &field.type;
    if (type->kind == WireKind::optional) {
      if (in.take_scalar<std::uint8_t>() == 0)
        return std::monostate{};
      type = &type->element.front();
    }
    if (dot == path.npos)
      return take_field(in, descriptor, *type);
    if (type->kind != WireKind::record)
      throw FieldError(std::string{head} + " of " + record.name + " has no fields of its own");
    Decoder inner{in.take(in.take_length())};
    return read_path(inner, descriptor, descriptor.records.at(type->index), path.substr(dot + 1));
  }
  throw FieldError(record.name + " has no field " + std::string{head} + "; it has " +
                   field_names(record));
}

template <class T>
inline constexpr bool is_number =
  std::is_same_v<T, std::int64_t> || std::is_same_v<T, std::uint64_t> || std::is_same_v<T, double>;

/// Exact, where a conversion of one side to the other's type would not be.
struct Order {
  std::partial_ordering operator()(bool a, bool b) const { return a <=> b; }
  std::partial_ordering operator()(const std::string& a, const std::string& b) const {
    return a <=> b;
  }
  std::partial_ordering operator()(std::int64_t a, std::int64_t b) const { return a <=> b; }
  std::partial_ordering operator()(std::uint64_t a, std::uint64_t b) const { return a <=> b; }
  std::partial_ordering operator()(double a, double b) const { return a <=> b; }
  std::partial_ordering operator()(std::int64_t a, std::uint64_t b) const {
    return a < 0 ? std::partial_ordering::less : static_cast<std::uint64_t>(a) <=> b;
  }
  std::partial_ordering operator()(std::uint64_t a, std::int64_t b) const {
    return 0 <=> (*this)(b, a);
  }
  template <class Integer>
  std::partial_ordering operator()(double a, Integer b) const requires(is_number<Integer>) {
    // long double holds every 64-bit integer exactly on x86-64.
    return static_cast<long double>(a) <=> static_cast<long double>(b);
  }
  template <class Integer>
  std::partial_ordering operator()(Integer a, double b) const requires(is_number<Integer>) {
    return static_cast<long double>(a) <=> static_cast<long double>(b);
  }
  template <class A, class B>
  std::partial_ordering operator()(const A&, const B&) const {
    if constexpr (std::is_same_v<A, std::monostate> || std::is_same_v<B, std::monostate>)
      return std::partial_ordering::unordered;
    else
      throw FieldError("a number, a truth value and a text cannot be compared with one another");
  }
};

} // namespace

FieldValue take_field(Decoder& in, const TypeDescriptor& descriptor, const WireType& type) {
  if (type.kind != WireKind::enumeration)
    return take_scalar(in, type.kind);
  auto& e = descriptor.enums.at(type.index);
  return enumerator(e, take_scalar(in, e.underlying));
}

FieldValue read_field(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
                      std::string_view path) {
  Decoder in{bytes};
  return read_path(in, descriptor, descriptor.records.front(), path);
}

bool compare(const FieldValue& a, Comparison op, const FieldValue& b) {
  auto order = std::visit(Order{}, a, b);
  switch (op) {
    case Comparison::equal:
      return order == 0;
    case Comparison::not_equal:
      return order != 0;
    case Comparison::less:
      return order < 0;
    case Comparison::less_equal:
      return order <= 0;
    case Comparison::greater:
      return order > 0;
    case Comparison::greater_equal:
      return order >= 0;
  }
  return false;
}

} // namespace castor
