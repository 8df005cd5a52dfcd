#include "castor/actors/system/replay.hpp"

#include "castor/actors/runtime/shell_protocol.hpp"

#include <caf/atom.hpp>

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

namespace castor {

namespace {

using StepAtom = caf::atom_constant<caf::atom("step")>;
using TellAtom = caf::atom_constant<caf::atom("tell")>;
using Clock = std::chrono::steady_clock;

/// How long a working memory may take to answer.
constexpr std::chrono::seconds patience{10};

/// How often a write is tried whose entry others change meanwhile.
constexpr int attempts = 5;

constexpr std::chrono::milliseconds time_between_reports{200};

class Replay : public std::enable_shared_from_this<Replay> {
public:
  Replay(caf::event_based_actor* self, std::shared_ptr<ReplayParts> parts)
    : self_(self), parts_(std::move(parts)) {}

  caf::behavior begin() {
    open();
    step();
    if (parts_->on_progress)
      tell();
    auto replay = shared_from_this();
    return {[replay](StepAtom, std::uint64_t timer) { replay->time_has_come(timer); },
            [replay](TellAtom) { replay->tell(); }, [replay](ReplayControl x) { replay->obey(x); }};
  }

private:
  // -- step by step

  void open() {
    try {
      recording_.emplace(parts_->selection);
    } catch (const JournalError& e) {
      outcome_.problem = e.what();
    }
  }

  /// On to the next step, when its time has come.
  void step() {
    carried_out_ = true;
    if (over_)
      return end();
    step_ = fetch();
    carried_out_ = false;
    if (!step_ && !lasts_longer())
      return end_round();
    wait();
  }

  std::optional<RecordedStep> fetch() {
    is_preparing_ = !first_.empty();
    if (is_preparing_) {
      auto result = std::move(first_.front());
      first_.pop_front();
      return result;
    }
    try {
      auto result = recording_ ? recording_->next() : std::nullopt;
      if (result && parts_->to.count() > 0 && time_of(*result) >= parts_->to)
        return std::nullopt;
      return result;
    } catch (const JournalError& e) {
      outcome_.problem = e.what();
      return std::nullopt;
    }
  }

  UnixTime end_time() const {
    return parts_->to.count() > 0 && parts_->to < parts_->end ? parts_->to : parts_->end;
  }

  bool lasts_longer() const {
    return parts_->speed > 0 && began_ && position() < end_time() && outcome_.problem.empty();
  }

  void wait() {
    if (paused_)
      return;
    if (is_preparing_)
      return self_->send(self_, StepAtom::value, ++timer_);
    auto time = step_ ? time_of(*step_) : end_time();
    if (!began_)
      began_ = {Clock::now(), parts_->selection.from.count() > 0 ? parts_->selection.from : time};
    if (parts_->speed <= 0) {
      began_->second = std::max(began_->second, time);
      return self_->send(self_, StepAtom::value, ++timer_);
    }
    auto after =
      std::chrono::duration_cast<Clock::duration>((time - began_->second) / parts_->speed);
    self_->delayed_send(self_, std::max(Clock::duration{0}, began_->first + after - Clock::now()),
                        StepAtom::value, ++timer_);
  }

  void time_has_come(std::uint64_t timer) {
    if (timer != timer_ || paused_ || over_ || std::exchange(carried_out_, true))
      return;
    if (!step_)
      return end_round();
    ++steps_;
    if (auto* x = std::get_if<RecordedValue>(&*step_)) {
      hand_out(*x);
    } else {
      write_ = &std::get<RecordedWrite>(*step_);
      attempt_ = 0;
      write();
    }
  }

  void end_round() {
    carried_out_ = true;
    if (over_ || round_ == parts_->rounds || !outcome_.problem.empty() ||
        std::exchange(steps_, 0) == 0)
      return end();
    ++round_;
    began_.reset();
    take_back();
    open();
    step();
  }

  /// The entries that were added are removed before anything else happens.
  void take_back() {
    for (auto& [address, source] : std::exchange(added_, {})) {
      JournalRecord record;
      record.id = address.id;
      record.operation = Operation::remove;
      first_.push_back(RecordedWrite{{}, address.subarchitecture, source, {std::move(record)}});
    }
  }

  // -- time

  UnixTime position() const {
    if (!began_)
      return parts_->selection.from;
    if (paused_ || parts_->speed <= 0)
      return began_->second;
    return began_->second +
           std::chrono::duration_cast<UnixTime>((Clock::now() - began_->first) * parts_->speed);
  }

  void obey(ReplayControl x) {
    switch (x) {
      case ReplayControl::pause:
        if (!paused_ && began_)
          began_->second = position();
        paused_ = true;
        return;
      case ReplayControl::go_on:
        if (!std::exchange(paused_, false))
          return;
        if (began_)
          began_->first = Clock::now();
        if (!carried_out_)
          wait();
        return;
      case ReplayControl::end:
        over_ = true;
        // Otherwise when what is under way is done.
        if (!carried_out_)
          end();
        return;
    }
  }

  void tell() {
    parts_->on_progress({outcome_, position(), paused_, round_});
    self_->delayed_send(self_, time_between_reports, TellAtom::value);
  }

  // -- values of stand-alone components

  void hand_out(const RecordedValue& x) {
    auto to = parts_->providers.find(x.provider);
    if (to == parts_->providers.end())
      return refuse("there is no stand-alone component " + x.provider);
    auto replay = shared_from_this();
    self_->request(to->second, patience, HandOut{x.push.value, x.push.pushed})
      .then(
        [replay](Acknowledged) {
          ++replay->outcome_.values;
          replay->step();
        },
        [replay, name = x.provider](const caf::error&) {
          replay->refuse("the stand-alone component " + name + " does not answer");
        });
  }

  // -- writes

  void write() {
    auto wm = parts_->working_memories.find(write_->subarchitecture);
    if (wm == parts_->working_memories.end()) {
      refuse("there is no subarchitecture " + write_->subarchitecture);
      return;
    }
    wm_ = wm->second;
    batch_ = {write_->subarchitecture, {}};
    prepare(0);
  }

  /// Asks how things stand with the entry of one change, and goes on with the next.
  void prepare(std::size_t number) {
    if (number == write_->changes.size())
      return send();
    Address address{write_->subarchitecture, write_->changes[number].id};
    ask<bool>(ExistsQuery{address}, [=, this](bool exists) {
      if (!exists)
        return decide(number, std::nullopt);
      ask<Version>(VersionQuery{address}, [=, this](Version version) { decide(number, version); });
    });
  }

  void decide(std::size_t number, std::optional<Version> version) {
    auto& x = write_->changes[number];
    WriteRequest request;
    request.address = {write_->subarchitecture, x.id};
    request.client =
      std::make_shared<const Client>(Client{write_->source, write_->subarchitecture});
    if (x.operation == Operation::remove) {
      request.operation = Operation::remove;
      if (version)
        batch_.writes.push_back(std::move(request));
      return prepare(number + 1);
    }
    request.operation = version ? Operation::overwrite : Operation::add;
    request.value = x.value;
    request.last_seen = version;
    request.life = x.life;
    batch_.writes.push_back(std::move(request));
    prepare(number + 1);
  }

  void send() {
    if (batch_.writes.empty()) {
      // What goes before another round may have gone of itself.
      if (!is_preparing_)
        ++outcome_.skipped;
      return step();
    }
    auto replay = shared_from_this();
    self_->request(wm_, patience, batch_)
      .then(
        [replay](const Outcome<std::vector<Version>>& x) {
          if (x) {
            replay->note_entries();
            if (!replay->is_preparing_)
              ++replay->outcome_.writes;
            replay->step();
          } else if (++replay->attempt_ < attempts) {
            replay->write();
          } else {
            replay->refuse(x.failure().message);
          }
        },
        [replay](const caf::error&) { replay->lose(); });
  }

  void note_entries() {
    for (auto& x : batch_.writes)
      if (x.operation == Operation::add)
        added_[x.address] = write_->source;
      else if (x.operation == Operation::remove)
        added_.erase(x.address);
  }

  template <class Reply, class Request, class F>
  void ask(const Request& request, F f) {
    auto replay = shared_from_this();
    self_->request(wm_, patience, request)
      .then(
        [replay, f](const Outcome<Reply>& x) {
          if (x)
            f(*x);
          else
            replay->refuse(x.failure().message);
        },
        [replay](const caf::error&) { replay->lose(); });
  }

  void lose() { refuse("the working memory of " + write_->subarchitecture + " does not answer"); }

  void refuse(const std::string& why) {
    if (refusal_.empty())
      refusal_ = why;
    ++outcome_.refused;
    step();
  }

  void end() {
    if (outcome_.problem.empty())
      outcome_.problem = refusal_;
    parts_->done(outcome_);
    self_->quit();
  }

  caf::event_based_actor* self_;
  std::shared_ptr<ReplayParts> parts_;
  std::optional<Recording> recording_;
  /// What comes before that.
  std::deque<RecordedStep> first_;
  /// The step is one of those.
  bool is_preparing_ = false;
  /// Nothing while it only lasts.
  std::optional<RecordedStep> step_;
  /// Whether the step was begun.
  bool carried_out_ = false;
  /// The write of that step.
  const RecordedWrite* write_ = nullptr;
  /// When this moment of the recording was; while paused, only the latter counts.
  std::optional<std::pair<Clock::time_point, UnixTime>> began_;
  std::uint64_t timer_ = 0;
  bool paused_ = false;
  bool over_ = false;
  std::uint64_t round_ = 1;
  /// Of this round.
  std::uint64_t steps_ = 0;
  WorkingMemoryActor wm_;
  BatchRequest batch_;
  int attempt_ = 0;
  /// Who has added what stands there.
  std::map<Address, std::string> added_;
  std::string refusal_;
  ReplayOutcome outcome_;
};

} // namespace

caf::behavior replay(caf::event_based_actor* self, std::shared_ptr<ReplayParts> parts) {
  return std::make_shared<Replay>(self, std::move(parts))->begin();
}

void hand_out_first_values(const SystemRoster& roster,
                           const std::vector<std::filesystem::path>& pushes, UnixTime from) {
  for (auto& file : pushes) {
    auto to = roster.providers.find(PushLogReader{file}.summary().provider);
    if (to == roster.providers.end())
      continue;
    for (auto& x : first_values(file, from))
      caf::anon_send(to->second, HandOut{std::move(x.value), false});
  }
}

} // namespace castor
