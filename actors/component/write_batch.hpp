#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/values/value.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace castor {

/// Writes that are made all or none, in one step, to different entries of one working memory.
///
///     write(WriteBatch{}.overwrite(left, moved).overwrite(right, moved).delete_entry(gap));
class WriteBatch {
public:
  struct Item {
    Operation operation = Operation::add;
    Address address;
    Value value;
    std::optional<EntryLife> life;
    std::optional<LastWill> last_will = {};
  };

  template <ReflectedRecord T>
  WriteBatch& add(Address address, T object, EntryLife life = {}) {
    return add_value(std::move(address), Value::of(std::move(object)), life);
  }

  /// Adds an entry whose C++ type is not known here.
  WriteBatch& add_value(Address address, Value value, EntryLife life = {}) {
    items_.push_back({Operation::add, std::move(address), std::move(value), life});
    return *this;
  }

  template <ReflectedRecord T>
  WriteBatch& overwrite(Address address, T object) {
    items_.push_back({Operation::overwrite, std::move(address), Value::of(std::move(object)), {}});
    return *this;
  }

  /// The entry has another life from now on.
  template <ReflectedRecord T>
  WriteBatch& overwrite(Address address, T object, EntryLife life) {
    return overwrite_value(std::move(address), Value::of(std::move(object)), life);
  }

  /// Overwrites an entry whose C++ type is not known here.
  WriteBatch& overwrite_value(Address address, Value value, std::optional<EntryLife> life = {}) {
    items_.push_back({Operation::overwrite, std::move(address), std::move(value), life});
    return *this;
  }

  /// Leaves a will for the entry of the last addition or overwrite: if this component ends, its
  /// working memory overwrites the entry with `object`. It stays until somebody leaves another.
  template <ReflectedRecord T>
  WriteBatch& last_will(T object, EntryLife life = {}) {
    items_.back().last_will = LastWill{Value::of(std::move(object)), life};
    return *this;
  }

  /// Withdraws the will for the entry of the last overwrite.
  WriteBatch& without_last_will() {
    items_.back().last_will = LastWill{};
    return *this;
  }

  WriteBatch& delete_entry(Address address) {
    items_.push_back({Operation::remove, std::move(address), {}, {}});
    return *this;
  }

  const std::vector<Item>& items() const { return items_; }

private:
  std::vector<Item> items_;
};

} // namespace castor
