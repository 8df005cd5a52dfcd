#pragma once

#include "castor/tools/linearizability/checker.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// The operations that components have logged (castor/actors/runtime/operation_log.hpp), and checks
/// of their consistency.
namespace castor::faults {

/// One operation. Client and entry of its record are numbered across the whole recording; versions
/// and tokens are those of the working memory.
struct RecordedOperation {
  std::string component;
  /// Incarnation of the component.
  std::uint64_t life = 1;
  Address address;
  linearizability::OperationRecord record;
  /// An overwrite that depends on an earlier one that was not answered yet.
  bool expected = false;
  /// A write of an entry that is ephemeral, expires, or can be added only once.
  bool has_life = false;
  /// The result says nothing about the entry: the operation was not permitted, for example.
  bool says_nothing = false;
};

using Recording = std::vector<RecordedOperation>;

/// Reads all files of a folder. Incomplete lines of killed processes are left out.
Recording read_operations(const std::filesystem::path& folder);

/// Reads the files of a recording, each from one process.
class RecordingReader {
public:
  void read(std::istream& in);
  Recording take() { return std::move(recording_); }

private:
  Recording recording_;
  std::map<std::pair<std::string, std::uint64_t>, linearizability::Client> clients_;
  std::map<Address, std::uint32_t> entries_;
};

/// A component in one incarnation.
using Life = std::pair<std::string, std::uint64_t>;

/// Facts about a working memory besides the operations on it.
struct MemoryConditions {
  std::string subarchitecture;
  /// Minimum duration of a lease while its holder lives; 0 if unknown, because the working memory
  /// was restarted or its clock has jumped.
  Timestamp lease{0};
  /// It was down during the run.
  bool went_down = false;
  /// Whether it keeps all acknowledged changes over a restart; otherwise it is empty then.
  bool durable = false;
  /// Why its contents at the beginning of one of its incarnations are unknown; empty if it held
  /// nothing.
  std::string unknown = {};
};

/// Result of a check, with its grounds.
struct Judgement {
  linearizability::Verdict::Kind verdict = linearizability::Verdict::Kind::ok;
  /// "1,203 operations on 12 entries, in 3 lives"
  std::string grounds;
  /// Lines of text; empty if all is well.
  std::string report;
};

/// Whether the results of the operations on a working memory are linearizable: per entry, with
/// leases. Incarnations of a working memory that comes back empty are distinguished by the versions
/// and tokens that it returned.
/// @param ended incarnations that have ended: their leases may have ended at any time after their
///   last operation
/// @param until later operations are ignored, and later answers count as missing
Judgement judge_operations(const Recording& recording, const MemoryConditions& conditions,
                           const std::set<Life>& ended, linearizability::Tick until);

/// Whether a listener received exactly one event for each write, in order. Undecided if the working
/// memory was down, or if events were merged because the listener was too slow.
Judgement judge_events(const Recording& recording, const MemoryConditions& conditions,
                       std::span<const ChangeEventPtr> told);

} // namespace castor::faults
