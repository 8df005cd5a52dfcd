#include "castor/tools/chaos/recorded_operations.hpp"

#include "castor/tools/chaos/answers.hpp"
#include "castor/tools/chaos/change_check.hpp"
#include "castor/tools/chaos/read_logs.hpp"
#include "castor/tools/chaos/rounded.hpp"
#include "castor/tools/linearizability/lease_expiries.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <regex>
#include <set>
#include <unordered_map>

namespace castor::faults {

namespace {

using namespace linearizability;
using Kind = linearizability::Verdict::Kind;

std::optional<OperationKind> kind_of(const std::string& name) {
  for (auto kind : {OperationKind::add, OperationKind::overwrite, OperationKind::remove,
                    OperationKind::read, OperationKind::exists, OperationKind::version,
                    OperationKind::lock, OperationKind::try_lock, OperationKind::unlock})
    if (name == to_string(kind))
      return kind;
  return std::nullopt;
}

void take_end(RecordedOperation& x, const nlohmann::json& line) {
  auto& record = x.record;
  record.returned = line.at("at").get<Tick>();
  if (line.contains("failure")) {
    auto failure = static_cast<FailureKind>(line.at("failure").get<int>());
    auto status = status_of(failure, record.kind);
    // Whoever was not answered does not know; nor does who was refused for other reasons care.
    if (!status || *status == Status::timed_out)
      record.returned = never;
    // A batch is made or refused as a whole: refused for another of its writes, this one was not
    // made; but if the batch was not answered, all of them may have been.
    x.says_nothing =
      (line.value("another", false) && !record.pending()) ||
      (!status && failure != FailureKind::working_memory_lost && failure != FailureKind::deadlock);
    if (status)
      record.result.status = *status;
    return;
  }
  record.result.version = line.value("version", Version{0});
  record.result.content = line.value("content", Content{0});
  record.result.token = line.value("token", Token{0});
  if (!line.value("exists", true))
    record.result.status = Status::does_not_exist;
}

/// The life of a working memory that gave, or was shown, this number.
std::uint64_t life_of(std::uint64_t number) {
  return number / numbers_per_life;
}

bool is_write(OperationKind x) {
  return x == OperationKind::add || x == OperationKind::overwrite || x == OperationKind::remove;
}

/// In which of a working memory's lives an operation was answered; nothing if that cannot be told.
std::optional<std::uint64_t> life_of(const OperationRecord& x) {
  if (x.pending() || x.result.status != Status::ok)
    return std::nullopt;
  switch (x.kind) {
    case OperationKind::exists:
      return std::nullopt;
    case OperationKind::lock:
    case OperationKind::try_lock:
      return life_of(x.result.token);
    case OperationKind::unlock:
      return life_of(x.token);
    default:
      return life_of(x.result.version);
  }
}

/// The same with numbers that begin with the life.
OperationRecord in_life(OperationRecord x, std::uint64_t life) {
  auto base = life * numbers_per_life;
  auto shift = [&](std::uint64_t& number) { number = number < base ? 0 : number - base; };
  shift(x.result.version);
  shift(x.result.token);
  shift(x.token);
  if (x.last_seen)
    shift(*x.last_seen);
  return x;
}

/// The operations that count, by the working memory's lives.
std::map<std::uint64_t, History> by_life(const History& all, bool one_life) {
  std::map<std::uint64_t, History> result;
  if (one_life) {
    result[0] = all;
    return result;
  }
  std::vector<const OperationRecord*> unanswered;
  for (auto& x : all) {
    if (auto life = life_of(x))
      result[*life].push_back(in_life(x, *life));
    else if (x.pending())
      unanswered.push_back(&x);
    // What else was refused, or only looked whether there is an entry, may have been so in any.
  }
  // One that was not answered may have been done in any life that it does not contradict.
  for (auto& [life, history] : result)
    for (auto* x : unanswered)
      if ((!x->last_seen || life_of(*x->last_seen) == life) &&
          (x->token == 0 || life_of(x->token) == life))
        history.push_back(in_life(*x, life));
  return result;
}

/// What the checker calls by numbers has names.
std::string with_names(const std::string& report, const Recording& recording) {
  static const std::regex number{"(entry|client) ([0-9]+)"};
  std::map<std::string, std::string> names;
  for (auto& x : recording) {
    names["entry " + std::to_string(x.record.entry)] = to_string(x.address);
    names["client " + std::to_string(x.record.client)] =
      x.life == 1 ? x.component : fmt::format("{} in life {}", x.component, x.life);
  }
  std::string result;
  auto rest = report.begin();
  for (std::sregex_iterator i{report.begin(), report.end(), number}, end; i != end; ++i) {
    result.append(rest, (*i)[0].first);
    auto name = names.find(i->str());
    result += name == names.end() ? i->str() : name->second;
    rest = (*i)[0].second;
  }
  return result.append(rest, report.end());
}

} // namespace

void RecordingReader::read(std::istream& in) {
  std::unordered_map<std::uint64_t, std::size_t> open;
  for (std::string text; std::getline(in, text);) {
    auto line = nlohmann::json::parse(text, nullptr, false);
    if (!line.is_object() || !(line.contains("begin") || line.contains("end")))
      continue;
    if (line.contains("end")) {
      if (auto i = open.find(line.at("end").get<std::uint64_t>()); i != open.end())
        take_end(recording_[i->second], line);
      continue;
    }
    auto kind = kind_of(line.at("do").get<std::string>());
    if (!kind)
      continue;
    open[line.at("begin").get<std::uint64_t>()] = recording_.size();
    auto& x = recording_.emplace_back();
    x.component = line.at("component").get<std::string>();
    x.life = line.at("life").get<std::uint64_t>();
    x.address = {line.at("where").get<std::string>(), line.at("id").get<std::string>()};
    x.expected = line.value("expected", false);
    x.has_life = line.value("has_life", false);
    auto& record = x.record;
    record.client = clients_.try_emplace({x.component, x.life}, clients_.size()).first->second;
    record.entry = entries_.try_emplace(x.address, entries_.size()).first->second;
    record.kind = *kind;
    record.invoked = line.at("at").get<Tick>();
    record.content = line.value("content", Content{0});
    record.token = line.value("token", Token{0});
    if (line.contains("seen"))
      record.last_seen = line.at("seen").get<Version>();
    if (line.contains("level"))
      record.level = static_cast<linearizability::LockLevel>(line.at("level").get<int>() + 1);
  }
}

Recording read_operations(const std::filesystem::path& folder) {
  RecordingReader reader;
  read_logs(folder, [&](std::istream& in) { reader.read(in); });
  return reader.take();
}

Judgement judge_operations(const Recording& recording, const MemoryConditions& conditions,
                           const std::set<Life>& ended, Tick until) {
  Judgement result;
  if (!conditions.unknown.empty()) {
    result.verdict = Kind::undecided;
    result.grounds = conditions.unknown;
    return result;
  }
  std::set<std::uint32_t> passing;
  for (auto& x : recording)
    if (x.has_life)
      passing.insert(x.record.entry);
  History all;
  std::map<linearizability::Client, Tick> ends;
  std::set<std::uint32_t> entries;
  for (auto& x : recording) {
    if (x.address.subarchitecture != conditions.subarchitecture || x.record.invoked > until)
      continue;
    auto record = x.record;
    if (record.returned != never && record.returned > until)
      record.returned = never;
    if (ended.count({x.component, x.life}) > 0) {
      auto last = record.pending() ? record.invoked : record.returned;
      auto& end = ends.try_emplace(record.client, last).first->second;
      end = std::max(end, last);
    }
    if (x.says_nothing || passing.count(record.entry) > 0)
      continue;
    if (x.expected && (record.pending() || record.result.status != Status::ok)) {
      // What it counted on may not have come about; then it is refused whatever the version.
      if (!record.pending())
        continue;
      record.last_seen.reset();
    }
    entries.insert(record.entry);
    all.push_back(record);
  }
  auto lives = by_life(all, !conditions.went_down || conditions.durable);
  Checker checker;
  for (auto& [life, history] : lives) {
    auto lapses = possible_lease_expiries(
      history, static_cast<Tick>(conditions.lease.count()) * 1000, ends, until);
    history.insert(history.end(), lapses.begin(), lapses.end());
    auto verdict = checker.check(history);
    if (verdict.ok() || result.verdict == Kind::violation)
      continue;
    result.verdict = verdict.kind;
    result.report = with_names(verdict.report, recording);
  }
  result.grounds = counted(all.size(), "operation", "operations") + " on " +
                   counted(entries.size(), "entry", "entries") +
                   (lives.size() > 1 ? ", in " + counted(lives.size(), "life", "lives") : "");
  return result;
}

namespace {

/// The working memory itself has made the change.
bool is_made_by_memory(const ChangeEvent& x) {
  if (x.operation == Operation::remove)
    return x.source == expiry_source || x.source == owner_ended_source;
  return x.operation == Operation::overwrite && x.source == last_will_source;
}

} // namespace

Judgement judge_events(const Recording& recording, const MemoryConditions& conditions,
                       std::span<const ChangeEventPtr> told) {
  Judgement result{Kind::undecided, conditions.unknown, {}};
  if (conditions.went_down)
    result.grounds = "the working memory was down in between";
  if (!result.grounds.empty())
    return result;
  if (std::ranges::any_of(told, [](auto& x) { return x->coalesced; })) {
    result.grounds = "they came faster than they could be taken, and were merged";
    return result;
  }
  std::vector<ObservedWrite> writes;
  std::set<Address> passing;
  for (auto& x : recording) {
    if (x.address.subarchitecture != conditions.subarchitecture || !is_write(x.record.kind))
      continue;
    if (x.has_life)
      passing.insert(x.address);
    if (!x.record.pending() && x.record.result.status != Status::ok)
      continue;
    auto operation = x.record.kind == OperationKind::add         ? Operation::add
                     : x.record.kind == OperationKind::overwrite ? Operation::overwrite
                                                                 : Operation::remove;
    writes.push_back({operation, x.address, x.component, x.record.result.version, x.record.invoked,
                      x.record.returned});
  }
  // Entries that go of themselves, and last wills: nobody knows when, so any moment is right.
  for (auto& event : told)
    if (is_made_by_memory(*event) && passing.contains(event->address))
      writes.push_back({event->operation, event->address, event->source, 0, 0, never});
  result.verdict = Kind::ok;
  result.grounds = counted(told.size(), "change", "changes");
  for (auto& fault : faults_of(told, told.empty() ? 0 : told.back()->sequence, writes)) {
    result.verdict = Kind::violation;
    result.report += fault + '\n';
  }
  return result;
}

} // namespace castor::faults
