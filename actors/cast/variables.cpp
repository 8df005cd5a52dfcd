#include "castor/actors/cast/variables.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <utility>

namespace castor::cast {

void VariableTable::define(std::string_view name, std::string value) {
  if (auto found = values_.find(name); found != values_.end())
    found->second = std::move(value);
  else
    values_.emplace(name, std::move(value));
}

const std::string* VariableTable::find(std::string_view name) const {
  auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

std::vector<std::string_view> VariableTable::names(std::size_t max) const {
  std::vector<std::string_view> result;
  for (auto i = values_.begin(); i != values_.end() && result.size() < max; ++i)
    result.push_back(i->first);
  return result;
}

std::optional<Assignment> parse_assignment(std::string_view text) noexcept {
  auto equals = text.find('=');
  if (equals == std::string_view::npos)
    return std::nullopt;
  auto name = trim(text.substr(0, equals));
  if (!is_identifier(name))
    return std::nullopt;
  return Assignment{name, trim(text.substr(equals + 1))};
}

Expansion expand(std::string_view text, const VariableTable& variables, const HostTable& hosts,
                 Undefined undefined, std::size_t max_bytes) {
  Expansion result;
  auto append = [&](std::string_view piece) {
    auto room = max_bytes - result.text.size();
    result.too_long = result.too_long || piece.size() > room;
    result.text += piece.substr(0, room);
  };
  while (!result.too_long) {
    auto begin = text.find("%(");
    auto end = begin == std::string_view::npos ? begin : text.find(')', begin);
    if (end == std::string_view::npos)
      break;
    append(text.substr(0, begin));
    auto name = text.substr(begin + 2, end - begin - 2);
    if (name.starts_with(host_prefix)) {
      auto resolved = hosts.look_up(name.substr(host_prefix.size()));
      append(resolved.host);
      result.uses_localhost = result.uses_localhost || is_localhost(resolved.host);
      if (!resolved.defined)
        result.undefined_hosts.push_back(name.substr(host_prefix.size()));
    } else if (auto value = variables.find(name)) {
      append(*value);
    } else {
      result.undefined_variables.push_back(name);
      if (undefined == Undefined::keep)
        append(text.substr(begin, end + 1 - begin));
    }
    text.remove_prefix(end + 1);
  }
  if (!result.too_long)
    append(text);
  return result;
}

} // namespace castor::cast
