#include "castor/wm/values/value.hpp"

#include "castor/wm/values/descriptor_encoding.hpp"

#include <algorithm>
#include <set>

namespace castor {

namespace {

/// Takes the bytes of one field.
std::span<const std::uint8_t> take_bytes(Decoder& in, std::span<const std::uint8_t> all,
                                         const TypeDescriptor& type, const FieldDescriptor& field) {
  auto begin = all.size() - in.remaining();
  in.skip(type, field.type);
  return all.subspan(begin, all.size() - in.remaining() - begin);
}

/// Compares the bytes of two values field by field.
FieldMask changed_fields(const TypeDescriptor& type, std::span<const std::uint8_t> before,
                         std::span<const std::uint8_t> after) {
  FieldMask result = 0;
  std::size_t index = 0;
  Decoder a{before};
  Decoder b{after};
  for (auto& field : type.records.front().fields) {
    auto bit = field_bit(index++);
    if (!std::ranges::equal(take_bytes(a, before, type, field), take_bytes(b, after, type, field)))
      result |= bit;
  }
  return result;
}

/// Compares what two descriptors say of a part that they have in common.
class LayoutComparison {
public:
  LayoutComparison(const TypeDescriptor& a, const TypeDescriptor& b) : a_(a), b_(b) {}

  /// Whether `a` begins with the fields of `b`.
  bool begins_with(const RecordDescriptor& a, const RecordDescriptor& b) {
    if (a.fields.size() < b.fields.size())
      return false;
    for (std::size_t i = 0; i < b.fields.size(); ++i)
      if (a.fields[i].name != b.fields[i].name || !same(a.fields[i].type, b.fields[i].type))
        return false;
    return true;
  }

private:
  bool same(const WireType& a, const WireType& b) {
    if (a.kind != b.kind || a.extent != b.extent)
      return false;
    if (a.kind == WireKind::record)
      return same_record(a.index, b.index);
    if (a.kind == WireKind::enumeration)
      return a_.enums.at(a.index) == b_.enums.at(b.index);
    return a.element.empty() || same(a.element.front(), b.element.front());
  }

  bool same_record(std::uint32_t a, std::uint32_t b) {
    // Met before: either found equal, or a recursive type that is being compared further out.
    if (!seen_.insert({a, b}).second)
      return true;
    auto& x = a_.records.at(a);
    auto& y = b_.records.at(b);
    return x.name == y.name && x.fields.size() == y.fields.size() && begins_with(x, y);
  }

  const TypeDescriptor& a_;
  const TypeDescriptor& b_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen_;
};

} // namespace

Value::OtherForms& Value::other_forms() const {
  auto* there = rep_->forms.load(std::memory_order_acquire);
  if (there)
    return *there;
  auto mine = std::make_unique<OtherForms>();
  if (rep_->forms.compare_exchange_strong(there, mine.get(), std::memory_order_acq_rel))
    return *mine.release();
  return *there;
}

Value Value::from_bytes(TypeDescriptorPtr type, Bytes bytes) {
  Value result{std::make_shared<Rep>()};
  result.rep_->type = std::move(type);
  result.other_forms().bytes = std::move(bytes);
  return result;
}

Value Value::from_foreign_bytes(TypeDescriptorPtr type, Bytes bytes) {
  // What cannot be stepped over here could not be printed or compared later.
  Decoder check{bytes};
  for (auto& field : type->records.front().fields)
    check.skip(*type, field.type);
  check.expect_end();
  return from_bytes(std::move(type), std::move(bytes));
}

const Bytes& Value::bytes() const {
  auto& forms = other_forms();
  if (rep_->operations)
    std::call_once(forms.encode_once,
                   [&] { forms.bytes = rep_->operations->encode(rep_->object); });
  return forms.bytes;
}

std::size_t Value::encoded_size() const {
  return rep_->operations ? rep_->operations->encoded_size(rep_->object) : bytes().size();
}

FieldValue Value::field(const FieldPath& path) const {
  if (!rep_->operations)
    return read_field(type(), bytes(), path);
  auto found = part(path);
  return found.data ? found.operations->read(found.data) : FieldValue{};
}

bool Value::has_field(const FieldPath& path) const {
  return rep_->operations ? part(path).data != nullptr : castor::has_field(type(), bytes(), path);
}

FieldMask changed_fields(const Value& before, const Value& after) {
  auto& a = *before.rep_;
  auto& b = *after.rep_;
  if (a.type->hash != b.type->hash || a.type->name() != b.type->name())
    return all_fields(*b.type);
  if (a.operations && a.operations == b.operations)
    return a.object == b.object ? 0 : a.operations->differ(a.object, b.object);
  return changed_fields(*b.type, before.bytes(), after.bytes());
}

bool operator==(const Value& a, const Value& b) {
  if (a.rep_ == b.rep_)
    return true;
  if (!a.rep_ || !b.rep_)
    return false;
  return a.type().hash == b.type().hash && a.type_name() == b.type_name() && a.bytes() == b.bytes();
}

void Value::check_same_layout(const TypeDescriptor& wanted) const {
  // A base's fields come first, so a derived value must begin with exactly the base's fields.
  bool same = type().name() == wanted.name() ? type().hash == wanted.hash
                                             : LayoutComparison{type(), wanted}.begins_with(
                                                 type().records.front(), wanted.records.front());
  if (!same)
    throw DecodeError("the value is a " + to_string(type()) + " but this process knows " +
                      to_string(wanted));
}

Bytes encode_self_described(const Value& x) {
  Bytes out;
  Encoder encoder{out};
  encoder.put(encode_descriptor(x.type()));
  encoder.put(x.bytes());
  return out;
}

Value decode_self_described(std::span<const std::uint8_t> bytes) {
  Decoder in{bytes};
  Bytes descriptor;
  Bytes content;
  in.get(descriptor);
  in.get(content);
  in.expect_end();
  return Value::from_foreign_bytes(decode_descriptor(descriptor), std::move(content));
}

} // namespace castor
