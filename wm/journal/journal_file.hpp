#pragma once

#include "castor/wm/journal/journal_record.hpp"
#include "castor/wm/store/store_image.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// A journal that can be written, by one thread at a time. All functions throw JournalError; after
/// that, the data of the failed call may be lost, and nothing more can be written.
class JournalFile {
public:
  virtual ~JournalFile() = default;

  /// Writes these groups; they are safe from a power cut when it returns.
  virtual void append(const std::vector<JournalGroupPtr>& groups) = 0;

  /// Does one step of compaction; returns whether there is more to do.
  virtual bool tidy() = 0;

  /// Closes the file and marks its session as ended in order.
  virtual void close() = 0;

  virtual std::uint64_t bytes() const = 0;
};

/// An opened journal, with the content from which a working memory is restored.
struct OpenedJournal {
  std::shared_ptr<JournalFile> file;
  StoreImage image;
  /// Number of times it was opened: lease tokens of different sessions differ.
  std::uint64_t session = 0;
  std::uint64_t incarnation = 0;
  UnixTime time{0};
  /// Reason why there is no file and the working memory runs without a journal; else empty.
  std::string failure = {};
};

} // namespace castor
