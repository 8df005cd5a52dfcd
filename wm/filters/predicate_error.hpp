#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace castor {

namespace predicate {

/// What travels is limited, so that no sender can make a receiver busy for long.
inline constexpr std::size_t max_text = 64 * 1024;
inline constexpr int max_depth = 100;

} // namespace predicate

/// A text that is no predicate, or a predicate that cannot be.
class PredicateError : public std::runtime_error {
public:
  explicit PredicateError(const std::string& what, std::size_t position = 0)
    : runtime_error(what), position_(position) {}

  /// Where in the text it stands, from 0.
  std::size_t position() const { return position_; }

private:
  std::size_t position_;
};

} // namespace castor
