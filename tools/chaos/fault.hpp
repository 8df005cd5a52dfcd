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

/// Name of the process of `castor run` or `castor chaos` in plans.
inline constexpr std::string_view coordinator = "coordinator";

/// A component, or any: then one is drawn when the faults are scheduled. Working memories and task
/// managers are never drawn, only named.
struct ComponentTarget {
  /// Empty for any.
  std::string name;
  /// For any component: the subarchitecture to draw from, empty for all.
  std::string subarchitecture;

  bool is_any() const { return name.empty(); }
  friend auto operator<=>(const ComponentTarget&, const ComponentTarget&) = default;
};

/// A process: that of a node or of an isolated component. Empty for any node.
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

/// The link between two processes, in both directions. Both names empty for any link.
struct LinkTarget {
  std::string first;
  std::string second;

  bool is_any() const { return first.empty(); }
  friend auto operator<=>(const LinkTarget&, const LinkTarget&) = default;
};

/// Duration of a fault. Nothing: until the run ends, or a later fault ends it.
using Lasting = std::optional<Timestamp>;

/// The times of faults that are drawn at random are whole milliseconds.
inline constexpr Timestamp millisecond{1000};

/// The component ends at once, as after a hardware fault. The process of an isolated component ends
/// too.
struct Crash {
  static constexpr std::string_view kind = "crash";
  ComponentTarget component;

  friend auto operator<=>(const Crash&, const Crash&) = default;
};

/// A callback of the component throws.
struct Throw {
  static constexpr std::string_view kind = "throw";
  ComponentTarget component;
  /// Number of the callback, counted from 1 from now on.
  std::uint32_t callback = 1;

  friend auto operator<=>(const Throw&, const Throw&) = default;
};

/// The component's next callback does not return.
struct Hang {
  static constexpr std::string_view kind = "hang";
  ComponentTarget component;
  Lasting duration;

  friend auto operator<=>(const Hang&, const Hang&) = default;
};

/// The component's next configure() or start() does not return, so its restart does not complete.
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

/// Default rate of connections of a flood.
inline constexpr Rate flood_rate = highest_rate;

/// Unauthorised clients connect to the process and send nothing or garbage.
struct Flood {
  static constexpr std::string_view kind = "flood";
  ProcessTarget process;
  /// Rate of connections.
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

/// Messages over a link are delayed.
struct Delay {
  static constexpr std::string_view kind = "delay";
  Timestamp by{0};
  LinkTarget link;
  Lasting duration;

  friend auto operator<=>(const Delay&, const Delay&) = default;
};

/// A share of the messages over a link is lost.
struct Drop {
  static constexpr std::string_view kind = "drop";
  Percent part;
  LinkTarget link;
  Lasting duration;

  friend auto operator<=>(const Drop&, const Drop&) = default;
};

/// A share of the messages over a link arrives twice.
struct Duplicate {
  static constexpr std::string_view kind = "duplicate";
  Percent part;
  LinkTarget link;
  Lasting duration;

  friend auto operator<=>(const Duplicate&, const Duplicate&) = default;
};

/// A share of the messages over a link is overtaken by later ones.
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

/// Another system tries to open the working memory's journal, which must be refused.
struct ClaimJournal {
  static constexpr std::string_view kind = "claim journal";
  MemoryTarget memory;

  friend auto operator<=>(const ClaimJournal&, const ClaimJournal&) = default;
};

/// The working memory's lease clock jumps forward or back.
struct JumpClock {
  static constexpr std::string_view kind = "jump clock";
  MemoryTarget memory;
  Timestamp by{0};

  friend auto operator<=>(const JumpClock&, const JumpClock&) = default;
};

/// Any fault of a plan.
using Fault = std::variant<Crash, Throw, Hang, Block, Slow, Kill, Stop, Continue, UseUpDescriptors,
                           Flood, Partition, Delay, Drop, Duplicate, Reorder, FailJournal,
                           SlowJournal, RemoveJournal, ClaimJournal, JumpClock>;

/// "crash", "fail journal".
std::string_view kind_of(const Fault& x) noexcept;

/// For a fault that takes effect only on an occasion (a callback of its component, a write to its
/// journal, a message over its link): the explanation if that occasion never comes, such as "its
/// component had no such callback". Null for faults that take effect when they are injected.
const char* missed_occasion(const Fault& x) noexcept;

/// In the syntax of plans: "delay 50ms between coordinator and node1 for 1s".
std::string to_string(const Fault& x);

/// Target of the fault: the name of a component, process or subarchitecture, several of them, or
/// the set it is drawn from, in the syntax of plans.
std::string target_of(const Fault& x);

/// Nothing for a fault that is instantaneous or has no end.
Lasting duration_of(const Fault& x);

/// A name in the syntax of plans: in quotes if it would be ambiguous without.
std::string name_in_plan(const std::string& name);

} // namespace castor::faults
