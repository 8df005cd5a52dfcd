#pragma once

namespace castor::test {

/// A segmentation fault that no compiler foresees.
inline void follow_null() {
  volatile int* volatile nowhere = nullptr;
  *nowhere = 1;
}

} // namespace castor::test
