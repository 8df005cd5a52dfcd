#pragma once

#include "castor/actors/link/wire.hpp"

#include <caf/message.hpp>

#include <cstdint>
#include <typeindex>
#include <unordered_map>
#include <vector>

namespace castor {

/// The messages that may travel to other processes, which are numbered in the order in which they
/// are listed: both sides must have the same list.
class WireTable {
public:
  using Number = std::uint16_t;

  template <class... Ts>
  static WireTable of() {
    WireTable result;
    (result.add<Ts>(), ...);
    return result;
  }

  /// Writes the number and the content of a message; false, and nothing written, if the message is
  /// not in the table.
  bool write(const caf::type_erased_tuple& message, WireWriter& out) const;

  /// Reads what `write` wrote. Throws DecodeError.
  caf::message read(WireReader& in) const;

private:
  struct Codec {
    void (*write)(const caf::type_erased_tuple& message, WireWriter& out);
    caf::message (*read)(WireReader& in);
  };

  template <class T>
  void add() {
    numbers_.emplace(typeid(T), static_cast<Number>(codecs_.size()));
    codecs_.push_back({[](const caf::type_erased_tuple& message, WireWriter& out) {
                         out.put(message.get_as<T>(0));
                       },
                       [](WireReader& in) { return caf::make_message(in.take<T>()); }});
  }

  std::unordered_map<std::type_index, Number> numbers_;
  std::vector<Codec> codecs_;
};

/// Kind of message, for logs and errors.
const char* name_of_type(const caf::type_erased_tuple& message);

} // namespace castor
