// Statements of many kinds about what is in boxes and towers, judged by another program.
#include "castor/tests/communication/picture_scene.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace castor::communication::test {

namespace {

constexpr double box_width = 0.1;
constexpr double unit = 0.001;
constexpr double block_width = 0.02;
constexpr double left_of_block = 0.04;

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> result;
  std::istringstream in{text};
  for (std::string part; std::getline(in, part, separator);)
    result.push_back(part);
  return result;
}

/// "black blue": a tower from its base on.
std::vector<PicturedItem> blocks_of(const std::string& text) {
  std::vector<PicturedItem> result;
  std::istringstream in{text};
  for (std::string colour; in >> colour;)
    result.push_back({"square", colour, left_of_block,
                      static_cast<double>(result.size()) * block_width, block_width});
  return result;
}

/// "black circle 0 40 20, blue square 70 70 30".
std::vector<PicturedItem> items_of(const std::string& text) {
  std::vector<PicturedItem> result;
  for (auto& part : parts_of(text, ',')) {
    std::istringstream in{part};
    PicturedItem x;
    if (!(in >> x.colour >> x.shape >> x.x >> x.z >> x.size))
      continue;
    x.x *= unit;
    x.z *= unit;
    x.size *= unit;
    result.push_back(x);
  }
  return result;
}

PictureScene scene_of(const std::string& name, const std::string& text) {
  const bool is_stacked = name.starts_with("towers");
  PictureScene scene;
  for (auto& box : parts_of(text, '|'))
    scene.add_box(is_stacked ? blocks_of(box) : items_of(box), box_width, is_stacked);
  return scene;
}

} // namespace

TEST(PictureStatements, AreJudgedAsByAnotherProgram) {
  std::ifstream in{CASTOR_PICTURE_STATEMENTS};
  ASSERT_TRUE(in);
  std::map<std::string, PictureScene> scenes;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#')
      continue;
    std::istringstream words{line};
    std::string name;
    std::string label;
    words >> name >> label >> std::ws;
    std::string text;
    std::getline(words, text);
    if (label == "=") {
      scenes.emplace(name, scene_of(name, text));
      continue;
    }
    ASSERT_TRUE(scenes.contains(name)) << line;
    TableTalk talk{[&scene = scenes.at(name)](auto& asked) { return scene.reply(asked); }};
    const auto reply = talk.say(text);
    const auto expected =
      label == "true" ? RhetoricalRelation::acceptance : RhetoricalRelation::correction;
    EXPECT_TRUE(reply.is_parsed && reply.relation == expected)
      << line << "\n  is answered by: " << reply.text;
    ++number;
  }
  EXPECT_GT(number, 200U);
}

} // namespace castor::communication::test
