#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace castor {

namespace predicate {

/// Limits of received predicates, against hostile senders. Text in bytes.
inline constexpr std::size_t max_text = 64 * 1024;
inline constexpr int max_depth = 100;

} // namespace predicate

/// The text is not a predicate, or the predicate is not allowed.
class PredicateError : public std::runtime_error {
public:
  explicit PredicateError(const std::string& what, std::size_t position = 0)
    : runtime_error(what), position_(position) {}

  /// Position of the error in the text, from 0.
  std::size_t position() const { return position_; }

private:
  std::size_t position_;
};

} // namespace castor
