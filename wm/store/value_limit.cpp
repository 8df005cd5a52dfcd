#include "castor/wm/store/value_limit.hpp"

namespace castor {

std::optional<Failure> value_too_large(const WriteRequest& request,
                                       const std::string& subarchitecture, std::size_t largest) {
  if (!request.value.has_value())
    return std::nullopt;
  auto size = request.value.encoded_size();
  if (size <= largest)
    return std::nullopt;
  auto verb = request.operation == Operation::add ? "add" : "overwrite";
  return Failure{FailureKind::too_large,
                 to_string(*request.client) + " cannot " + verb + " " + to_string(request.address) +
                   ": its " + request.value.type_name() + " takes " + std::to_string(size) +
                   " bytes, but " + subarchitecture + " takes at most " + std::to_string(largest) +
                   ". Put --largest-entry on its WM line to allow more",
                 request.address};
}

} // namespace castor
