#pragma once

#include "castor/tools/cli/commands.hpp"

#include <CLI/App.hpp>

#include <memory>

namespace castor::cli {

/// Sets `chosen` to a call of `f` if the user calls the command; `f` returns the exit status.
template <class Arguments, class F>
void on_call(CLI::App& command, Action& chosen, const std::shared_ptr<Arguments>& arguments, F f) {
  command.callback([&chosen, arguments, f] { chosen = [arguments, f] { return f(*arguments); }; });
}

} // namespace castor::cli
