#pragma once

#include <string>
#include <string_view>

namespace castor::planning {

/// Name of the object that an entry is in plans. Different ids have different names: what PDDL has
/// no place for is written after a ^.
std::string object_name(std::string_view id);

/// Name of the object that a word of people is in plans: "living-room".
std::string word_name(std::string_view word);

} // namespace castor::planning
