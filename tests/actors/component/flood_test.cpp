#include "castor/tests/actors/component/bytes_in_use.hpp"
#include "castor/tests/actors/component/scripted.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

/// Four writers in three subarchitectures, two of them in one; ten thousand adds and ten thousand
/// overwrites of each in every round, and a deletion for each add so that nothing piles up.
class Floods : public testing::Test {
protected:
  static constexpr int adds_per_round = 10'000;
  static constexpr int events_per_round = 3 * adds_per_round;

  /// What one listener has seen. Written on its thread only, but for the counts.
  struct Seen {
    std::map<std::string, std::uint64_t> last_sequence;
    std::map<std::string, std::atomic<int>> count;
    std::atomic<int> errors{0};
  };

  void SetUp() override {
    for (auto name : {"w1", "w2", "w3", "w4"})
      UnmanagedScript::scripts()[name].run = [this](auto& self) {
        for (int round = 1; self.is_running(); ++round) {
          while (rounds < round && self.is_running())
            self.sleep_for(1ms);
          for (int i = 0; i < adds_per_round; ++i) {
            // Addresses come again, so that the memory of deleted ones has its size soon.
            auto address = self.here(self.component_name() + std::to_string(i % 100));
            self.add(address, Note{0, self.component_name()});
            self.template read<Note>(address);
            self.overwrite(address, Note{1, self.component_name()});
            self.delete_entry(address);
          }
        }
      };
    listen("all1", {any_change().anywhere(), changed<Note>().anywhere()}, {"w1", "w2", "w3", "w4"});
    listen("all2", {any_change().anywhere()}, {"w1", "w2", "w3", "w4"});
    listen("only-b", {any_change().in("b")}, {"w3"});
  }

  void TearDown() override { clear_scripts(); }

  void listen(const std::string& name, std::vector<ChangeFilter> filters,
              const std::vector<std::string>& sources) {
    auto& s = seen[name];
    for (auto& source : sources)
      s.count[source] = 0;
    UnmanagedScript::scripts()[name].start = [&s, filters](auto& self) {
      for (std::size_t i = 0; i < filters.size(); ++i)
        self.on_change(filters[i], [&s, is_first = i == 0](const ChangeEvent& e) {
          auto& last = s.last_sequence[e.address.subarchitecture];
          if (!is_first) {
            // Several filters want the same event: it comes once and calls both receivers.
            s.errors += e.sequence != last;
            return;
          }
          s.errors += e.sequence != last + 1;
          last = e.sequence;
          auto i_count = s.count.find(e.source);
          if (i_count == s.count.end())
            ++s.errors;
          else
            ++i_count->second;
        });
    };
  }

  System system{architecture(
    subarchitecture("a") + "CPP UM w1 Unmanaged\nCPP UM w2 Unmanaged\nCPP UM all1 Unmanaged\n" +
    subarchitecture("b") + "CPP UM w3 Unmanaged\nCPP UM all2 Unmanaged\n" + subarchitecture("c") +
    "CPP UM w4 Unmanaged\nCPP UM only-b Unmanaged\n")};

  /// Lets the writers do one more round; true once everybody has seen all of it.
  bool do_round() {
    auto expected = ++rounds * events_per_round;
    return eventually([&] {
      for (auto& [name, s] : seen)
        for (auto& [source, count] : s.count)
          if (count < expected)
            return false;
      return true;
    });
  }

  std::map<std::string, Seen> seen;
  std::atomic<int> rounds{0};
};

TEST_F(Floods, ReachEverybodyOnceAndInOrder) {
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(do_round());
  system.stop();
  for (auto& [name, s] : seen) {
    EXPECT_EQ(s.errors, 0) << name;
    for (auto& [source, count] : s.count)
      EXPECT_EQ(count, events_per_round) << name << " of " << source;
  }
}

TEST_F(Floods, LeaveNoMemoryBehind) {
  ASSERT_TRUE(system.start());
  // Tables and queues take their size.
  for (int i = 0; i < 3; ++i)
    ASSERT_TRUE(do_round());
  auto before = bytes_in_use();
  for (int i = 0; i < 4; ++i)
    ASSERT_TRUE(do_round());
  auto after = bytes_in_use();
  system.stop();
  // 480,000 events were made and more than a million delivered in between: less than a byte of each
  // is left. Queues are as long as the machine is busy.
  EXPECT_LT(after, before + 480'000);
}

} // namespace

} // namespace castor::test
