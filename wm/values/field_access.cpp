#include "castor/wm/values/field_access.hpp"

#include "castor/wm/values/encoding.hpp"

#include <algorithm>
#include <compare>
#include <limits>
#include <type_traits>

namespace castor {

namespace {

[[noreturn]] void throw_not_single() {
  throw FieldError("a list or a record cannot be compared as a whole: name one of its fields");
}

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
      throw_not_single();
  }
}

FieldValue enumerator(const EnumDescriptor& descriptor, const FieldValue& number) {
  return std::visit(
    [&](const auto& x) -> FieldValue {
      if constexpr (std::is_integral_v<std::decay_t<decltype(x)>>) {
        // An enumerator beyond the signed range keeps its bits, as where the descriptor was made.
        for (auto& [name, value] : descriptor.enumerators)
          if (value == static_cast<std::int64_t>(x))
            return name;
        return std::to_string(x);
      } else {
        return x;
      }
    },
    number);
}

std::string field_names(const RecordDescriptor& record) {
  std::string result;
  for (auto& field : record.fields)
    result += (result.empty() ? "" : ", ") + field.name;
  return result;
}

const WireType& without_optional(const WireType& type) {
  auto* result = &type;
  while (result->kind == WireKind::optional)
    result = &result->element.front();
  return *result;
}

/// Takes the marks of optionals up to what they hold; null if one of them is empty.
const WireType* enter_optional(Decoder& in, const WireType* type) {
  for (; type->kind == WireKind::optional; type = &type->element.front())
    if (in.take_scalar<std::uint8_t>() == 0)
      return nullptr;
  return type;
}

/// Steps over everything before the field and gives its type; null if it is absent.
const WireType* seek(Decoder& in, const TypeDescriptor& descriptor, const FieldPath& path) {
  auto* record = &descriptor.records.front();
  const WireType* type = nullptr;
  for (auto step : path) {
    if (type && type->kind == WireKind::array) {
      for (std::uint32_t i = 0; i < step; ++i)
        in.skip(descriptor, type->element.front());
      type = &type->element.front();
    } else {
      if (type) {
        in = Decoder{in.take(in.take_length())};
        record = &descriptor.records.at(type->index);
      }
      for (std::uint32_t i = 0; i < step; ++i)
        in.skip(descriptor, record->fields[i].type);
      type = &record->fields[step].type;
    }
    type = enter_optional(in, type);
    if (!type)
      return nullptr;
  }
  return type;
}

template <class T>
inline constexpr bool is_number_type =
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
  std::partial_ordering operator()(double a, Integer b) const requires(is_number_type<Integer>) {
    // long double holds every 64-bit integer exactly on x86-64.
    return static_cast<long double>(a) <=> static_cast<long double>(b);
  }
  template <class Integer>
  std::partial_ordering operator()(Integer a, double b) const requires(is_number_type<Integer>) {
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

bool is_single(WireKind kind) {
  return fixed_size(kind) || kind == WireKind::string || kind == WireKind::enumeration;
}

FieldPlace find_field(const TypeDescriptor& descriptor, std::string_view path) {
  FieldPlace result;
  auto* record = &descriptor.records.front();
  for (;;) {
    auto dot = path.find('.');
    auto head = path.substr(0, dot);
    auto field = std::find_if(record->fields.begin(), record->fields.end(),
                              [&](const FieldDescriptor& x) { return x.name == head; });
    if (field == record->fields.end())
      throw FieldError(record->name + " has no field " + std::string{head} + "; it has " +
                       field_names(*record));
    result.path.push_back(static_cast<std::uint32_t>(field - record->fields.begin()));
    result.type = &without_optional(field->type);
    if (dot == path.npos)
      return result;
    if (result.type->kind != WireKind::record)
      throw FieldError(field->name + " of " + record->name + " has no fields of its own");
    record = &descriptor.records.at(result.type->index);
    path.remove_prefix(dot + 1);
  }
}

FieldValue read_field(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
                      const FieldPath& path) {
  Decoder in{bytes};
  auto* type = seek(in, descriptor, path);
  return type ? take_field(in, descriptor, *type) : FieldValue{};
}

bool has_field(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
               const FieldPath& path) {
  Decoder in{bytes};
  return seek(in, descriptor, path) != nullptr;
}

FieldValue read_field(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
                      std::string_view path) {
  auto place = find_field(descriptor, path);
  if (!is_single(place.type->kind))
    throw_not_single();
  return read_field(descriptor, bytes, place.path);
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

FieldValue normalised(FieldValue x) {
  if (auto* real = std::get_if<double>(&x)) {
    // 2^63 and 2^64, where the integers end.
    if (*real >= -0x1p63 && *real < 0x1p63) {
      auto integer = static_cast<std::int64_t>(*real);
      if (static_cast<double>(integer) == *real)
        x = integer;
    } else if (*real >= 0x1p63 && *real < 0x1p64) {
      x = static_cast<std::uint64_t>(*real);
    }
  } else if (auto* natural = std::get_if<std::uint64_t>(&x)) {
    if (*natural <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      x = static_cast<std::int64_t>(*natural);
  }
  return x;
}

} // namespace castor
