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

/// What a simulated client does next to an entry, and what it claims to know: drawn from the
/// world's random numbers, after what it believes of the entry.
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
