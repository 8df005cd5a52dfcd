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

/// Route of a client's messages, through working memory `via` to working memory `owner`. Messages
/// on one route stay in order.
struct Route {
  std::size_t via = 0;
  std::size_t owner = 0;
  bool operator==(const Route&) const = default;
};

/// An operation without an answer so far.
struct Outstanding {
  /// Number of the client's message, increasing.
  std::uint64_t number = 0;
  Route route;
  std::vector<Recorder::Index> records;
  WaitNumber wait = 0;
  /// Number of the message that gave it up; 0 if it was not given up.
  std::uint64_t given_up_by = 0;
  Tick given_up_at = never;
};

/// The unanswered operations of a simulated client, and conclusions about them from answers to
/// other operations.
class OutstandingOperations {
public:
  using Index = Recorder::Index;

  explicit OutstandingOperations(SimulatedWorld& world) : world_(world) {}

  /// Adds an operation; returns its number.
  std::uint64_t add(Route route, std::vector<Index> records, WaitNumber wait);

  std::size_t size() const { return operations_.size(); }
  /// Whether an operation is unanswered and not given up.
  bool is_awaited() const;
  /// Whether one of them is about the entry.
  bool concern(std::uint32_t entry) const;

  /// Removes and returns an answered operation. If it has arrived, so have all earlier messages on
  /// its route.
  Outstanding take(std::uint64_t number, bool arrived);

  /// Removes an operation that will not be answered; returns its records.
  std::vector<Index> drop(std::uint64_t number);

  /// An operation whose wait may be given up; null if there is none.
  Outstanding* find_to_give_up(const std::vector<EntryView>& views);
  /// Marks it as given up by the next message.
  void give_up(Outstanding& x);

  /// A lease was granted to an operation that had been given up.
  void grant_unwanted(const Outstanding& x, std::uint32_t entry, Token token);

  /// No more answers will come: an operation that was not given up is a finding about `client`.
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
