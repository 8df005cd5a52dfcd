#pragma once

#include "castor/tools/simulation/entry_view.hpp"
#include "castor/tools/simulation/simulated_world.hpp"

#include <cstdint>
#include <optional>

namespace castor::linearizability {

/// Misbehaviour of a simulated client.
struct ClientTraits {
  /// Goes through any working memory, not only its own.
  bool uses_any_memory = false;
  /// Never renews its leases.
  bool never_renews = false;
  /// Gives up waiting.
  bool gives_up_waits = false;
  /// Shows old tokens and guessed versions.
  bool shows_wrong_tokens = false;
  /// Ends at random.
  bool may_end = false;
};

/// Chooses a simulated client's next operation on an entry, with its version and token: drawn from
/// the world's random numbers, based on the client's knowledge of the entry.
class OperationChoice {
public:
  OperationChoice(SimulatedWorld& world, ClientTraits traits) : world_(world), traits_(traits) {}

  OperationKind kind(const EntryView& view) const;
  std::optional<Version> version_to_show(const EntryView& view) const;
  Token token_to_show(const EntryView& view, std::uint32_t entry) const;

private:
  SimulatedWorld& world_;
  ClientTraits traits_;
};

} // namespace castor::linearizability
