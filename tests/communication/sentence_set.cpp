#include "castor/tests/communication/sentence_set.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace castor::communication::test {

namespace {

using nlohmann::json;
using ExpectedKind = ExpectedReply::Kind;

/// From this size on things are called large; metres.
constexpr double large_side = 0.055;

/// Things at this distance are near each other; metres.
constexpr double near_distance = 0.105;

/// A thing is left of another from this distance on, if it is not much farther in front of it.
constexpr double clear_offset = 0.08;
constexpr double diagonal_share = 0.5;

ExpectedKind kind_of_reply(const std::string& name) {
  static const std::map<std::string, ExpectedKind> kinds{
    {"yes", ExpectedKind::yes},
    {"no", ExpectedKind::no},
    {"count", ExpectedKind::count},
    {"colour", ExpectedKind::colour},
    {"shape", ExpectedKind::shape},
    {"size", ExpectedKind::size},
    {"objects", ExpectedKind::objects},
    {"place", ExpectedKind::place},
    {"description", ExpectedKind::description},
    {"accepted", ExpectedKind::accepted},
    {"contradicted", ExpectedKind::contradicted},
    {"small talk", ExpectedKind::small_talk},
    {"presupposition failure", ExpectedKind::presupposition_failure},
    {"unknown", ExpectedKind::unknown}};
  const auto found = kinds.find(name);
  if (found == kinds.end())
    throw std::runtime_error("there is no kind of reply '" + name + "'");
  return found->second;
}

ExpectedReply expected_reply(const json& x) {
  ExpectedReply result;
  result.kind = kind_of_reply(x.at("answer"));
  result.number = x.value("n", std::size_t{0});
  result.values = x.value("values", std::vector<std::string>{});
  result.things = x.value("ids", std::vector<std::string>{});
  result.places = x.value("relations", std::vector<std::pair<std::string, std::string>>{});
  return result;
}

/// Vision's words for shapes.
std::string seen_shape(const std::string& shape) {
  return shape == "disc" ? "circle" : shape == "ball" ? "sphere" : shape;
}

bool is_clear(double along, double across) {
  return std::abs(along) >= clear_offset && std::abs(along) >= diagonal_share * std::abs(across);
}

} // namespace

bool ThingInSet::is_large() const {
  return side > large_side;
}

SentenceSet read_sentence_set(const std::string& file) {
  std::ifstream in{file};
  const auto read = json::parse(in);
  SentenceSet result;
  for (auto& [name, things] : read.at("scenes").items())
    for (auto& x : things)
      result.scenes[name].push_back({x.at("id"), seen_shape(x.at("shape")), x.at("colour"),
                                     x.at("x"), x.at("y"), x.at("size")});
  for (auto& x : read.at("dialogues")) {
    Dialogue dialogue{x.at("scene"), x.at("kind"), {}};
    for (auto& turn : x.at("turns"))
      dialogue.turns.push_back({turn.at("say"), expected_reply(turn.at("expect"))});
    result.dialogues.push_back(std::move(dialogue));
  }
  return result;
}

void lay_out(const std::vector<ThingInSet>& things, TableScene& table) {
  using binding::feature;
  using binding::FeatureKind;
  for (auto& x : things)
    table.put(x.id,
              {feature(FeatureKind::colour, x.colour), feature(FeatureKind::shape, x.shape),
               feature(FeatureKind::size, x.is_large() ? "large" : "small"),
               binding::extent_of(x.side, x.side, x.height > 0 ? x.height : x.side)},
              x.x, x.y);
  for (auto& a : things)
    for (auto& b : things) {
      if (a.id == b.id)
        continue;
      const double right = a.x - b.x;
      const double back = a.y - b.y;
      if (std::hypot(right, back) <= near_distance)
        table.relate("near", a.id, b.id);
      if (is_clear(right, back))
        table.relate(right < 0 ? "left" : "right", a.id, b.id);
      if (is_clear(back, right))
        table.relate(back < 0 ? "front" : "back", a.id, b.id);
    }
}

} // namespace castor::communication::test
