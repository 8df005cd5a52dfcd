#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/option.hpp"
#include "castor/wm/journal/journal.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

/// What a working memory does when its journal fails; `continue` in a .cast file.
enum class JournalFailure : std::uint8_t { stop, go_on };

constexpr auto castor_reflection(TypeTag<JournalFailure>) {
  using Enumerator = std::pair<std::string_view, JournalFailure>;
  return enum_reflection<JournalFailure>("JournalFailure", Enumerator{"stop", JournalFailure::stop},
                                         Enumerator{"continue", JournalFailure::go_on});
}

/// The one class that WM lines may name, and its options.
struct WorkingMemoryClass {
  static constexpr const char* name = "SubarchitectureWorkingMemory";
  static constexpr const char* help =
    "holds the entries of a subarchitecture and sends change events";

  WorkingMemoryClass() = default;

  /// With the options of a WM line, which have been checked.
  explicit WorkingMemoryClass(const ComponentDescription& x) {
    for (auto& setting : x.options)
      options.set(setting.name(), setting.value);
  }

  OptionList options;
  Option<std::vector<std::string>> ignore{
    options,
    "ignore",
    {},
    "change events of these subarchitectures are not sent to this one's components"};
  Option<bool> log{options, "log", false, "log every change at level debug"};
  Option<bool> debug{options, "debug", false, "log every change at level trace"};
  Option<std::chrono::milliseconds> lease{
    options, "lease", std::chrono::seconds{2},
    "how long the lease of an entry outlives the last sign of life of its holder"};
  Option<std::int64_t> largest_entry{options, "largest-entry", 256,
                                     "the largest entry that is taken, MB"};
  Option<JournalMode> journal{
    options, "journal", JournalMode::off,
    "what outlives a crash: full - all that was acknowledged, batched - all but the last of it"};
  Option<std::string> journal_dir{options, "journal-dir", "journals",
                                  "the folder of the journal's file, on the machine of this line"};
  Option<std::chrono::milliseconds> journal_delay{
    options, "journal-delay", std::chrono::milliseconds{100},
    "batched: how long a change may be acknowledged and not on disk"};
  Option<JournalFailure> journal_failure{
    options, "journal-failure", JournalFailure::stop,
    "what the working memory does when its journal fails: ends, or goes on without one"};
  Option<std::int64_t> journal_limit{
    options, "journal-limit", 256,
    "beyond so many MB, old changes are folded into the entries that they led to"};
  Option<bool> journal_keep{options, "journal-keep", false,
                            "the journal is a recording: no change is ever folded"};
  Option<bool> journal_shared{options, "journal-shared", false,
                              "the folder is storage that every node of FAILOVER sees"};

  /// Whether its acknowledged writes are available on other nodes, where a successor prevents it
  /// from acknowledging more.
  bool outlives_its_node() const { return journal.get() == JournalMode::full && journal_shared; }

  /// Journal options of a subarchitecture.
  JournalOptions journal_of(const std::string& subarchitecture) const {
    JournalOptions result;
    result.mode = journal;
    result.file = std::filesystem::path{journal_dir.get()} / (subarchitecture + journal_extension);
    result.delay = journal_delay;
    result.go_on_without = journal_failure.get() == JournalFailure::go_on;
    result.limit_bytes = static_cast<std::uint64_t>(journal_limit.get()) << 20;
    result.keep = journal_keep;
    result.shared = journal_shared;
    return result;
  }
};

} // namespace castor
