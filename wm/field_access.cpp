#include "castor/wm/field_access.hpp"

#include "castor/wm/encoding.hpp"

#include <algorithm>
#include <compare>
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

bool is_single(WireKind kind) {
  return fixed_size(kind) || kind == WireKind::string || kind == WireKind::enumeration;
}

const WireType& without_optional(const WireType& type) {
  auto* result = &type;
  while (result->kind == WireKind::optional)
    result = &result->element.front();
  return *result;
}

/// Throws FieldError unless `path` leads to a single value. Looks at no value: a mistake in a path
/// shows whether or not the optionals on its way are there.
void check_path(const TypeDescriptor& descriptor, std::string_view path) {
  auto* record = &descriptor.records.front();
  for (;;) {
    auto dot = path.find('.');
    auto head = path.substr(0, dot);
    auto field = std::find_if(record->fields.begin(), record->fields.end(),
                              [&](const FieldDescriptor& x) { return x.name == head; });
    if (field == record->fields.end())
      throw FieldError(record->name + " has no field " + std::string{head} + "; it has " +
                       field_names(*record));
    auto& type = without_optional(field->type);
    if (dot == path.npos) {
      if (!is_single(type.kind))
        throw_not_single();
      return;
    }
    if (type.kind != WireKind::record)
      throw FieldError(field->name + " of " + record->name + " has no fields of its own");
    record = &descriptor.records.at(type.index);
    path.remove_prefix(dot + 1);
  }
}

/// Steps over the fields before the one named, which must be there, and gives its type.
const WireType& find_field(Decoder& in, const TypeDescriptor& descriptor,
                           const RecordDescriptor& record, std::string_view name) {
  auto field = record.fields.begin();
  for (; field->name != name; ++field)
    in.skip(descriptor, field->type);
  return field->type;
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
  check_path(descriptor, path);
  Decoder in{bytes};
  auto* record = &descriptor.records.front();
  for (;;) {
    auto dot = path.find('.');
    auto* type = &find_field(in, descriptor, *record, path.substr(0, dot));
    for (; type->kind == WireKind::optional; type = &type->element.front())
      if (in.take_scalar<std::uint8_t>() == 0)
        return std::monostate{};
    if (dot == path.npos)
      return take_field(in, descriptor, *type);
    in = Decoder{in.take(in.take_length())};
    record = &descriptor.records.at(type->index);
    path.remove_prefix(dot + 1);
  }
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
