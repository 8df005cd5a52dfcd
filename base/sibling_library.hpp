#pragma once

#include <string>

namespace castor {

/// A function of libcastor_NAME, which is loaded if it is not: for what takes long to load and is
/// seldom used. It is sought beside this library, and never closed.
/// \throws std::runtime_error if it is not there, or has no such function
void* function_of_sibling(const std::string& name, const std::string& function);

} // namespace castor
