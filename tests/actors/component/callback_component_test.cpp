#include "castor/actors/component/callback_component.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/tests/actors/component/scripted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Opens up what component authors use, and runs the scripts that stand under its name.
class Rule : public CallbackComponent {
public:
  using Script = std::function<void(Rule&)>;
  static std::map<std::string, Script> on_start;
  static std::map<std::string, Script> on_stop;

  using CallbackComponent::add;
  using CallbackComponent::component_name;
  using CallbackComponent::delete_entry;
  using CallbackComponent::end_system;
  using CallbackComponent::every;
  using CallbackComponent::exists;
  using CallbackComponent::here;
  using CallbackComponent::now;
  using CallbackComponent::on_change;
  using CallbackComponent::overwrite;
  using CallbackComponent::read;
  using CallbackComponent::read_all;
  using CallbackComponent::read_where;
  using CallbackComponent::sleep_for;
  using CallbackComponent::version;
  using CallbackComponent::write;

  /// Takes back that waiting is deleted.
  void lock_anyway(const Address& x) { SubarchitectureComponent::lock_entry(x, LockLevel::odr); }
  void wait_anyway() { SubarchitectureComponent::wait_for_changes(); }

private:
  void start() override { call(on_start); }
  void stop() override { call(on_stop); }

  void call(const std::map<std::string, Script>& scripts) {
    if (auto i = scripts.find(component_name()); i != scripts.end())
      i->second(*this);
  }
};
CASTOR_COMPONENT(Rule, "does what a test says")

std::map<std::string, Rule::Script> Rule::on_start;
std::map<std::string, Rule::Script> Rule::on_stop;

template <class T>
concept Sleeps = requires(T& x) {
  x.sleep_for(1s);
};
static_assert(Sleeps<UnmanagedScript>);
static_assert(!Sleeps<Rule>);

class CallbackComponents : public testing::Test {
protected:
  void TearDown() override {
    clear_scripts();
    Rule::on_start.clear();
    Rule::on_stop.clear();
  }

  static UnmanagedScript::Script& script(const std::string& name) {
    return UnmanagedScript::scripts()[name];
  }

  /// With rules of these names, and `writer`, which has a thread.
  static ArchitectureDescription with(const std::vector<std::string>& rules) {
    auto text = subarchitecture("a");
    for (auto& x : rules)
      text += "CPP UM " + x + " Rule\n";
    return architecture(text + "CPP UM writer Unmanaged\n");
  }

  static std::vector<std::string> names(std::size_t count) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < count; ++i)
      result.push_back("rule" + std::to_string(i));
    return result;
  }

  static ComponentStatus status_of(System& system, const std::string& name) {
    for (auto& x : system.summary().components)
      if (x.identity.name == name)
        return x;
    throw std::logic_error("there is no component " + name);
  }

  void note(const std::string& x) {
    std::lock_guard guard{mutex_};
    lines_.push_back(x);
  }
  std::vector<std::string> lines() const {
    std::lock_guard guard{mutex_};
    return lines_;
  }

private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

TEST_F(CallbackComponents, ReadAndWriteWithoutWaiting) {
  Rule::on_start["rule"] = [&](Rule& self) {
    self.on_change(added<Note>(), [&](const ChangeEvent& event) {
      self.read<Note>(event.address).then([&](const EntryOf<Note>& x) {
        note("read " + x->text);
        self.add(Other{2.0 * static_cast<double>(x->number)}).then([&](const Address& address) {
          self.overwrite(address, Other{7}).then([&, address](Version version) {
            note("version " + std::to_string(version));
            self.delete_entry(address).then([&, address](Version) {
              self.exists(address).then([&](bool is_there) {
                note(is_there ? "there" : "gone");
                self.end_system(0, "done");
              });
            });
          });
        });
      });
    });
  };
  script("writer").run = [](auto& self) { self.add(Note{4, "four"}); };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_THAT(lines(), ElementsAre("read four", "version 1", "gone"));
}

TEST_F(CallbackComponents, QueriesAndBatches) {
  Rule::on_start["rule"] = [&](Rule& self) {
    WriteBatch batch;
    batch.add(self.here("x"), Note{1, "one"});
    batch.add(self.here("y"), Note{2, "two"});
    self.write(batch).then([&](const std::vector<Version>& versions) {
      note(std::to_string(versions.size()) + " versions");
      self.read_all<Note>().then([&](const std::vector<EntryOf<Note>>& all) {
        note(std::to_string(all.size()) + " entries");
        self.read_where<Note>(field(&Note::number) > 1)
          .then([&](const std::vector<EntryOf<Note>>& some) {
            note(some.at(0)->text);
            self.end_system(0, "done");
          });
      });
    });
    self.write(WriteBatch{}).then([&](const std::vector<Version>& x) {
      note(std::to_string(x.size()) + " versions");
    });
  };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0);
  // What needs no working memory is done first.
  EXPECT_THAT(lines(), ElementsAre("0 versions", "2 versions", "2 entries", "two"));
}

TEST_F(CallbackComponents, ACallbackAndWhatFollowsFromItAreOneStep) {
  constexpr int all = 300;
  Rule::on_start["rule"] = [&](Rule& self) {
    self.add(self.here("sum"), Other{0});
    self.on_change(added<Note>(), [&](const ChangeEvent&) {
      self.read<Other>(self.here("sum")).then([&](const EntryOf<Other>& sum) {
        auto x = sum->x + 1;
        self.overwrite(sum.address, Other{x}).then([&, x](Version) {
          if (x == all)
            self.end_system(0, "done");
        });
      });
    });
  };
  script("writer").run = [](auto& self) {
    for (int i = 0; i < all; ++i)
      self.add(Note{i, ""});
  };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0) << "an increment was lost";
}

TEST_F(CallbackComponents, NoTwoCallbacksOfOneComponentRunAtTheSameTime) {
  std::atomic<int> inside{0};
  std::atomic<int> overlaps{0};
  std::atomic<int> calls{0};
  auto call = [&] {
    overlaps += ++inside != 1;
    std::this_thread::yield();
    --inside;
    ++calls;
  };
  Rule::on_start["rule"] = [&](Rule& self) {
    self.every(1ms, call);
    self.on_change(added<Note>(), [&](const ChangeEvent& event) {
      call();
      self.read<Note>(event.address).then([&](const EntryOf<Note>&) { call(); });
    });
  };
  script("writer").run = [&](auto& self) {
    for (int i = 0; i < 1000; ++i)
      self.add(Note{i, ""});
    EXPECT_TRUE(eventually([&] { return calls > 2000; }));
    self.end_system(0, "done");
  };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(overlaps, 0);
}

TEST_F(CallbackComponents, StartedMeansThatTheResultsOfStartWereCalledBack) {
  std::atomic<bool> is_done{false};
  Rule::on_start["rule"] = [&](Rule& self) {
    self.add(self.here("x"), Note{1, ""}).then([&](Version) {
      self.add(self.here("y"), Note{2, ""}).then([&](Version) { is_done = true; });
    });
  };
  script("writer").run = [&](auto& self) {
    EXPECT_TRUE(is_done);
    self.end_system(0, "done");
  };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallbackComponents, StoppedMeansThatTheResultsOfStopWereCalledBack) {
  std::atomic<bool> is_done{false};
  Rule::on_stop["rule"] = [&](Rule& self) {
    self.add(self.here("x"), Note{1, ""}).then([&](Version) {
      self.exists(self.here("x")).then([&](bool x) { is_done = x; });
    });
  };
  script("writer").run = [](auto& self) { self.end_system(0, "done"); };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_TRUE(is_done);
  EXPECT_EQ(status_of(system, "rule").state, ComponentState::stopped);
}

TEST_F(CallbackComponents, AFailureIsHandedOver) {
  Rule::on_start["rule"] = [&](Rule& self) {
    self.read<Note>(self.here("nowhere"))
      .then([&](const EntryOf<Note>&) { note("read"); },
            [&](const WorkingMemoryException& e) {
              note(e.kind() == FailureKind::does_not_exist ? "not there" : e.what());
              self.end_system(0, "done");
            });
  };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_THAT(lines(), ElementsAre("not there"));
}

TEST_F(CallbackComponents, AFailureThatNobodyTakesIsTheComponents) {
  Rule::on_start["rule"] = [&](Rule& self) {
    self.on_change(added<Note>(),
                   [&](const ChangeEvent& event) { self.add(event.address, Note{}); });
  };
  script("writer").run = [](auto& self) { self.add(Note{1, ""}); };
  System system{with({"rule"}), without_restarts()};
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(eventually([&] { return !status_of(system, "rule").failure.empty(); }));
  EXPECT_THAT(status_of(system, "rule").failure, HasSubstr("the result of add a/"));
  system.stop();
}

TEST_F(CallbackComponents, WaitingIsRefused) {
  Rule::on_start["rule"] = [&](Rule& self) {
    auto refuse = [&](const char* what, const std::function<void()>& f) {
      try {
        f();
        ADD_FAILURE() << what << " is not refused";
      } catch (const std::logic_error& e) {
        EXPECT_THAT(e.what(), HasSubstr("a.rule must not wait")) << what;
      }
    };
    refuse("a lock", [&] { self.lock_anyway(self.here("x")); });
    refuse("a wait", [&] { self.wait_anyway(); });
    refuse("get()", [&] { self.exists(self.here("x")).get(); });
    self.end_system(0, "done");
  };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(CallbackComponents, OneThatFailsIsBackWithItsFilters) {
  std::atomic<int> lives{0};
  Rule::on_start["rule"] = [&](Rule& self) {
    ++lives;
    self.on_change(added<Note>(), [&](const ChangeEvent&) {
      note("life " + std::to_string(lives));
      if (lives == 1)
        throw std::runtime_error("one is too much");
      self.end_system(0, "done");
    });
  };
  script("writer").run = [&](auto& self) {
    self.add(Note{1, ""});
    EXPECT_TRUE(eventually([&] { return lives == 2; }));
    self.sleep_for(10ms);
    self.add(Note{2, ""});
  };
  System system{with({"rule"})};
  EXPECT_EQ(run(system), 0);
  EXPECT_THAT(lines(), ElementsAre("life 1", "life 2"));
  EXPECT_EQ(status_of(system, "rule").restarts, 1U);
}

TEST_F(CallbackComponents, ThoseThatComputeForEverHoldUpNobodyElse) {
  // More than there are threads.
  const auto hanging = std::thread::hardware_concurrency() + 3;
  std::atomic<bool> may_return{false};
  std::atomic<unsigned> hang{0};
  std::atomic<int> calls{0};
  auto rules = names(hanging);
  for (auto& x : rules)
    Rule::on_start[x] = [&](Rule& self) {
      self.on_change(added<Note>(), [&](const ChangeEvent&) {
        ++hang;
        EXPECT_TRUE(eventually([&] { return may_return.load(); }));
      });
    };
  Rule::on_start["quick"] = [&](Rule& self) { self.every(1ms, [&] { ++calls; }); };
  script("writer").run = [&](auto& self) {
    self.add(Note{1, ""});
    EXPECT_TRUE(eventually([&] { return hang == hanging; }));
    auto before = calls.load();
    EXPECT_TRUE(eventually([&] { return calls > before + 10; }));
    may_return = true;
    self.end_system(0, "done");
  };
  rules.push_back("quick");
  System system{with(rules)};
  EXPECT_EQ(run(system), 0);
}

int threads_of_this_process() {
  std::ifstream file{"/proc/self/status"};
  std::string word;
  int result = 0;
  while (file >> word)
    if (word == "Threads:")
      file >> result;
  return result;
}

TEST_F(CallbackComponents, AThousandShareAFewThreads) {
  constexpr std::size_t all = 1000;
  std::atomic<std::size_t> calls{0};
  auto rules = names(all);
  for (auto& x : rules)
    Rule::on_start[x] = [&](Rule& self) {
      self.on_change(overwritten<Note>(), [&](const ChangeEvent&) { ++calls; });
    };
  script("writer").run = [&](auto& self) {
    auto address = self.add(Note{1, ""});
    for (int i = 0; i < 10; ++i)
      self.overwrite(address, Note{i, ""});
    EXPECT_TRUE(eventually([&] { return calls == 10 * all; }));
    EXPECT_LT(threads_of_this_process(), 100);
    self.end_system(0, "done");
  };
  System system{with(rules)};
  EXPECT_EQ(run(system), 0);
  auto status = status_of(system, "rule7");
  EXPECT_EQ(status.callbacks, 10U);
  EXPECT_EQ(status.events_received, 10U);
  EXPECT_GT(status.cpu.count(), 0);
}

/// With actors that run at the same time, and one at a time.
class CallbackComponentsInSimulatedTime : public CallbackComponents,
                                          public testing::WithParamInterface<bool> {
protected:
  SystemOptions options() const {
    SystemOptions result;
    result.clock.pace = Pace{};
    result.clock.reproducible = GetParam();
    return result;
  }

  void run_for(const std::vector<std::string>& rules, std::chrono::nanoseconds at_most) {
    System system{with(rules), options()};
    ASSERT_TRUE(system.start());
    EXPECT_EQ(system.wait({at_most, std::nullopt}), EndReason::time_over);
    system.stop();
  }
};

INSTANTIATE_TEST_SUITE_P(Orders, CallbackComponentsInSimulatedTime, testing::Bool(),
                         [](auto& x) { return x.param ? "one_at_a_time" : "parallel"; });

TEST_P(CallbackComponentsInSimulatedTime, TimersAreExact) {
  std::atomic<int> calls{0};
  for (auto& x : names(5))
    Rule::on_start[x] = [&](Rule& self) {
      self.every(10s, [&] {
        EXPECT_EQ(self.now() % Timestamp{10s}, Timestamp{0});
        ++calls;
      });
    };
  run_for(names(5), 1h - 1s);
  EXPECT_EQ(calls, 5 * 359);
}

TEST_P(CallbackComponentsInSimulatedTime, EventsAndResultsTakeNone) {
  for (auto& x : names(5))
    Rule::on_start[x] = [&](Rule& self) {
      self.on_change(added<Note>(), [&](const ChangeEvent& event) {
        self.read<Note>(event.address).then([&](const EntryOf<Note>&) {
          EXPECT_EQ(self.now(), Timestamp{1s});
          self.add(Other{1}).then([&](const Address&) { note(self.component_name()); });
        });
      });
    };
  script("writer").run = [](auto& self) {
    self.sleep_for(1s);
    self.add(Note{1, ""});
  };
  run_for(names(5), 2s);
  auto result = lines();
  std::sort(result.begin(), result.end());
  EXPECT_EQ(result, names(5));
}

TEST_F(CallbackComponents, OneAtATimeTheyRunInTheSameOrderAgain) {
  std::vector<std::vector<std::string>> runs;
  for (int i = 0; i < 2; ++i) {
    auto before = lines().size();
    for (auto& x : names(20))
      Rule::on_start[x] = [&](Rule& self) {
        self.every(std::chrono::milliseconds{5 + self.component_name().size()}, [&] {
          self.add(Note{1, ""});
        });
        self.on_change(added<Note>(), [&](const ChangeEvent& event) {
          note(self.component_name() + " " + event.source + " " + event.address.id);
        });
      };
    SystemOptions options;
    options.clock.pace = Pace{};
    options.clock.reproducible = true;
    System system{with(names(20)), options};
    ASSERT_TRUE(system.start());
    system.wait({50ms, std::nullopt});
    system.stop();
    auto all = lines();
    runs.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
  }
  EXPECT_GT(runs[0].size(), 1000U);
  EXPECT_EQ(runs[0], runs[1]);
}

} // namespace

} // namespace castor::test
