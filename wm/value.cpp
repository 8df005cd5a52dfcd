#include "castor/wm/value.hpp"

namespace castor {

Value::Value(TypeDescriptorPtr type, std::shared_ptr<const void> object,
             const Operations* operations)
  : rep_(std::make_shared<Rep>()) {
  rep_->type = std::move(type);
  rep_->object = std::move(object);
  rep_->operations = operations;
}

Value Value::from_bytes(TypeDescriptorPtr type, Bytes bytes) {
  Value result{std::move(type), nullptr, nullptr};
  result.rep_->bytes = std::move(bytes);
  return result;
}

const Bytes& Value::bytes() const {
  if (rep_->operations)
    std::call_once(rep_->encode_once,
                   [this] { rep_->bytes = rep_->operations->encode(rep_->object.get()); });
  return rep_->bytes;
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
  auto& fields = type().records.front().fields;
  auto& wanted_fields = wanted.records.front().fields;
  bool same = type().name() == wanted.name() ? type().hash == wanted.hash
                                             : fields.size() >= wanted_fields.size();
  for (std::size_t i = 0; same && i < wanted_fields.size(); ++i)
    same = fields[i].name == wanted_fields[i].name &&
           fields[i].type.kind == wanted_fields[i].type.kind;
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
  auto type = decode_descriptor(descriptor);
  // What cannot be stepped over here could not be printed or compared later.
  Decoder check{content};
  for (auto& field : type->records.front().fields)
    check.skip(*type, field.type);
  check.expect_end();
  return Value::from_bytes(std::move(type), std::move(content));
}

} // namespace castor
