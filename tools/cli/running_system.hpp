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

/// The sockets of this user's systems, including stale sockets of killed processes.
std::vector<std::filesystem::path> sockets();

/// Number of stale sockets.
std::size_t stale_sockets();

/// The running systems of this user. Removes stale sockets.
std::vector<RunningSystem> running_systems();

/// The system whose name begins with `wanted`, or the only one. Throws std::runtime_error with the
/// possible names.
RunningSystem choose_system(const std::string& wanted);

/// Sends a request, and calls `hear` with every object of the answer until its end. Throws
/// std::runtime_error if the system refuses or ends.
void ask(const RunningSystem& system, const Json& request,
         const std::function<void(const Json&)>& hear);

/// The same, with further messages during the answer: `more` is called several times a second, and
/// the objects that it returns are sent.
void ask(const RunningSystem& system, const Json& request,
         const std::function<void(const Json&)>& hear,
         const std::function<std::vector<Json>()>& more);

/// The answer, for requests with one object as the answer. Throws std::runtime_error also if there
/// is none.
Json ask_for_one(const RunningSystem& system, const Json& request);

/// All objects of the answer.
std::vector<Json> ask_for_all(const RunningSystem& system, const Json& request);

} // namespace castor::cli
