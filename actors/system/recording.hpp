#pragma once

#include "castor/actors/runtime/push_log.hpp"
#include "castor/wm/journal/journal_reader.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

namespace castor {

/// One write of a recording.
struct RecordedWrite {
  UnixTime time{0};
  std::string subarchitecture;
  /// The component that made it.
  std::string source;
  std::vector<JournalRecord> changes;
};

/// A value that a stand-alone component pushed, or that was pulled from it.
struct RecordedValue {
  UnixTime time{0};
  std::string provider;
  RecordedPush push;
};

using RecordedStep = std::variant<RecordedWrite, RecordedValue>;

UnixTime time_of(const RecordedStep& x);

/// Selected part of a recording.
struct RecordingSelection {
  std::vector<std::filesystem::path> journals;
  /// Files of what stand-alone components handed out (push_log.hpp).
  std::vector<std::filesystem::path> pushes;
  /// Components whose writes are selected; nothing for all.
  std::optional<std::set<std::string>> sources = {};
  /// Begin: earlier writes are replaced by the entries that they led to, earlier values by the last
  /// of each type.
  UnixTime from{0};
};

/// The journals of a system's working memories, and the values that its stand-alone components
/// handed out, as one recording: step by step, in the order of time.
class Recording {
public:
  /// Throws JournalError.
  explicit Recording(const RecordingSelection& selection);

  /// The next step; nothing after the last.
  std::optional<RecordedStep> next();

private:
  struct JournalTrack {
    std::unique_ptr<JournalReader> reader;
    std::string subarchitecture;
    /// Entries that the recording begins with and that were not returned so far; the first at the
    /// end.
    std::vector<RecordedWrite> first;
    std::optional<JournalRecord> ahead;
    std::optional<RecordedWrite> write;
    /// Writers of the present entries, by id.
    std::unordered_map<std::string, std::string> writers;
  };

  struct PushTrack {
    std::unique_ptr<PushLogReader> reader;
    std::string provider;
    /// As above.
    std::vector<RecordedValue> first;
    std::optional<RecordedValue> value;
  };

  bool is_wanted(const std::string& source) const {
    return !selection_.sources || selection_.sources->count(source) > 0;
  }
  void open_journal(const std::filesystem::path& file);
  void open_pushes(const std::filesystem::path& file);
  void fetch(JournalTrack& track);
  static void fetch(PushTrack& track);
  /// Skips steps before `from`.
  void skip(JournalTrack& track);
  void skip(PushTrack& track) const;
  /// Adds the change to the write, if it is to be replayed.
  void take(JournalTrack& track, JournalRecord record, RecordedWrite& into);

  const RecordingSelection selection_;
  std::vector<JournalTrack> journals_;
  std::vector<PushTrack> pushes_;
  /// Whether steps before `from` are being skipped. Then expiries count; in a replay, the working
  /// memory makes them itself.
  bool skipping_ = false;
};

/// Values that a stand-in of the stand-alone component hands out first: the last one of each type
/// before `from`, otherwise the first one. Throws JournalError.
std::vector<RecordedPush> first_values(const std::filesystem::path& pushes, UnixTime from);

} // namespace castor
