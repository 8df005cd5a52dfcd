#pragma once

#include "castor/tools/simulation/entry_view.hpp"
#include "castor/tools/simulation/simulated_world.hpp"

#include <cstdint>
#include <optional>

namespace castor::linearizability {

/// How a client behaves, other than well.
struct Temper {
  /// Goes through any working memory, not only its own.
  bool roams = false;
  /// Never renews its leases.
  bool negligent = false;
  /// Gives up waiting.
  bool impatient = false;
  /// Shows old tokens and guessed versions.
  bool forges = false;
  /// Dies in the middle.
  bool mortal = false;
};

/// Chooses a simulated client's next operation on an entry, with its version and token: drawn from
/// the world's random numbers, based on the client's knowledge of the entry.
class OperationChoice {
public:
  OperationChoice(SimulatedWorld& world, Temper temper) : world_(world), temper_(temper) {}

  OperationKind kind(const EntryView& view) const;
  std::optional<Version> version_to_show(const EntryView& view) const;
  Token token_to_show(const EntryView& view, std::uint32_t entry) const;

private:
  SimulatedWorld& world_;
  Temper temper_;
};

} // namespace castor::linearizability
