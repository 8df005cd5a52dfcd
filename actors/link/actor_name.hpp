#pragma once

#include "castor/actors/link/link_record.hpp"

#include <cstdint>

namespace castor {

/// Name of an actor, unique in the system; 0 for none.
using ActorName = std::uint64_t;

constexpr ActorName make_actor_name(ProcessNumber process, std::uint32_t number) {
  return (static_cast<ActorName>(process) + 1) << 32 | number;
}

constexpr ProcessNumber process_of(ActorName name) {
  return static_cast<ProcessNumber>((name >> 32) - 1);
}

/// Number of an actor that has the same number in every process. The numbers are assigned by the
/// user of the links.
enum class WellKnownActor : std::uint32_t {};

/// All numbers up to this one are for well-known actors.
inline constexpr std::uint32_t last_well_known_number = 15;

/// The simulated clock of a process. Messages to it are no business of the clocks.
inline constexpr WellKnownActor clock_number{3};

constexpr ActorName make_actor_name(ProcessNumber process, WellKnownActor number) {
  return make_actor_name(process, static_cast<std::uint32_t>(number));
}

} // namespace castor
