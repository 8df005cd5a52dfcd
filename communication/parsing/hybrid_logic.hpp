#pragma once

#include "castor/communication/types.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

/// Hybrid-logic dependency semantics as text:
///
///     @w5:thing(square ^ <Number>sg ^ <Colour>(w4:colour ^ blue))
///
/// A nominal has a name, a sort after the colon, and in any order a proposition, features
/// <Name>value, and relations <Name>(nominal). A nominal that has been described needs only its
/// name, in parentheses: <Patient>(w5).
namespace castor::communication {

/// A syntax error in a logical form.
class HybridLogicError : public std::runtime_error {
public:
  HybridLogicError(const std::string& message, std::size_t offset);

  /// In bytes from the beginning of the text.
  std::size_t offset() const { return offset_; }

private:
  std::size_t offset_;
};

/// Parses one or more formulas, separated by `&`; the first determines the root.
/// \throws HybridLogicError
LogicalForm parse_logical_form(std::string_view text);

/// The form from its root on; nominals not reachable from the root follow after `&`.
std::string to_string(const LogicalForm& form);

const Nominal* find_nominal(const LogicalForm& form, std::string_view name);
Nominal* find_nominal(LogicalForm& form, std::string_view name);

/// The dependent of a nominal's first relation `mode`; null if there is none.
const Nominal* dependent(const LogicalForm& form, const Nominal& nominal, std::string_view mode);

/// The value of a nominal's feature; empty if it does not have it.
std::string_view feature(const Nominal& nominal, std::string_view name);

/// <Polarity>neg.
bool is_negated(const Nominal& nominal);

/// <Number>pl.
bool is_plural(const Nominal& nominal);

/// Whether both are equal up to renaming of nominals.
bool equivalent(const LogicalForm& a, const LogicalForm& b);

} // namespace castor::communication
