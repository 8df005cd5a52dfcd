#pragma once

#include "castor/communication/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace castor::communication {

/// One reading of an utterance: one form for all of it, or one for each fragment.
using ReadingForms = std::vector<LogicalForm>;

/// Packs readings into one form, numbered from 0; the caller sets the other fields.
PackedLogicalForm pack(std::span<const ReadingForms> readings);

/// Whether all words together have a meaning.
bool is_understood(const PackedLogicalForm& form);

/// Forms of one reading, by fragments; empty if there is no such reading.
ReadingForms unpack(const PackedLogicalForm& packed, std::int32_t reading);

/// Removes readings, and all parts that belong to no other reading.
void remove_readings(PackedLogicalForm& packed, std::span<const std::int32_t> readings);

/// Removes the readings with a relation that is not supported, unless these are all readings: then
/// the form is unchanged. Sets the state of a finished form to `pruned`. The next word of an
/// utterance makes a new form in which nominals keep their names, so the same supports can be
/// applied again.
/// \returns whether readings were removed
bool prune(PackedLogicalForm& packed, std::span<const InterpretationSupport> supports);

} // namespace castor::communication
