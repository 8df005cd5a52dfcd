#pragma once

#include "castor/actors/system/system.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <string>
#include <vector>

namespace castor::mapping::test {

/// A subarchitecture `mapping` with these components.
inline std::string cast_with(const std::string& components) {
  return "SUBARCHITECTURE mapping\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n" +
         components;
}

/// Contents of all its entries of that type.
template <class T>
std::vector<T> all(TestSystem& system) {
  std::vector<T> result;
  for (auto& entry : system.system().entries("mapping"))
    if (auto x = entry->value.as<T>())
      result.push_back(*x);
  return result;
}

} // namespace castor::mapping::test
