#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/values/field_mask.hpp"
#include "castor/wm/values/field_name.hpp"
#include "castor/wm/values/timestamp.hpp"
#include "castor/wm/values/type_descriptor.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

enum class Operation : std::uint8_t { add, overwrite, remove };

/// "ADD", "OVERWRITE" or "DELETE".
std::string_view to_string(Operation x);

/// Sources of the deletions that no component makes.
inline constexpr const char* expiry_source = "(time to live is over)";
inline constexpr const char* owner_ended_source = "(its owner has ended)";

/// What happened to an entry. It says nothing of the content: who wants that reads the entry.
struct ChangeEvent {
  Operation operation = Operation::add;
  Address address;
  /// The component that made the change.
  std::string source;
  /// The entry's type, with its super types.
  TypeDescriptorPtr type;
  /// The entry's version after the change; for a deletion, the last it had.
  Version version = 0;
  /// Counts the events of one working memory, from 1 without gaps.
  std::uint64_t sequence = 0;
  Timestamp time{0};
  /// For an overwrite, the fields that differ from before; otherwise none.
  FieldMask changed = 0;
  /// It stands for several events of the entry, of which it is the newest: the receiver was too far
  /// behind to get them one by one. Versions and sequence numbers then have gaps, and `changed` is
  /// what any of the overwrites changed.
  bool coalesced = false;

  const std::string& type_name() const { return type->name(); }

  /// Their names.
  std::vector<std::string> changed_fields() const { return field_names(*type, changed); }

  /// Whether an overwrite changed a field, of the entry's type or one of its super types:
  /// `event.has_changed(&SceneObject::pose)`.
  template <ReflectedRecord T, class Member>
  bool has_changed(Member T::*member) const {
    return (changed & field_bit(*type, field_name(member))) != 0;
  }
};

using ChangeEventPtr = std::shared_ptr<const ChangeEvent>;

/// "OVERWRITE ROI vision/0:3 v2 by segmentor, changed area, coalesced", for messages and logs.
std::string to_string(const ChangeEvent& x);

} // namespace castor
