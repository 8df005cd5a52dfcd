// Components that live in several processes and judge what they see of each other.
#include "castor/tests/tools/cli/done.hpp"
#include "castor/tests/tools/cli/event_order.hpp"
#include "castor/tests/tools/cli/tick.hpp"

#include "castor/actors/component/registry.hpp"

#include <fmt/core.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

/// Somebody is out of reach.
struct Missed {
  std::string who;
};
CASTOR_REFLECT(Missed, who)

struct Note {
  int number = 0;
  std::string text;
};
CASTOR_REFLECT(Note, number, text)

struct Blob {
  Bytes bytes;
};
CASTOR_REFLECT(Blob, bytes)

/// How things stand after a flood.
struct Level {
  int entries = 0;
  int version = 0;
};
CASTOR_REFLECT(Level, entries, version)

/// Ends the system once so many components are done.
class Judge final : public UnmanagedComponent {
  void start() override {
    on_change(added<Done>().anywhere(), [this](const ChangeEvent& event) {
      info("{} is done", event.source);
      if (++done_ == count_)
        end_system(judged, "all are done");
    });
  }

  /// Tells the judgement from what the loss of a component or no failure at all amount to.
  static constexpr int judged = 7;

  Option<int> count_{this, "count", 1, "how many have to be done"};
  int done_ = 0;
};
CASTOR_COMPONENT(Judge, "ends the system with status 7 when others are done")

/// Adds an entry and overwrites it until it is stopped, whatever becomes of the others.
class Ticker final : public UnmanagedComponent {
  void run() override {
    auto address = here("tick");
    add(address, Tick{});
    for (int i = 1; is_running(); ++i) {
      try {
        overwrite(address, Tick{i});
      } catch (const DeadlineException&) {
        info("no answer to tick {}", i);
        read<Tick>(address);
      }
      sleep_for(10ms);
    }
  }
};
CASTOR_COMPONENT(Ticker, "ticks for ever")

/// Ends the system when it has heard of so many ticks, each in its turn.
class Listener final : public UnmanagedComponent {
  void start() override {
    if (late_)
      order_.begin_late();
    on_change(overwritten<Tick>().anywhere(), [this](const ChangeEvent& event) {
      order_.check(event);
      if (++heard_ == count_)
        end_system(0, "heard " + std::to_string(heard_) + " ticks, each in its turn");
      if (heard_ == 10)
        info("hears ticks");
    });
  }

  Option<int> count_{this, "count", 20, "how many ticks"};
  Option<bool> late_{this, "late", false, "the first tick may be any"};
  int heard_ = 0;
  EventOrder order_;
};
CASTOR_COMPONENT(Listener, "hears ticks")

/// One of several that tick at home and at their neighbour, and hear each other.
class Member final : public UnmanagedComponent {
  void start() override {
    on_change(changed<Tick>().anywhere(), [this](const ChangeEvent& event) {
      order_.check(event);
      judge();
    });
    on_change(added<Missed>().anywhere(), [this](const ChangeEvent&) {
      missed_ = true;
      for (auto& x : ring(survivors_))
        before_[x] = order_.last(x);
    });
  }

  void run() override {
    auto tick = here("tick");
    auto& all = all_.get();
    auto self = std::find(all.begin(), all.end(), subarchitecture());
    Address neighbour{self + 1 == all.end() ? all.front() : *(self + 1),
                      "from-" + subarchitecture()};
    add(tick, Tick{});
    add(neighbour, Tick{});
    for (int i = 1; is_running(); ++i) {
      overwrite(tick, Tick{i});
      try {
        if (!alone_)
          overwrite(neighbour, Tick{i});
      } catch (const DeadlineException&) {
        alone_ = true;
        add(Missed{neighbour.subarchitecture});
      }
      sleep_for(10ms);
    }
  }

  /// All entries that these members write at home and at each other.
  static std::vector<Address> ring(const std::vector<std::string>& members) {
    std::vector<Address> result;
    for (std::size_t i = 0; i < members.size(); ++i) {
      result.push_back({members[i], "tick"});
      if (i > 0)
        result.push_back({members[i], "from-" + members[i - 1]});
    }
    return result;
  }

  void judge() {
    auto heard = [this](const std::vector<std::string>& members, Version more) {
      auto entries = ring(members);
      return std::all_of(entries.begin(), entries.end(), [&](auto& x) {
        auto before = before_.find(x);
        return order_.last(x) >= more + (before == before_.end() ? 0 : before->second);
      });
    };
    if (!missed_ && !hears_all_ && heard(all_, 10)) {
      hears_all_ = true;
      info("hears everybody");
    }
    if (missed_ && !done_ && heard(survivors_, 50)) {
      done_ = true;
      add(Done{component_name()});
    }
  }

  Option<std::vector<std::string>> all_{this, "all", {}, "subarchitectures with a member"};
  Option<std::vector<std::string>> survivors_{
    this, "survivors", {}, "those that go on when one is missed"};
  EventOrder order_;
  std::map<Address, Version> before_;
  bool hears_all_ = false;
  bool alone_ = false;
  bool missed_ = false;
  bool done_ = false;
};
CASTOR_COMPONENT(Member, "ticks with others")

/// Adds an entry, and takes it over when the lease of the one that holds it has run out.
class Heir final : public UnmanagedComponent {
  void start() override {
    on_change(overwritten<Tick>().at(here("estate")), [this](const ChangeEvent&) { held_ = true; });
  }

  void run() override {
    auto estate = here("estate");
    add(estate, Tick{});
    while (!held_)
      if (!wait_for_changes())
        return;
    info("waits for the lease");
    auto guard = lock(estate, LockLevel::od, 25s);
    read<Tick>(estate);
    overwrite(estate, Tick{-1});
    info("has taken the lease");
  }

  bool held_ = false;
};
CASTOR_COMPONENT(Heir, "takes over what others hold")

/// Writes under a lease until that is refused, and then again under a new one.
class Holder final : public UnmanagedComponent {
  void start() override {
    on_change(added<Tick>().in(where_), [this](const ChangeEvent&) { there_ = true; });
  }

  void run() override {
    Address estate{where_, "estate"};
    while (!there_)
      if (!wait_for_changes())
        return;
    try {
      auto guard = lock(estate, LockLevel::od);
      read<Tick>(estate);
      for (int i = 1; is_running(); ++i) {
        overwrite(estate, Tick{i});
        sleep_for(5ms);
      }
    } catch (const LeaseLostException& e) {
      info("is refused: {}", e.what());
      auto guard = lock(estate, LockLevel::od);
      if (auto now = read<Tick>(estate); now->number != -1)
        throw std::runtime_error("a stale write was made: " + std::to_string(now->number));
      overwrite(estate, Tick{});
      add(Done{component_name()});
    }
  }

  Option<std::string> where_{this, "where", "a", "subarchitecture of the heir"};
  bool there_ = false;
};
CASTOR_COMPONENT(Holder, "holds an entry of another subarchitecture")

/// Writes into another working memory; done when that works again after it did not.
class RemoteWriter final : public UnmanagedComponent {
  void run() override {
    Address there{where_, "remote"};
    add(there, Tick{});
    for (int i = 1; is_running(); ++i) {
      try {
        if (missed_) {
          read<Tick>(there);
          overwrite(there, Tick{i});
          add(Done{component_name()});
          return;
        }
        overwrite(there, Tick{i});
      } catch (const DeadlineException& e) {
        missed_ = true;
        info("is not answered: {}", e.what());
      }
      if (i == 10)
        info("writes");
      sleep_for(5ms);
    }
  }

  Option<std::string> where_{this, "where", "b", "subarchitecture that it writes to"};
  bool missed_ = false;
};
CASTOR_COMPONENT(RemoteWriter, "writes into another working memory")

/// Writes large entries into another working memory, and reads them there.
class Bulk final : public UnmanagedComponent {
  void run() override {
    Bytes bytes(static_cast<std::size_t>(megabytes_) << 20);
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::uint8_t>(i * i >> 8);
    for (int i = 0; i < times_; ++i) {
      Address there{where_, "bulk-" + std::to_string(i)};
      try {
        add(there, Blob{bytes});
      } catch (const EntryTooLargeException& e) {
        info("is refused: {}", e.what());
        bytes.resize(1000);
        add(there, Blob{bytes});
      }
      if (read<Blob>(there)->bytes != bytes)
        throw std::runtime_error("what is read is not what was written");
    }
    add(Done{component_name()});
  }

  Option<std::string> where_{this, "where", "b", "subarchitecture that it writes to"};
  Option<int> megabytes_{this, "megabytes", 50, "size of an entry"};
  Option<int> times_{this, "times", 1, "how many entries"};
};
CASTOR_COMPONENT(Bulk, "writes and reads large entries")

/// Makes small operations on another working memory until the system's `Bulk` is done, and says how
/// long the longest took.
class Pedestrian final : public UnmanagedComponent {
  void start() override {
    on_change(added<Done>().anywhere(), [this](const ChangeEvent&) { over_ = true; });
  }

  void run() override {
    using Clock = std::chrono::steady_clock;
    Address there{where_, "small"};
    Clock::duration longest{0};
    int count = 0;
    add(there, Tick{});
    while (!over_ && sleep_for(1ms)) {
      auto begin = Clock::now();
      overwrite(there, Tick{++count});
      longest = std::max(longest, Clock::now() - begin);
      if (read<Tick>(there)->number != count)
        throw std::runtime_error("what is read is not what was written");
    }
    end_system(0, fmt::format("the longest of {} small writes took {:.1f} ms", count,
                              std::chrono::duration<double, std::milli>(longest).count()));
  }

  Option<std::string> where_{this, "where", "b", "subarchitecture that it writes to"};
  bool over_ = false;
};
CASTOR_COMPONENT(Pedestrian, "makes small operations beside large ones")

/// Overwrites entries as fast as it can, and says at last how often it did.
class Flood final : public UnmanagedComponent {
  void run() override {
    auto entry = [this](int i) { return here("drop-" + std::to_string(i)); };
    for (int i = 0; i < entries_; ++i)
      add(entry(i), Tick{});
    auto until = now() + time_.get();
    int rounds = 0;
    while (is_running() && now() < until) {
      ++rounds;
      for (int i = 0; i < entries_; ++i)
        overwrite(entry(i), Tick{rounds});
    }
    info("made {} changes", rounds * entries_);
    add(Level{entries_, rounds});
  }

  Option<int> entries_{this, "entries", 50, "how many"};
  Option<std::chrono::milliseconds> time_{this, "time", 4s, "for how long"};
};
CASTOR_COMPONENT(Flood, "overwrites as fast as it can")

/// Ends the system when it has heard of the newest version of every entry that was flooded, of
/// which it cannot have heard one by one.
class Drain final : public UnmanagedComponent {
  void start() override {
    on_change(changed<Tick>().anywhere(), [this](const ChangeEvent& event) {
      order_.check(event);
      if (++heard_ == 1000)
        info("hears the flood");
      judge(event.address.subarchitecture);
    });
    on_change(added<Level>().anywhere(), [this](const ChangeEvent& event) {
      level_ = read<Level>(event.address).object;
      judge(event.address.subarchitecture);
    });
  }

  void judge(const std::string& source) {
    if (!level_)
      return;
    for (int i = 0; i < level_->entries; ++i)
      if (order_.last({source, "drop-" + std::to_string(i)}) != Version(level_->version))
        return;
    if (order_.merged() == 0)
      throw std::runtime_error("nothing was merged");
    end_system(0, fmt::format("heard {} changes, {} of them merged", heard_, order_.merged()));
  }

  EventOrder order_;
  int heard_ = 0;
  std::shared_ptr<const Level> level_;
};
CASTOR_COMPONENT(Drain, "hears how things stand after a flood")

/// Provides and pushes ticks.
class Beacon final : public StandaloneComponent {
  void start() override {
    provide<Tick>([] { return Tick{1000}; });
  }

  void run() override {
    for (int i = 1; sleep_for(5ms); ++i)
      push(Tick{i});
  }
};
CASTOR_COMPONENT(Beacon, "provides and pushes ticks")

/// Pushes as fast as it can, and one last time.
class PushFlood final : public StandaloneComponent {
  void run() override {
    int pushes = 0;
    for (auto until = now() + time_.get(); is_running() && now() < until;)
      push(Note{++pushes, text_});
    info("made {} changes", pushes);
    push(Note{0, {}});
  }

  Option<std::chrono::milliseconds> time_{this, "time", 4s, "for how long"};
  std::string text_ = std::string(1000, '.');
};
CASTOR_COMPONENT(PushFlood, "pushes as fast as it can")

/// Ends the system when it has got the last push of a flood, of which it cannot have got all.
class PushDrain final : public UnmanagedComponent {
  void start() override {
    on_push<Note>("flood", [this](const std::shared_ptr<const Note>& x) {
      if (++heard_ == 1000)
        info("hears the flood");
      if (x->number == 0)
        end_system(0, fmt::format("heard {} changes, the last was {}", heard_, last_));
      else if (x->number <= last_)
        throw std::runtime_error("after " + std::to_string(last_) + " comes " +
                                 std::to_string(x->number));
      last_ = x->number;
    });
  }

  int heard_ = 0;
  int last_ = 0;
};
CASTOR_COMPONENT(PushDrain, "gets what is left of a flood")

/// Done when it has pulled from the beacon and has got ticks from it, one after another.
class Watcher final : public UnmanagedComponent {
  void start() override {
    if (pull<Tick>("beacon")->number != 1000)
      throw std::runtime_error("that is no pulled tick");
    on_push<Tick>("beacon", [this](const std::shared_ptr<const Tick>& x) {
      if (heard_++ > 0 && x->number != last_ + 1)
        throw std::runtime_error("after " + std::to_string(last_) + " comes " +
                                 std::to_string(x->number));
      last_ = x->number;
      if (heard_ == 20)
        add(Done{component_name()});
    });
  }

  int heard_ = 0;
  int last_ = 0;
};
CASTOR_COMPONENT(Watcher, "receives from a beacon")

/// Leaves behind as which user it ran.
class Trespasser final : public UnmanagedComponent {
  void start() override {
    const std::string& file = file_;
    std::ofstream{file} << geteuid() << '\n';
    end_system(0, "was here");
  }

  Option<std::string> file_{this, "file", "", "where to say as which user it ran"};
};
CASTOR_COMPONENT(Trespasser, "tries to run where it should not")

} // namespace

} // namespace castor::test
