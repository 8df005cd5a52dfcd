#pragma once

#include "castor/actors/cast/description.hpp"

#include <filesystem>
#include <map>
#include <string>

/// What befalls journals from outside of the system that writes them.
namespace castor::faults {

/// The files of the journals that an architecture asks for, by subarchitecture, as processes that
/// were started in the present folder find them.
std::map<std::string, std::filesystem::path>
journals_of(const ArchitectureDescription& architecture);

/// Moves the files of a journal to others beside it, whose name is returned. Throws
/// std::runtime_error if there is none, or it cannot be moved.
std::filesystem::path remove_journal(const std::filesystem::path& journal);

} // namespace castor::faults
