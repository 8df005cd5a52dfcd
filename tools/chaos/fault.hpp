#pragma once

#include "castor/tools/chaos/quantities.hpp"

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace castor::faults {

/// What the process of `castor run` or `castor chaos` is called where a plan names processes.
inline constexpr std::string_view coordinator = "coordinator";

/// A component, or any: then which one is drawn when the faults are scheduled. Any component is
/// neither a working memory nor a task manager; those are only meant by their names.
struct ComponentTarget {
  /// Empty for any.
  std::string name;
  /// Of any component: the subarchitecture that it is one of, empty for all of them.
  std::string subarchitecture;

  bool is_any() const { return name.empty(); }
  friend auto operator<=>(const ComponentTarget&, const ComponentTarget&) = default;
};

/// A process: a node, or that of an isolated component. Empty for any node.
struct ProcessTarget {
  std::string name;

  bool is_any() const { return name.empty(); }
  friend auto operator<=>(const ProcessTarget&, const ProcessTarget&) = default;
};

/// The working memory of a subarchitecture. Empty for any.
struct MemoryTarget {
  std::string subarchitecture;

  bool is_any() const { return subarchitecture.empty(); }
  friend auto operator<=>(const MemoryTarget&, const MemoryTarget&) = default;
};

/// What two processes say to each other, both ways. Both empty for any two.
struct LinkTarget {
  std::string first;
  std::string second;

  bool is_any() const { return first.empty(); }
  friend auto operator<=>(const LinkTarget&, const LinkTarget&) = default;
};

/// How long something lasts. Nothing: until the run ends, or a later fault ends it.
using Lasting = std::optional<Timestamp>;

/// The component ends at once, as by a fault of the machine. An isolated one takes its process
/// along.
struct Crash {
  static constexpr std::string_view kind = "crash";
  ComponentTarget component;

  friend auto operator<=>(const Crash&, const Crash&) = default;
};

/// A callback of the component throws.
struct Throw {
  static constexpr std::string_view kind = "throw";
  ComponentTarget component;
  /// Which of those that begin from now on, from 1.
  std::uint32_t callback = 1;

  friend auto operator<=>(const Throw&, const Throw&) = default;
};

/// The component's next callback does not come to an end.
struct Hang {
  static constexpr std::string_view kind = "hang";
  ComponentTarget component;
  Lasting duration;

  friend auto operator<=>(const Hang&, const Hang&) = default;
};

/// The component's next configure() or start() does not come to an end, so that it does not come
/// back when it is started again.
struct Block {
  static constexpr std::string_view kind = "block";
  enum class Phase : std::uint8_t { configure, start };

  ComponentTarget component;
  Phase phase = Phase::start;
  Lasting duration;

  friend auto operator<=>(const Block&, const Block&) = default;
};

/// Every callback of the component takes longer.
struct Slow {
  static constexpr std::string_view kind = "slow";
  ComponentTarget component;
  Timestamp by{0};
  Lasting duration;

  friend auto operator<=>(const Slow&, const Slow&) = default;
};

/// SIGKILL.
struct Kill {
  static constexpr std::string_view kind = "kill";
  ProcessTarget process;

  friend auto operator<=>(const Kill&, const Kill&) = default;
};

/// SIGSTOP, and SIGCONT when it is over.
struct Stop {
  static constexpr std::string_view kind = "stop";
  ProcessTarget process;
  Lasting duration;

  friend auto operator<=>(const Stop&, const Stop&) = default;
};

/// SIGCONT.
struct Continue {
  static constexpr std::string_view kind = "continue";
  ProcessTarget process;

  friend auto operator<=>(const Continue&, const Continue&) = default;
};

/// The process can open no more file descriptors.
struct UseUpDescriptors {
  static constexpr std::string_view kind = "use up descriptors";
  ProcessTarget process;
  Lasting duration;

  friend auto operator<=>(const UseUpDescriptors&, const UseUpDescriptors&) = default;
};

/// How many connections a flood makes if nothing is said.
inline constexpr Rate flood_rate = highest_rate;

/// Strangers connect with the process, who say nothing or nonsense.
struct Flood {
  static constexpr std::string_view kind = "flood";
  ProcessTarget process;
  /// So many of them.
  Rate rate = flood_rate;
  Lasting duration;

  friend auto operator<=>(const Flood&, const Flood&) = default;
};

/// Nothing passes between the processes of one group and those of another.
struct Partition {
  static constexpr std::string_view kind = "partition";
  std::vector<std::string> group;
  /// Empty: all others.
  std::vector<std::string> from;
  Lasting duration;

  friend auto operator<=>(const Partition&, const Partition&) = default;
};

/// What passes a link passes later.
struct Delay {
  static constexpr std::string_view kind = "delay";
  Timestamp by{0};
  LinkTarget link;
  Lasting duration;

  friend auto operator<=>(const Delay&, const Delay&) = default;
};

/// A part of what passes a link is lost.
struct Drop {
  static constexpr std::string_view kind = "drop";
  Percent part;
  LinkTarget link;
  Lasting duration;

  friend auto operator<=>(const Drop&, const Drop&) = default;
};

/// A part of what passes a link arrives twice.
struct Duplicate {
  static constexpr std::string_view kind = "duplicate";
  Percent part;
  LinkTarget link;
  Lasting duration;

  friend auto operator<=>(const Duplicate&, const Duplicate&) = default;
};

/// A part of what passes a link is overtaken by what comes after it.
struct Reorder {
  static constexpr std::string_view kind = "reorder";
  Percent part;
  LinkTarget link;
  Lasting duration;

  friend auto operator<=>(const Reorder&, const Reorder&) = default;
};

/// Writes to the working memory's journal fail.
struct FailJournal {
  static constexpr std::string_view kind = "fail journal";
  MemoryTarget memory;
  Lasting duration;

  friend auto operator<=>(const FailJournal&, const FailJournal&) = default;
};

/// Writes to the working memory's journal take longer.
struct SlowJournal {
  static constexpr std::string_view kind = "slow journal";
  MemoryTarget memory;
  Timestamp by{0};
  Lasting duration;

  friend auto operator<=>(const SlowJournal&, const SlowJournal&) = default;
};

/// The files of the working memory's journal are moved away under it.
struct RemoveJournal {
  static constexpr std::string_view kind = "remove journal";
  MemoryTarget memory;

  friend auto operator<=>(const RemoveJournal&, const RemoveJournal&) = default;
};

/// Another system opens the working memory's journal, which has to be refused to it.
struct ClaimJournal {
  static constexpr std::string_view kind = "claim journal";
  MemoryTarget memory;

  friend auto operator<=>(const ClaimJournal&, const ClaimJournal&) = default;
};

/// The clock by which the working memory ends leases goes forward, or back.
struct JumpClock {
  static constexpr std::string_view kind = "jump clock";
  MemoryTarget memory;
  Timestamp by{0};

  friend auto operator<=>(const JumpClock&, const JumpClock&) = default;
};

/// Anything that a plan can do to a system.
using Fault = std::variant<Crash, Throw, Hang, Block, Slow, Kill, Stop, Continue, UseUpDescriptors,
                           Flood, Partition, Delay, Drop, Duplicate, Reorder, FailJournal,
                           SlowJournal, RemoveJournal, ClaimJournal, JumpClock>;

/// "crash", "fail journal".
std::string_view kind_of(const Fault& x) noexcept;

/// Whether the fault only takes effect when something comes: a callback of its component, a write
/// to its journal, a message over its link. Then this says what: "its component had no such
/// callback". Null for faults that take effect when they are injected.
const char* missed_occasion(const Fault& x) noexcept;

/// As a plan has it: "delay 50ms between coordinator and node1 for 1s".
std::string to_string(const Fault& x);

/// Its target: the name of a component, process or subarchitecture, several of them, or what
/// it is drawn from, as a plan has it.
std::string target_of(const Fault& x);

/// Nothing for a fault that is over as soon as it is done, or has no end.
Lasting duration_of(const Fault& x);

/// A name as a plan has it: in quotes if it could be taken for something else.
std::string name_in_plan(const std::string& name);

} // namespace castor::faults
