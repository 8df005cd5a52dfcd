#pragma once

#include "castor/wm/entries/failure.hpp"
#include "castor/wm/store/write_request.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace castor {

/// Why a working memory that takes values of up to `largest` bytes refuses what is to be written;
/// or nothing. The same in the writer's process, before the value is sent, as at the owner.
std::optional<Failure> value_too_large(const WriteRequest& request,
                                       const std::string& subarchitecture, std::size_t largest);

} // namespace castor
