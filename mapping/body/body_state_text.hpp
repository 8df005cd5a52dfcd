#pragma once

#include "castor/mapping/body/simulated_body.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace castor::mapping {

/// A state and when it was saved, microseconds since the system began.
struct SavedBody {
  std::int64_t time = 0;
  BodyState state;

  friend bool operator==(const SavedBody&, const SavedBody&) = default;
};

/// As one line, without loss.
std::string body_state_text(const SavedBody& x);

/// Nothing if it is no such line.
std::optional<SavedBody> parse_body_state(std::string_view text);

} // namespace castor::mapping
