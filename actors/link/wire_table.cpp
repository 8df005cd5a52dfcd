#include "castor/actors/link/wire_table.hpp"

#include <string>

namespace castor {

bool WireTable::write(const caf::type_erased_tuple& message, WireWriter& out) const {
  if (message.size() != 1)
    return false;
  // CAF names the types it knows by number; none of those is an interface of ours.
  auto* type = message.type(0).second;
  auto number = type ? numbers_.find(*type) : numbers_.end();
  if (number == numbers_.end())
    return false;
  out.put(number->second);
  codecs_[number->second].write(message, out);
  return true;
}

caf::message WireTable::read(WireReader& in) const {
  auto number = in.take<Number>();
  if (number >= codecs_.size())
    throw DecodeError("a message of the unknown kind " + std::to_string(number));
  auto result = codecs_[number].read(in);
  in.expect_end();
  return result;
}

const char* name_of_type(const caf::type_erased_tuple& message) {
  auto* type = message.size() == 1 ? message.type(0).second : nullptr;
  return type ? type->name() : "one of the framework's own";
}

} // namespace castor
