#include "castor/actors/node/replay.hpp"

#include <caf/atom.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace castor {

namespace {

using StepAtom = caf::atom_constant<caf::atom("step")>;
using Clock = std::chrono::steady_clock;

/// How long a working memory may take to answer.
constexpr std::chrono::seconds patience{10};

/// How often a write is tried whose entry others change meanwhile.
constexpr int attempts = 5;

class Replay : public std::enable_shared_from_this<Replay> {
public:
  Replay(caf::event_based_actor* self, std::shared_ptr<ReplayParts> parts)
    : self_(self), parts_(std::move(parts)) {}

  caf::behavior begin() {
    step();
    return {[replay = shared_from_this()](StepAtom) { replay->write(); }};
  }

private:
  /// On to the next write, when its time has come.
  void step() {
    try {
      write_ = parts_->recording->next();
    } catch (const JournalError& e) {
      outcome_.problem = e.what();
      write_.reset();
    }
    if (!write_)
      return end();
    if (!began_)
      began_ = {Clock::now(), write_->time};
    attempt_ = 0;
    if (parts_->speed <= 0)
      return self_->send(self_, StepAtom::value);
    auto after =
      std::chrono::duration_cast<Clock::duration>((write_->time - began_->second) / parts_->speed);
    auto now = Clock::now();
    self_->delayed_send(self_, std::max(Clock::duration{0}, began_->first + after - now),
                        StepAtom::value);
  }

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
      ++outcome_.skipped;
      return step();
    }
    auto replay = shared_from_this();
    self_->request(wm_, patience, batch_)
      .then(
        [replay](const Outcome<std::vector<Version>>& x) {
          if (x) {
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
    if (outcome_.problem.empty())
      outcome_.problem = why;
    ++outcome_.refused;
    step();
  }

  void end() {
    parts_->done(outcome_);
    self_->quit();
  }

  caf::event_based_actor* self_;
  std::shared_ptr<ReplayParts> parts_;
  std::optional<RecordedWrite> write_;
  std::optional<std::pair<Clock::time_point, UnixTime>> began_;
  WorkingMemoryActor wm_;
  BatchRequest batch_;
  int attempt_ = 0;
  ReplayOutcome outcome_;
};

} // namespace

caf::behavior replay(caf::event_based_actor* self, std::shared_ptr<ReplayParts> parts) {
  return std::make_shared<Replay>(self, std::move(parts))->begin();
}

} // namespace castor
