#pragma once

#include "castor/tools/simulation/entry_view.hpp"
#include "castor/tools/simulation/simulated_world.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace castor::linearizability {

/// From one client, through one working memory, to one working memory: first come, first served.
struct Route {
  std::size_t via = 0;
  std::size_t owner = 0;
  bool operator==(const Route&) const = default;
};

/// An operation that was not answered yet.
struct Outstanding {
  /// Rises with every message of the client.
  std::uint64_t number = 0;
  Route route;
  std::vector<Recorder::Index> records;
  WaitNumber wait = 0;
  /// The message by which it was given up; 0 if it was not.
  std::uint64_t given_up_by = 0;
  Tick given_up_at = never;
};

/// The operations of a simulated client that were not answered yet, and what answers to others say
/// of them.
class OutstandingOperations {
public:
  using Index = Recorder::Index;

  explicit OutstandingOperations(SimulatedWorld& world) : world_(world) {}

  /// One more; returns its number.
  std::uint64_t add(Route route, std::vector<Index> records, WaitNumber wait);

  std::size_t size() const { return operations_.size(); }
  /// Whether an answer is waited for.
  bool is_awaited() const;
  /// Whether one of them is about the entry.
  bool concern(std::uint32_t entry) const;

  /// One that was answered. Of messages that take one route, the answer to a later one says that
  /// the earlier have arrived, if that one has.
  Outstanding take(std::uint64_t number, bool arrived);

  /// One that will not be answered; returns its records.
  std::vector<Index> drop(std::uint64_t number);

  /// One whose wait may be given up; null if there is none.
  Outstanding* find_to_give_up(const std::vector<EntryView>& views);
  /// The next message gives it up.
  void give_up(Outstanding& x);

  /// The lease was granted to one that was given up.
  void grant_unwanted(const Outstanding& x, std::uint32_t entry, Token token);

  /// Nothing more will come: what was not given up, `client` was never answered.
  void settle(const std::string& client);

private:
  /// A lease that was given up before its grant was known.
  struct Unwanted {
    std::uint32_t entry = 0;
    Token token = 0;
    Route route;
    std::uint64_t given_up_by = 0;
  };

  bool can_be_given_up(const Outstanding& x, const std::vector<EntryView>& views) const;

  SimulatedWorld& world_;
  std::deque<Outstanding> operations_;
  std::vector<Unwanted> unwanted_;
  std::uint64_t sent_ = 0;
};

} // namespace castor::linearizability
