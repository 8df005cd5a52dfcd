#pragma once

#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <memory>
#include <utility>

namespace castor {

/// A large content that has arrived over a link. It may be part of several messages, which share
/// one value then. Not thread-safe: a link's messages are read one after the other.
class ReceivedContent {
public:
  explicit ReceivedContent(Bytes bytes) : bytes_(std::move(bytes)) {}

  const Bytes& bytes() const { return value_.has_value() ? value_.bytes() : bytes_; }

  /// The content as a value; of the same type each time. Throws DecodeError.
  const Value& value(const TypeDescriptorPtr& type) {
    if (!value_.has_value())
      value_ = Value::from_foreign_bytes(type, std::exchange(bytes_, {}));
    else if (value_.type().hash != type->hash)
      throw DecodeError("a content that is of two types");
    return value_;
  }

private:
  Bytes bytes_;
  Value value_;
};

using ReceivedContentPtr = std::shared_ptr<ReceivedContent>;

} // namespace castor
