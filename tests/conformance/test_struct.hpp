#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>

namespace castor::conformance {

/// Who wrote an entry, how, and where it lay then.
struct ChangeRecord {
  std::string operation;
  std::string source;
  Address address;

  friend bool operator==(const ChangeRecord&, const ChangeRecord&) = default;
};
CASTOR_REFLECT(ChangeRecord, operation, source, address)

/// The entry that the testers write.
struct TestStruct {
  std::int64_t count = 0;
  ChangeRecord change;

  friend bool operator==(const TestStruct&, const TestStruct&) = default;
};
CASTOR_REFLECT(TestStruct, count, change)

} // namespace castor::conformance
