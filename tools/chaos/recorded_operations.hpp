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

/// What components have written down of their operations
/// (castor/actors/runtime/operation_log.hpp), and whether it can be.
namespace castor::faults {

/// One operation. Its record's client and entry are numbers of the whole recording; its versions
/// and tokens are those of the working memory.
struct RecordedOperation {
  std::string component;
  /// Which of the component's lives.
  std::uint64_t life = 1;
  Address address;
  linearizability::OperationRecord record;
  /// An overwrite that counts on an earlier one, which was not answered yet.
  bool expected = false;
  /// A write of an entry that goes of itself, or can be added only once.
  bool has_life = false;
  /// It was answered in a way that says nothing about the entry: it was not permitted, say.
  bool says_nothing = false;
};

using Recording = std::vector<RecordedOperation>;

/// Reads all files of a folder. Lines that a killed process did not finish are left out.
Recording read_operations(const std::filesystem::path& folder);

/// Reads files, one process's each, one by one.
class RecordingReader {
public:
  void read(std::istream& in);
  Recording take() { return std::move(recording_); }

private:
  Recording recording_;
  std::map<std::pair<std::string, std::uint64_t>, linearizability::Client> clients_;
  std::map<Address, std::uint32_t> entries_;
};

/// A component in one of its lives.
using Life = std::pair<std::string, std::uint64_t>;

/// What is known of a working memory besides the operations on it.
struct MemoryConditions {
  std::string subarchitecture;
  /// How long a lease lasts at least, while its holder lives; 0 if that cannot be told, because the
  /// working memory was started again or its clock has jumped.
  Timestamp lease{0};
  /// It was down in between.
  bool went_down = false;
  /// When it comes back, it has what it had acknowledged; otherwise nothing.
  bool durable = false;
  /// Why nobody knows what it held in the beginning of one of its lives; empty if it held nothing.
  std::string unknown = {};
};

/// A judgement, with its grounds.
struct Judgement {
  linearizability::Verdict::Kind verdict = linearizability::Verdict::Kind::ok;
  /// "1,203 operations on 12 entries, in 3 lives"
  std::string grounds;
  /// Lines of text; empty if all is well.
  std::string report;
};

/// Whether one operation after the other, each between its begin and its end, explains what the
/// operations on a working memory gave: per entry, with leases. A working memory that comes back
/// empty has several lives, which are told apart by the versions and tokens that it gave.
/// @param ended lives that are over: from their last operation on, their leases may be
/// @param until later operations do not count, later answers were not given
Judgement judge_operations(const Recording& recording, const MemoryConditions& conditions,
                           const std::set<Life>& ended, linearizability::Tick until);

/// Whether a listener was told of each of those writes once, in order. Undecided if the working
/// memory was down, or the listener too slow to be told of each.
Judgement judge_events(const Recording& recording, const MemoryConditions& conditions,
                       std::span<const ChangeEventPtr> told);

} // namespace castor::faults
