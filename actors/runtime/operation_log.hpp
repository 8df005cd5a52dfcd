#pragma once

#include "castor/wm/entries/failure.hpp"
#include "castor/wm/memory/working_memory_messages.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

/// Log of the operations of components on working memories and their outcomes, from which
/// linearizability is checked afterwards.
namespace castor {

/// The log file of one process. Written lines survive the process, however it ends. Safe to use
/// from any thread.
class OperationLog {
public:
  /// Extension of the files.
  static constexpr const char* extension = ".operations";

  /// A new file in that folder. Throws std::runtime_error.
  explicit OperationLog(const std::filesystem::path& folder);
  OperationLog(const OperationLog&) = delete;
  OperationLog& operator=(const OperationLog&) = delete;
  ~OperationLog();

  /// The number of an operation that begins.
  std::uint64_t next() { return ++last_; }

  /// Appends a line.
  void write(std::string line);

private:
  int file_ = -1;
  std::atomic<std::uint64_t> last_{0};
};

/// Logs the operations of one component, and what it executes or obeys: JSON, a line for the
/// beginning of each and another one once it is answered.
///
///     {"begin": 7, "at": nanoseconds, "component": "segmentor", "life": 1, "do": "overwrite",
///      "where": "vision", "id": "0:3", "content": hash, "seen": 4, "expected": false,
///      "token": 0, "has_life": false}
///     {"end": 7, "at": nanoseconds, "version": 5}
///
/// An effector logs each command that it obeys, and each time that it takes its safe state:
///
///     {"obeys": "wheel", "at": nanoseconds, "type": "Turn", "component": "driver", "life": 1,
///      "token": 7, "where": "navigation", "id": "drive"}
///     {"rests": "wheel", "at": nanoseconds, "type": "Turn"}
///
/// A component that executes actions logs each one before its handler begins, with the entry of the
/// action:
///
///     {"executes": "arm", "at": nanoseconds, "life": 1, "type": "PickUp", "where": "planning",
///      "id": "3:1"}
///
/// Times are those of the machine's monotonic clock. An end has what the operation gave (version,
/// content, token, exists), or `failure`, a FailureKind as a number; with `another` if that was the
/// failure of another write of the same batch.
class OperationRecorder {
public:
  using Clock = std::chrono::steady_clock;

  OperationRecorder(OperationLog& log, ClientPtr client) : log_(log), client_(std::move(client)) {}

  /// Request under way.
  struct Open {
    Clock::time_point since = Clock::now();
    std::vector<std::uint64_t> numbers = {};
    /// Addresses of the writes of a batch.
    std::vector<Address> where = {};
  };

  // Before a request is sent.
  Open begin(const WriteRequest& x);
  Open begin(const BatchRequest& x);
  Open begin(const ReadRequest& x);
  Open begin(const LockRequest& x);
  Open begin(const UnlockRequest& x);
  Open begin(const ExistsQuery& x);
  Open begin(const VersionQuery& x);
  template <class Request>
  Open begin(const Request&) {
    return {};
  }

  /// An entry that was read without a request.
  void read_here(const EntryPtr& entry, Clock::time_point since);

  // Of an effector.
  /// @param lease the entry whose lease it demands; null for none
  void obeys(const std::string& type, const Client& commander, LeaseToken token,
             const Address* lease);
  void rests(const std::string& type);

  // Of a component that executes actions.
  void executes(const std::string& type, const Address& action);

  /// The request has that id.
  void sent(std::uint64_t id, Open x) { open_[id] = std::move(x); }

  // The outcome of the request.
  void end(std::uint64_t id, const Outcome<Version>& x);
  void end(std::uint64_t id, const Outcome<std::vector<Version>>& x);
  void end(std::uint64_t id, const Outcome<EntryPtr>& x);
  /// Outcome of a query: logged as a read of each entry that it found, begin and end.
  void end(std::uint64_t id, const Outcome<std::vector<EntryPtr>>& x);
  void end(std::uint64_t id, const Outcome<bool>& x);
  void end(std::uint64_t id, const Outcome<Lease>& x);
  void end(std::uint64_t id, const Outcome<Acknowledged>& x);
  template <class Reply>
  void end(std::uint64_t id, const Outcome<Reply>&) {
    open_.erase(id);
  }

private:
  class Line;
  Line begin_line(std::string_view operation, const Address& address,
                  Clock::time_point since = Clock::now());
  Line begin_write(const WriteRequest& x);
  void write(const Line& x);
  std::uint64_t write_begin(const Line& x);
  /// Calls `describe` for each of the operations that were asked for with that request, with the
  /// line of its end and its place.
  template <class T, class F>
  void end_all(std::uint64_t id, const Outcome<T>& outcome, F&& describe);

  OperationLog& log_;
  const ClientPtr client_;
  /// By the ids of the requests.
  std::unordered_map<std::uint64_t, Open> open_;
};

} // namespace castor
