#pragma once

#include "castor/wm/entries/change_event.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>

namespace castor {

/// Calls `f` with the parts of the text of a change event, `to_string(event)`, one after the other.
/// Allocates nothing, so that a signal handler may do it.
template <class F>
void for_each_part(const ChangeEvent& x, F&& f) {
  f(to_string(x.operation));
  f(std::string_view{" "});
  f(std::string_view{x.type_name()});
  f(std::string_view{" "});
  f(std::string_view{x.address.subarchitecture});
  if (!x.address.id.empty()) {
    f(std::string_view{"/"});
    f(std::string_view{x.address.id});
  }
  f(std::string_view{" v"});
  std::array<char, 20> digits{};
  auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x.version).ptr;
  f(std::string_view{digits.data(), static_cast<std::size_t>(end - digits.data())});
  f(std::string_view{" by "});
  f(std::string_view{x.source});
  std::string_view separator = ", changed ";
  auto& fields = x.type->records.front().fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if ((x.changed & field_bit(i)) == 0)
      continue;
    f(separator);
    f(std::string_view{fields[i].name});
    separator = " and ";
  }
  if (x.coalesced)
    f(std::string_view{", coalesced"});
}

} // namespace castor
