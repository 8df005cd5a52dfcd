#pragma once

#include "castor/wm/entries/failure.hpp"
#include "castor/wm/store/write_request.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace castor {

/// Failure if the value exceeds `largest` bytes, the limit of the working memory; else nothing.
/// Checked in the writer's process before the value is sent, and again by the working memory.
std::optional<Failure> value_too_large(const WriteRequest& request,
                                       const std::string& subarchitecture, std::size_t largest);

} // namespace castor
