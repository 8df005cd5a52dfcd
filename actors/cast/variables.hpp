#pragma once

#include "castor/actors/cast/hosts.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cast {

/// The variables of one parse.
class VariableTable {
public:
  void define(std::string_view name, std::string value);

  /// @returns null if there is no such variable
  const std::string* find(std::string_view name) const;

  /// For suggestions: some of the names, if there are more than `max`.
  std::vector<std::string_view> names(std::size_t max) const;

private:
  std::map<std::string, std::string, std::less<>> values_;
};

/// A line of the form `SETVAR name=value`, without its command.
struct Assignment {
  std::string_view name;
  /// Everything behind the equals sign: quotes and `#` are part of it.
  std::string_view value;
};

/// Reads `name = value`. Nothing if the name is not a letter followed by letters, digits and
/// underscores, or if there is no equals sign.
std::optional<Assignment> parse_assignment(std::string_view text) noexcept;

/// Treatment of `%(name)` if there is no such variable.
enum class Undefined { keep, drop };

/// The prefix by which `%(host:Name)` refers to a HOSTNAME.
inline constexpr std::string_view host_prefix = "host:";

struct Expansion {
  std::string text;
  /// Names, in order of appearance, that were not defined.
  std::vector<std::string_view> undefined_variables;
  /// Names of hosts, without the prefix, that were not defined and became localhost.
  std::vector<std::string_view> undefined_hosts;
  /// Some host was resolved to plain localhost.
  bool uses_localhost = false;
  /// The result would be longer than allowed: `text` is cut.
  bool too_long = false;
};

/// Replaces each `%(name)`. The name is everything up to the next closing parenthesis, blanks
/// included; an unclosed `%(` stays. Replaced text is not expanded again.
/// @param text must outlive the result, which refers to names in it
Expansion expand(std::string_view text, const VariableTable& variables, const HostTable& hosts,
                 Undefined undefined, std::size_t max_bytes);

} // namespace castor::cast
