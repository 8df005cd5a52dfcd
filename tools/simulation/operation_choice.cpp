#include "castor/tools/simulation/operation_choice.hpp"

#include <array>

namespace castor::linearizability {

OperationKind OperationChoice::kind(const EntryView& view) const {
  using enum OperationKind;
  if (!view.present && world_.chance(30))
    return add;
  if (view.times > 0 && world_.chance(35))
    return unlock;
  // Who has not seen the entry reads it rather than failing to overwrite it.
  if (!view.seen && world_.chance(40))
    return read;
  static constexpr std::array kinds{
    add,  overwrite, overwrite, overwrite, overwrite, overwrite, remove,   read,
    read, exists,    version,   lock,      lock,      lock,      try_lock, unlock,
  };
  return kinds[world_.pick(kinds.size())];
}

std::optional<Version> OperationChoice::version_to_show(const EntryView& view) const {
  if (traits_.shows_wrong_tokens && world_.chance(20))
    return world_.chance(20) ? std::nullopt : std::optional{view.seen.value_or(0) + world_.pick(3)};
  return view.seen;
}

Token OperationChoice::token_to_show(const EntryView& view, std::uint32_t entry) const {
  if (!traits_.shows_wrong_tokens || !world_.chance(25))
    return view.token;
  // Somebody else's, perhaps.
  if (world_.chance(30))
    return world_.entries[entry].last_token;
  return view.old_tokens.empty() ? 0 : view.old_tokens[world_.pick(view.old_tokens.size())];
}

} // namespace castor::linearizability
