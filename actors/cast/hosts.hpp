#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cast {

/// Host that an expression stands for.
struct ResolvedHost {
  std::string host;
  /// False if it names a host that nobody defined: `host` is then what localhost stands for.
  bool defined = true;
};

/// The names that HOSTNAME lines give to hosts. A name's first definition counts; using an
/// undefined name defines it as localhost, so that all uses of one parse agree.
class HostTable {
public:
  enum class Outcome {
    defined,
    /// An earlier HOSTNAME line has defined it. This is no error: the first definition counts.
    defined_before,
    /// It was used before, and thereby stands for localhost already.
    used_before
  };

  Outcome define(std::string_view name, std::string host);

  /// Marks a name as used: if it is undefined, later definitions have no effect (`used_before`).
  void mark_used(std::string_view name);

  /// Replaces `[Name]` by its definition, and `localhost` and `127.0.0.1` by that of the name
  /// `localhost`. Any other expression stands for itself.
  ResolvedHost resolve(std::string_view expression) const;

  ResolvedHost look_up(std::string_view name) const;

  /// `resolve`, and remembers the use.
  ResolvedHost use(std::string_view expression);

  bool is_defined(std::string_view name) const;

  /// The explicit definitions.
  std::map<std::string, std::string> definitions() const;

  /// For suggestions: the explicitly defined names, or some of them if there are more than `max`.
  std::vector<std::string_view> names(std::size_t max) const;

private:
  struct Entry {
    std::string host;
    bool implicit = false;
  };

  std::string localhost() const;

  std::map<std::string, Entry, std::less<>> entries_;
};

/// The name in `[Name]`; empty for any other expression.
std::string_view bracketed_host(std::string_view expression) noexcept;

/// `localhost` or `127.0.0.1`.
bool is_localhost(std::string_view host) noexcept;

} // namespace castor::cast
