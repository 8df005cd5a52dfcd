#pragma once

#include "castor/actors/cast/hosts.hpp"
#include "castor/actors/cast/parse_options.hpp"
#include "castor/actors/cast/variables.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace castor::cast {

enum class Remarks { no, yes };

/// Reports that localhost is used for an undefined host.
void report_undefined_host(const HostTable& hosts, std::string_view name, const SourceLine& line,
                           DiagnosticLog& log);

/// The variables and hosts of one parse, the limits on the text that replacing them may produce,
/// and the reports of undefined ones.
class Scope {
public:
  Scope(const Limits& limits, DiagnosticLog& log);

  VariableTable& variables() noexcept { return variables_; }
  HostTable& hosts() noexcept { return hosts_; }

  /// Replaces variables in a piece of `line`. Without remarks, undefined names cause no warnings
  /// and are not remembered as used.
  /// @returns nothing, after an error, if the result is longer than the limits allow
  std::optional<std::string> expand(const SourceLine& line, std::string_view text,
                                    Undefined undefined, Remarks remarks);

  /// Charges a text that was put together from variables to the limits.
  /// @returns false, after an error, if it exceeds them
  bool admit(const SourceLine& line, std::string_view text);

  /// The limit on all expansions together is exceeded: the rest need not be read.
  bool exhausted() const noexcept { return exhausted_; }

private:
  void report_undefined_variable(const SourceLine& line, std::string_view name,
                                 Undefined undefined);

  const Limits& limits_;
  DiagnosticLog& log_;
  VariableTable variables_;
  HostTable hosts_;
  /// Bytes that replacement of variables may still produce.
  std::size_t budget_;
  bool exhausted_ = false;
};

} // namespace castor::cast
