#include <castor/tools/testing/test_system.hpp>

#include <exception>
#include <iostream>

int main() {
  try {
    castor::TestSystem system{"SUBARCHITECTURE vision\n"
                              "CPP WM SubarchitectureWorkingMemory\n"
                              "CPP TM AlwaysPositiveTaskManager\n"
                              "CPP UM warner Warner\n"
                              "CPP UM mover Mover\n"};
    system.expect_entry("Cup in vision from warner where label == \"near\"");
    system.inject("crash warner");
    system.expect_back("warner");
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
