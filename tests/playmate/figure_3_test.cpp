#include "castor/tests/playmate/figure_3.hpp"

#include "castor/actors/system/system.hpp"
#include "castor/tests/playmate/playmate.hpp"
#include "castor/tests/support/eventually.hpp"
#include "castor/tests/tools/cli/castor_fixture.hpp"
#include "castor/tools/testing/test_system.hpp"
#include "castor/wm/values/json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using nlohmann::json;

using Lines = std::set<std::string>;

constexpr auto subarchitectures = {"vision", "spatial", "communication", "binding"};

/// An empty table, and soon after somebody puts a blue square on it.
const std::string figure_3_scene = "table wood\n"
                                   "camera 0 -0.62 0.55  looking-at 0 0.03 0  fov 42\n"
                                   "light -1 -1 2\n"
                                   "noise 2\n"
                                   "seed 1\n"
                                   "after 500ms  add blue square at 0.05 0.0 size 0.09 turned 15\n";

/// What the two sets do not have in common.
std::string difference(const Lines& wanted, const Lines& got) {
  std::string result;
  for (auto& x : wanted)
    if (!got.contains(x))
      result += "\n  missing: " + x;
  for (auto& x : got)
    if (!wanted.contains(x))
      result += "\n  besides: " + x;
  return result;
}

class Figure3 : public Castor {
protected:
  std::map<std::string, std::string> variables() const {
    return {{"source", "scene:" + write("figure-3.scene", figure_3_scene)},
            {"recogniser", "no"},
            {"say", "This is a blue square."}};
  }

  static Lines lines(TestSystem& system) {
    Lines result;
    for (auto* name : subarchitectures)
      for (auto& entry : system.system().entries(name))
        add(result, name, entry->type_name(), json::parse(to_json(entry->value)));
    return result;
  }

  /// Of a system in other processes.
  static Lines lines_from_outside() {
    Lines result;
    for (std::string name : subarchitectures) {
      auto list = ask({"wm", "ls", name, "--json"});
      if (list.status != 0)
        continue;
      for (auto& x : json_lines(list.output)) {
        auto entry = ask({"wm", "get", name + '/' + x["id"].get<std::string>(), "--json"});
        if (entry.status == 0)
          add(result, name, x["type"], json::parse(entry.output)["value"]);
      }
    }
    return result;
  }

  static void expect_all(TestSystem& system) {
    Lines got;
    auto is_complete = [&] {
      got = lines(system);
      return got == figure_3_entries();
    };
    EXPECT_NO_THROW(system.wait_until("the entries of figure 3 are there", is_complete, 30s))
      << difference(figure_3_entries(), got);
  }

  static void add(Lines& to, const std::string& subarchitecture, const std::string& type,
                  const json& content) {
    // Scenes of the past are remembered for a while; the first is the latest.
    if (type == "SpatialScene" &&
        std::ranges::any_of(to, [](auto& x) { return x.starts_with("spatial SpatialScene"); }))
      return;
    if (auto line = figure_3_line(subarchitecture, type, content); !line.empty())
      to.insert(std::move(line));
  }
};

TEST_F(Figure3, HasTheEntriesOfThePaper) {
  TestSystem system{playmate_cast(), playmate_options(variables())};
  expect_all(system);
  // One overwrite for each word, one at the end, and one when the readings were pruned.
  auto form = system.expect_entry("PackedLogicalForm in communication");
  EXPECT_EQ(form->version, 6u);
  system.expect_nobody_else_down();
}

TEST_F(Figure3, HasThemOverThreeNodes) {
  std::vector<std::string> arguments{
    "run", CASTOR_CONFIGS "/playmate.cast", "--spread", "3", "--for", "60s"};
  for (auto& [name, value] : variables())
    arguments.insert(arguments.end(), {"--set", name + '=' + value});
  Process castor{command(arguments)};
  Lines got;
  EXPECT_TRUE(eventually([&] {
    got = lines_from_outside();
    return got == figure_3_entries();
  }))
    << difference(figure_3_entries(), got) << castor.errors();
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
}

/// Everybody fails once, in any order, at any time between the beginning and the answer.
TEST_F(Figure3, HasThemWhenEachComponentHasFailedOnTheWay) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random{seed};
  auto with_restarts = variables();
  with_restarts["restarts"] = "100";
  TestSystem system{playmate_cast(), playmate_options(with_restarts)};
  auto names = playmate_components(system);
  std::shuffle(names.begin(), names.end(), random);
  for (auto& name : names) {
    std::this_thread::sleep_for(
      std::chrono::milliseconds{std::uniform_int_distribution{0, 140}(random)});
    system.inject("crash " + name);
    system.expect_back(name);
  }
  expect_all(system);
}

} // namespace

} // namespace castor::test
