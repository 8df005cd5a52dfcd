#include "castor/tools/simulation/journal_check.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace castor::simulation {

namespace {

/// A journal is written so long after its delay at the latest, if nothing goes wrong.
constexpr std::chrono::milliseconds most_journal_latency{100};

/// The changes in a journal.
class JournalContents {
public:
  explicit JournalContents(const std::vector<JournalRecord>& records) {
    for (auto& x : records) {
      records_[x.sequence] = &x;
      last_[x.session] = x.sequence;
    }
  }

  bool has(const ChangeEvent& event) const {
    auto i = records_.find(event.sequence);
    return i != records_.end() && i->second->id == event.address.id &&
           i->second->version == event.version && i->second->operation == event.operation;
  }

  /// The number of the last change of a session, if it has made any.
  std::optional<std::uint64_t> last_of(std::uint64_t session) const {
    auto i = last_.find(session);
    return i == last_.end() ? std::nullopt : std::optional{i->second};
  }

private:
  std::map<std::uint64_t, const JournalRecord*> records_;
  std::map<std::uint64_t, std::uint64_t> last_;
};

/// The last change in the journal of the life of a working memory.
std::uint64_t last_journaled(const MemoryLife& life, const JournalContents& journal) {
  return journal.last_of(life.session).value_or(life.first_sequence - 1);
}

/// 1 is the first change that the journal lacks.
std::uint64_t number_among_lost(const ChangeEvent& event, const MemoryLife& life,
                                const JournalContents& journal) {
  return event.sequence - last_journaled(life, journal);
}

/// Why a change that somebody was told of by then cannot be missing in the journal; empty if it
/// can.
std::string why_not_to_be_lost(const ChangeEvent& event, Timestamp told, const MemoryLife& life,
                               const JournalContents& journal) {
  if (life.journal.mode == JournalMode::full)
    return " though it is a full one";
  if (life.alive())
    return ", of a working memory that has not ended";
  if (event.sequence < last_journaled(life, journal))
    return ", which has later ones";
  if (auto number = number_among_lost(event, life, journal); number > life.journal.most_unsynced)
    return ", nor are the " + std::to_string(number - 1) + " before it, of which only " +
           std::to_string(life.journal.most_unsynced) + " may be lost";
  auto age = life.end_time - told;
  if (life.is_written_in_time && age > life.journal.delay + most_journal_latency)
    return ", " + std::to_string(age.count() / 1000) + " ms before the working memory ended";
  return {};
}

} // namespace

JournalCounts check_journals(SystemWorld& world, const SimulatedMachines& machines) {
  JournalCounts result;
  for (auto& [name, lives] : machines.memories()) {
    if (lives.front().session == 0)
      continue;
    JournalContents journal{machines.disk_of(lives.front().process).records(name)};
    for (auto& told : world.told)
      for (std::size_t i = 0; i < told->events.size(); ++i) {
        auto& event = *told->events[i];
        if (event.address.subarchitecture != name)
          continue;
        if (journal.has(event)) {
          ++result.found;
          continue;
        }
        auto& life = *life_of(event, lives);
        auto why = why_not_to_be_lost(event, told->times[i], life, journal);
        if (why.empty()) {
          ++result.lost;
          result.lost_at_bound +=
            number_among_lost(event, life, journal) == life.journal.most_unsynced;
        } else {
          world.find(told->component + " was told of " + to_string(event) + ", number " +
                     std::to_string(event.sequence) + ", which is not in the journal" + why);
        }
      }
  }
  return result;
}

} // namespace castor::simulation
