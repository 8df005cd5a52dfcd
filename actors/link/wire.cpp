#include "castor/actors/link/wire.hpp"

#include <utility>

namespace castor {

void WireWriter::put(const TypeDescriptorPtr& x) {
  put(x->hash);
  types_.push_back(x);
}

void WireWriter::put(const Value& x) {
  put(x.has_value());
  if (!x.has_value())
    return;
  put(x.type_ptr());
  auto size = x.encoded_size();
  if (head_.size() + content_bytes_ + size > largest_)
    throw MessageTooLarge{head_.size() + content_bytes_ + size};
  auto& bytes = x.bytes();
  bool shared = bytes.size() >= shared_content_;
  put(shared);
  if (shared) {
    contents_.push_back(x);
    content_bytes_ += bytes.size();
  } else {
    encoder_.put(bytes);
  }
}

void WireReader::get(TypeDescriptorPtr& x) {
  auto hash = take<std::uint64_t>();
  x = names_.type_of(hash);
  if (!x)
    throw DecodeError("a value of a type that was not introduced");
}

void WireReader::get(Value& x) {
  x = {};
  if (!take<bool>())
    return;
  auto type = take<TypeDescriptorPtr>();
  if (!take<bool>())
    x = Value::from_foreign_bytes(std::move(type), take_bytes());
  else if (next_content_ < contents_.size())
    x = contents_[next_content_++]->value(type);
  else
    throw DecodeError("a value without its content");
}

std::uint32_t WireReader::take_count() {
  auto result = take<std::uint32_t>();
  if (result > decoder_.remaining())
    throw DecodeError("a list claims more elements than it has bytes");
  return result;
}

void WireReader::expect_end() const {
  decoder_.expect_end();
  if (next_content_ < contents_.size())
    throw DecodeError("a message with more contents than values");
}

} // namespace castor
