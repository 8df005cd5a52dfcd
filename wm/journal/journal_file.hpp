#pragma once

#include "castor/wm/journal/journal_record.hpp"
#include "castor/wm/store/store_image.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// A journal that can be written, by one thread at a time. Everything throws JournalError; what was
/// to be written is then not to be relied upon, and nothing more can be.
class JournalFile {
public:
  virtual ~JournalFile() = default;

  /// Writes these down; they are safe from a power cut when it returns.
  virtual void append(const std::vector<JournalGroupPtr>& groups) = 0;

  /// Does a little of what keeps the file small; returns whether there is more to do.
  virtual bool tidy() = 0;

  /// The end is an orderly one.
  virtual void close() = 0;

  virtual std::uint64_t bytes() const = 0;
};

/// A journal as a working memory takes it up.
struct OpenedJournal {
  std::shared_ptr<JournalFile> file;
  StoreImage image;
  /// How often it was opened: lease tokens of different sessions differ.
  std::uint64_t session = 0;
  std::uint64_t incarnation = 0;
  UnixTime time{0};
  /// Why there is no file, and the working memory goes on without.
  std::string failure = {};
};

} // namespace castor
