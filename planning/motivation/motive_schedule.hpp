#pragma once

#include "castor/actors/component/action_types.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace castor::planning {

/// What the manager is to do for a motive.
struct MotiveOrder {
  enum class Kind : std::uint8_t { begin, end };
  Kind kind = Kind::begin;
  std::string motive;

  friend bool operator==(const MotiveOrder&, const MotiveOrder&) = default;
};

/// Decides which motives are pursued: by priority, cost and resources. A more urgent motive ends
/// one that uses what it needs, which is queued again. Has no clock and does nothing itself.
class MotiveSchedule {
public:
  /// @param most_over motives that are over and are remembered
  explicit MotiveSchedule(std::size_t most_over = 100) : most_over_(most_over) {
    // nop
  }

  /// A motive that is not known yet: rejected if it conflicts, else queued or begun.
  void propose(const std::string& id, Motive motive, Timestamp now);
  /// A motive that is over already, so that questions about it can be answered.
  void recall(const std::string& id, Motive motive);
  /// Nobody wants it any more.
  void withdraw(const std::string& id, const std::string& why, Timestamp now);
  /// Its action is over.
  void ended(const std::string& id, ActionOutcome outcome, const std::string& reason,
             Timestamp now);
  /// Whoever reached its goal ended before that: it is queued again, and dropped if that happens
  /// too often.
  void interrupted(const std::string& id, const std::string& reason, Timestamp now);
  /// Drops motives that have waited for too long.
  void drop_old(Timestamp now);

  /// What is to be done since the last call, in this order.
  std::vector<MotiveOrder> take_orders();
  /// Ids of motives whose status has changed since the last call.
  std::set<std::string> take_changed();

  /// Ids of motives that were over, and are not remembered any more since the last call.
  std::vector<std::string> take_forgotten();

  bool knows(const std::string& id) const { return motives_.contains(id); }
  const Motive& motive(const std::string& id) const { return motives_.at(id).motive; }

  /// A sentence that answers the question.
  /// @param waiting why there will be further motives, the next one first
  std::string answer(const MotiveQuestion& question,
                     const std::vector<std::string>& waiting = {}) const;

private:
  struct Entry {
    Motive motive;
    /// In the order of proposals.
    std::uint64_t number = 0;
    /// Why it was ended by this schedule; empty if it was not.
    std::string withdrawn = {};
    std::int32_t interruptions = 0;
  };
  using Entries = std::map<std::string, Entry>;

  static bool is_over(const Motive& x);
  static bool is_pursued(const Motive& x);
  void set(const std::string& id, MotiveStatus status, const std::string& why, Timestamp now);
  bool is_rejected(const std::string& id, Timestamp now);
  /// Whether `a` comes first.
  static bool precedes(const Entry& a, const Entry& b);
  std::vector<Entries::iterator> queue();
  void decide(Timestamp now);
  void forget_old();
  /// The motive of the question, of those with one of the statuses; null if there is none.
  const Motive* find(const std::string& about, const std::set<MotiveStatus>& statuses) const;
  std::string doing() const;
  std::string next(const std::vector<std::string>& waiting) const;
  std::string why(const std::string& about) const;
  std::string why_not(const std::string& about) const;
  std::string done(const std::string& about) const;
  std::string whether(const std::string& about) const;

  std::size_t most_over_;
  Entries motives_;
  std::uint64_t proposed_ = 0;
  std::vector<MotiveOrder> orders_;
  std::set<std::string> changed_;
  std::vector<std::string> forgotten_;
};

/// "ann asked to 'find the book'", or the cause of a motive of the robot's own.
std::string reason_of(const Motive& x);

} // namespace castor::planning
