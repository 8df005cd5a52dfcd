// A run of the PlayMate is recorded, and replayed at home where there is neither the camera nor
// vision.
#include "castor/tests/support/process.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;

struct Answer {
  int status = 0;
  std::string output;
  std::string errors;
};

Answer castor(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), CASTOR_EXECUTABLE);
  Process process{arguments};
  auto status = process.wait();
  return {status, process.output(), process.errors()};
}

/// Entries by subarchitecture, as `entries.json` has them.
using Entries = std::map<std::string, std::vector<json>>;

/// Those that the recorded run ended with.
Entries recorded_entries(const std::string& recording) {
  Entries result;
  for (auto* name : {"binding", "communication"}) {
    auto answer = castor(
      {"journal", "show", recording + '/' + name + ".castor-journal", "--entries", "--json"});
    EXPECT_EQ(answer.status, 0) << answer.errors;
    std::istringstream lines{answer.output};
    for (std::string line; std::getline(lines, line);)
      result[name].push_back(json::parse(line));
  }
  return result;
}

Entries replayed_entries(const std::string& folder) {
  Entries result;
  std::ifstream in{folder + "/entries.json"};
  auto all = json::parse(in);
  for (auto& [name, entries] : all.items())
    for (auto& x : entries)
      result[name].push_back(x);
  return result;
}

/// In the order in which they were said.
std::vector<std::string> sayings(const Entries& entries) {
  std::vector<std::string> result;
  for (auto& x : entries.at("communication"))
    if (x["type"] == "SpokenOutputItem")
      result.insert(result.begin(), x["value"]["text"]);
  return result;
}

/// What a union says, without what differs from run to run: ids and moments.
std::string content_of(const json& value) {
  static const std::set<std::string> of_this_run{"this_proxy_id", "existing_proxy_id",
                                                 "source_data",   "creation_time",
                                                 "salience",      "debug_string"};
  std::multiset<std::string> features;
  for (auto& x : value["features"]) {
    if (of_this_run.count(x["kind"]) > 0)
      continue;
    auto text = x["kind"].get<std::string>() + (x["negated"].get<bool>() ? "!=" : "=") +
                x["text"].get<std::string>();
    for (auto& number : x["numbers"])
      text += " " + std::to_string(std::lround(1000 * number.get<double>()));
    features.insert(text);
  }
  auto sources = value["sources"].get<std::multiset<std::string>>();
  return json{{"type", value["type"]}, {"sources", sources}, {"features", features}}.dump();
}

/// Everything that is bound: things, and which relations there are between which of them.
std::multiset<std::string> unions(const Entries& entries) {
  std::map<std::string, std::string> thing_of_proxy;
  for (auto& x : entries.at("binding"))
    if (x["type"] == "BindingUnion")
      for (auto& proxy : x["value"]["proxy_ids"])
        thing_of_proxy[proxy] = content_of(x["value"]);
  std::multiset<std::string> result;
  for (auto& x : entries.at("binding")) {
    if (x["type"] != "BindingUnion")
      continue;
    std::multiset<std::string> ends;
    for (auto& port : x["value"]["out_ports"])
      ends.insert(port["label"].get<std::string>() + ": " + thing_of_proxy[port["proxy"]]);
    auto text = content_of(x["value"]);
    for (auto& end : ends)
      text += "\n  " + end;
    result.insert(text);
  }
  return result;
}

class RecordedPlaymate : public testing::Test {
protected:
  void SetUp() override {
    setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
    auto answer =
      castor({"run", CASTOR_CONFIGS "/playmate.cast", "--record", recording, "--set",
              "say=What colour is the square? Where is the ball? How many red things are there? "
              "Is the red thing left of the ball?",
              "--speed", "max", "--until-quiet", "3s", "--for", "60s"});
    ASSERT_EQ(answer.status, 0) << answer.errors;
    EXPECT_THAT(answer.output, testing::ContainsRegex("answers to pulls of camera"));
    EXPECT_THAT(answer.output, testing::HasSubstr("castor journal replay " + recording));
  }

  void expect_the_same(const std::vector<std::string>& options) const {
    auto output = (folder / "output").string();
    std::vector<std::string> arguments{"journal", "replay", recording,  "--without",
                                       "vision",  "--json", "--output", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    auto answer = castor(arguments);
    ASSERT_EQ(answer.status, 0) << answer.errors;
    auto outcome = json::parse(answer.output);
    EXPECT_GT(outcome["writes"], 20);
    EXPECT_EQ(outcome["refused"], 0);
    EXPECT_GT(outcome["values"], 3);
    auto before = recorded_entries(recording);
    auto after = replayed_entries(output);
    EXPECT_EQ(sayings(before).size(), 4u);
    EXPECT_EQ(sayings(after), sayings(before));
    EXPECT_GT(unions(before).size(), 12u);
    EXPECT_EQ(unions(after), unions(before));
  }

  TemporaryFolder folder;
  const std::string recording = (folder / "recording").string();
};

TEST_F(RecordedPlaymate, BindsAndAnswersTheSameWithoutVision) {
  // Without the scene, too.
  auto text = [&] {
    std::ifstream in{recording + "/system.cast"};
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }();
  auto scene = text.find("scenes/playmate.scene");
  ASSERT_NE(scene, text.npos);
  text.replace(scene, 6, "gone//");
  std::ofstream{recording + "/system.cast"} << text;
  expect_the_same({});
}

TEST_F(RecordedPlaymate, BindsAndAnswersTheSameAsFastAsItCan) {
  expect_the_same({"--speed", "max", "--until-quiet", "4s"});
}

TEST_F(RecordedPlaymate, ShowsPicturesAndThingsInFoxglove) {
  auto file = (folder / "recording.mcap").string();
  auto answer = castor({"journal", "export", recording, "--mcap", file});
  ASSERT_EQ(answer.status, 0) << answer.errors;
  EXPECT_EQ(answer.errors, "");
  Process probe{{"node", "-e", "require('@mcap/core')"}};
  if (probe.wait() != 0)
    GTEST_SKIP() << "node does not find @mcap/core (npm install @mcap/core; NODE_PATH)";
  Process reader{{"node", CASTOR_READ_MCAP, file}};
  EXPECT_EQ(reader.wait(), 0) << reader.errors();
  for (auto* topic :
       {"foxglove.CompressedImage on /camera/CameraFrame/image",
        "foxglove.FrameTransform on /camera/CameraFrame/camera/transform",
        "foxglove.CameraCalibration on /camera/CameraFrame/camera/calibration",
        "foxglove.CompressedImage on /vision/ROI/region",
        "foxglove.CompressedImage on /vision/ScenePicture/image",
        "foxglove.PosesInFrame on /vision/SceneObject/poses",
        "foxglove.SceneUpdate on /vision/SceneObject/scene",
        "foxglove.SceneUpdate on /spatial/SpatialLocation/scene",
        "CameraFrame on /camera/CameraFrame\n", "SceneObject on /vision/SceneObject\n"})
    EXPECT_THAT(reader.output(), testing::HasSubstr(topic));
}

} // namespace

} // namespace castor::test
