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

/// Sources of deletions by the working memory itself.
inline constexpr const char* expiry_source = "(time to live is over)";
inline constexpr const char* owner_ended_source = "(its owner has ended)";
/// Source of an overwrite by the working memory itself: the last will of a component that has
/// ended.
inline constexpr const char* last_will_source = "(last will)";

/// A change of an entry, without the content: receivers that need it read the entry.
struct ChangeEvent {
  Operation operation = Operation::add;
  Address address;
  /// The component that made the change.
  std::string source;
  /// The entry's type, with its super types.
  TypeDescriptorPtr type;
  /// The entry's version after the change; for a deletion, its last version.
  Version version = 0;
  /// Number of the event in its working memory, from 1 without gaps.
  std::uint64_t sequence = 0;
  Timestamp time{0};
  /// Fields changed by an overwrite; none for other operations.
  FieldMask changed = 0;
  /// The event replaces several events of the entry, of which it is the newest, because the
  /// receiver was too slow to get each of them. Versions and sequence numbers then have gaps, and
  /// `changed` has the fields of all the overwrites.
  bool coalesced = false;

  const std::string& type_name() const { return type->name(); }

  /// Names of the fields in `changed`.
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
