#pragma once

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/tests/support/eventually.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace castor::vision {

using namespace std::chrono_literals;

/// The vision subarchitecture as configs/vision.cast has it, on rendered tables.
class VisionSystem : public testing::Test {
protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() /
             ("castor-vision-" + std::to_string(getpid()) + "-" +
              testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder);
  }

  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string scene(const std::string& things) const {
    auto file = folder / "test.scene";
    std::ofstream{file} << "table cloth\ncamera 0 -0.62 0.55 looking-at 0 0 0 fov 42\n"
                           "light 1 -0.8 2\nnoise 2\nseed 5\n"
                        << things;
    return "scene:" + file.string();
  }

  static std::string vision_cast() {
    std::ifstream in{CASTOR_CONFIGS "/vision.cast"};
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }

  /// The text, with `line` instead of the line that begins with `start`.
  static std::string with(std::string text, const std::string& start, const std::string& line) {
    auto at = text.find("\n" + start);
    EXPECT_NE(at, text.npos) << start;
    return text.replace(at + 1, text.find('\n', at + 1) - at - 1, line);
  }

  /// Runs the system in `text`, in simulated time, until a change of the scene was processed, and
  /// then nothing happens any more.
  std::unique_ptr<System> watch(const std::string& text,
                                std::map<std::string, std::string> variables,
                                SystemOptions options = {},
                                std::chrono::milliseconds quiet = 800ms) const {
    cast::ParseOptions parse_options;
    parse_options.variables = std::move(variables);
    auto parsed = cast::parse_string(text, CASTOR_CONFIGS "/vision.cast", parse_options);
    EXPECT_TRUE(parsed.ok()) << render(parsed.diagnostics);
    options.clock.pace = Pace{};
    auto system = std::make_unique<System>(parsed.architecture.value(), options);
    EXPECT_TRUE(system->start());
    for (int i = 0; i < 600 && !has_processed_a_change(*system); ++i)
      EXPECT_EQ(system->wait({.at_most = 100ms}), EndReason::time_over);
    EXPECT_TRUE(has_processed_a_change(*system));
    EXPECT_EQ(system->wait({.at_most = 60s, .quiet = quiet}), EndReason::quiet);
    system->stop();
    for (auto& x : system->summary().components)
      EXPECT_EQ(x.failure, "") << x.identity.name;
    return system;
  }

  static bool has_processed_a_change(System& system) {
    auto changes = all<SceneChanged>(system);
    return std::any_of(changes.begin(), changes.end(), [](auto& x) { return x.processed; });
  }

  template <class T>
  static std::vector<T> all(System& system) {
    std::vector<T> result;
    for (auto& entry : system.entries("vision"))
      if (auto x = entry->value.as<T>())
        result.push_back(*x);
    return result;
  }

  std::filesystem::path folder;
};

} // namespace castor::vision
