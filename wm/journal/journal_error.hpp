#pragma once

#include <stdexcept>

namespace castor {

/// A journal cannot be read or written; says which file, what happened and what to do.
class JournalError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// Another system writes the journal, or has done so since this one did; says which.
class JournalOfAnother : public JournalError {
public:
  using JournalError::JournalError;
};

/// The file was changed by something else than the working memory, or by a broken disk.
class JournalCorrupt : public JournalError {
public:
  using JournalError::JournalError;
};

} // namespace castor
