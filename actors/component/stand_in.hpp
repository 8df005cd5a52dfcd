#pragma once

#include "castor/actors/component/component_identity.hpp"

namespace castor {

/// Class of the components that take the place of stand-alone components while a recording is
/// replayed.
inline constexpr const char* stand_in_class = "RecordedProvider";

/// Whether the component is such a stand-in: it hands out recorded values, and obeys commands of
/// all types without any effect.
inline bool is_stand_in(const ComponentIdentity& x) {
  return x.class_name == stand_in_class;
}

} // namespace castor
