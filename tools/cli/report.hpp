#pragma once

#include "castor/actors/system/system.hpp"

#include <cstdio>
#include <string>

namespace castor::cli {

/// Number of entries left on every working memory, by type, and activity of every component.
std::string report(const SystemSummary& summary);

/// Whether a component has failed, or did not stop when it had to.
bool has_failed(const SystemSummary& summary);

/// Every entry of every working memory as JSON; long byte fields are left out.
std::string entries_as_json(System& system);

} // namespace castor::cli
