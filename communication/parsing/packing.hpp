#pragma once

#include "castor/communication/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace castor::communication {

/// One reading of an utterance: a form of all of it, or one of each fragment.
using ReadingForms = std::vector<LogicalForm>;

/// Readings in one form, numbered from 0; the other fields are the caller's.
PackedLogicalForm pack(std::span<const ReadingForms> readings);

/// What one reading says, by fragments; empty if the form does not have it.
ReadingForms unpack(const PackedLogicalForm& packed, std::int32_t reading);

/// Removes readings, and all that belongs to no other reading.
void remove_readings(PackedLogicalForm& packed, std::span<const std::int32_t> readings);

/// Removes the readings that have a relation which other knowledge does not support, unless that
/// are all: then the form stays as it is. A finished form that has been pruned says so. The next
/// word of an utterance makes a new form, but its nominals keep their names: what is known of them
/// can be applied again.
/// \returns whether readings were removed
bool prune(PackedLogicalForm& packed, std::span<const InterpretationSupport> supports);

} // namespace castor::communication
