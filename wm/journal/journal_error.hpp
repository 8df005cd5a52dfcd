#pragma once

#include <stdexcept>

namespace castor {

/// A journal cannot be read or written; names the file, the cause and the remedy.
class JournalError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// Another system writes the journal, or has written it since this one did; names that system.
class JournalOfAnother : public JournalError {
public:
  using JournalError::JournalError;
};

/// The file was changed by another program, or by a broken disk.
class JournalCorrupt : public JournalError {
public:
  using JournalError::JournalError;
};

} // namespace castor
