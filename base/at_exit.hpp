#pragma once

#include <utility>

namespace castor {

/// Runs `f` when the scope is left, whichever way.
template <class F>
class AtExit {
public:
  explicit AtExit(F f) : f_(std::move(f)) {}
  AtExit(const AtExit&) = delete;
  AtExit& operator=(const AtExit&) = delete;
  ~AtExit() { f_(); }

private:
  F f_;
};

} // namespace castor
