#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace castor::cli {

using Json = nlohmann::ordered_json;

/// A system of this user that runs on this machine.
struct RunningSystem {
  /// "vision-1234": the file's name and the process's number.
  std::string name;
  std::filesystem::path socket;
};

/// The sockets of this user's systems, with those that killed processes have left behind.
std::vector<std::filesystem::path> sockets();

/// How many of them have been left behind.
std::size_t stale_sockets();

/// What killed processes have left behind is removed.
std::vector<RunningSystem> running_systems();

/// The one whose name begins with `wanted`, or the only one. Throws std::runtime_error, which says
/// how to choose.
RunningSystem choose_system(const std::string& wanted);

/// Asks the system for something, and calls `hear` with every object of the answer, until there is
/// no more. Throws std::runtime_error if the system refuses or ends.
void ask(const RunningSystem& system, const Json& request,
         const std::function<void(const Json&)>& hear);

/// The same, and says more meanwhile: `more` is called several times a second, and what it returns
/// is sent.
void ask(const RunningSystem& system, const Json& request,
         const std::function<void(const Json&)>& hear,
         const std::function<std::vector<Json>()>& more);

/// The answer, where there is one object. Throws std::runtime_error also if there is none.
Json ask_for_one(const RunningSystem& system, const Json& request);

/// All objects of the answer.
std::vector<Json> ask_for_all(const RunningSystem& system, const Json& request);

} // namespace castor::cli
