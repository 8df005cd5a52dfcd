#include "castor/tests/communication/picture_scene.hpp"

#include "castor/binding/comparators.hpp"
#include "castor/binding/references.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace castor::communication::test {

namespace {

using binding::feature;
using binding::FeatureKind;

/// Between two boxes, metres.
constexpr double distance_of_boxes = 0.02;

/// The box at the origin.
constexpr double middle_box = 2;

/// Items up to and from these sizes are called small and large; metres.
constexpr double small_size = 0.015;
constexpr double large_size = 0.025;

/// Items up to this gap are near each other; metres.
constexpr double near = 0.008;

/// Blocks up to this gap lie on each other; metres.
constexpr double contact = 0.002;

std::string size_word(double size) {
  if (size <= small_size)
    return "small";
  return size >= large_size ? "large" : "medium";
}

} // namespace

void PictureScene::add(const std::string& id, std::vector<binding::Feature> features, double x,
                       double z, double width, double height) {
  features.push_back(binding::extent_of(width, width, height));
  unions_[id].features = std::move(features);
  unions_[id].proxy_ids = {"proxy of " + id};
  const auto place = "at " + id;
  unions_[place].features = {binding::location_at(x + width / 2, 0, z + height / 2, "picture")};
  unions_[place].proxy_ids = {"proxy of " + place};
  relations_.push_back({binding::position_label, place, id});
}

void PictureScene::add_box(const std::vector<PicturedItem>& items, double side, bool is_stacked) {
  const auto number = std::to_string(++boxes_);
  const double left =
    (static_cast<double>(boxes_) - middle_box) * (side + distance_of_boxes) - side / 2;
  const auto box = "box " + number;
  add(box,
      {feature(FeatureKind::concept_name, "box"), feature(FeatureKind::colour, "grey"),
       feature(FeatureKind::shape, "square"), feature(FeatureKind::size, "large")},
      left, 0, side, side);
  std::vector<std::string> ids;
  double height = 0;
  for (auto& item : items) {
    const auto id = "item " + number + '.' + std::to_string(ids.size() + 1);
    add(id,
        {feature(FeatureKind::concept_name, is_stacked ? "block" : "item"),
         feature(FeatureKind::colour, item.colour), feature(FeatureKind::shape, item.shape),
         feature(FeatureKind::size, size_word(item.size))},
        left + item.x, item.z, item.size, item.size);
    relations_.push_back({binding::containment_label, id, box});
    height = std::max(height, item.z + item.size);
    ids.push_back(id);
  }
  if (is_stacked && !items.empty()) {
    const auto tower = "tower " + number;
    add(tower, {feature(FeatureKind::concept_name, "tower")}, left + items.front().x, 0,
        items.front().size, height);
    relations_.push_back({binding::containment_label, tower, box});
    for (auto& id : ids)
      relations_.push_back({binding::containment_label, id, tower});
  }
  relate_items(ids, items, is_stacked);
}

void PictureScene::relate_items(const std::vector<std::string>& ids,
                                const std::vector<PicturedItem>& items, bool is_stacked) {
  for (std::size_t i = 0; i < items.size(); ++i)
    for (std::size_t k = 0; k < items.size(); ++k) {
      if (i == k)
        continue;
      auto& a = items[i];
      auto& b = items[k];
      const double dx = (a.x + a.size / 2) - (b.x + b.size / 2);
      const double dz = (a.z + a.size / 2) - (b.z + b.size / 2);
      const bool is_on = is_stacked && std::abs(a.z - b.z - b.size) <= contact;
      if (is_on)
        relations_.push_back({"on", ids[i], ids[k]});
      if (is_stacked ? is_on : dz > 0 && dz >= std::abs(dx)) {
        relations_.push_back({"above", ids[i], ids[k]});
        relations_.push_back({"under", ids[k], ids[i]});
      }
      if (std::abs(dx) - (a.size + b.size) / 2 <= near &&
          std::abs(dz) - (a.size + b.size) / 2 <= near)
        relations_.push_back({"near", ids[i], ids[k]});
      if (!is_stacked && std::abs(dx) >= std::abs(dz))
        relations_.push_back({dx < 0 ? "left" : "right", ids[i], ids[k]});
    }
}

binding::ReferenceReply PictureScene::reply(const binding::ReferenceRequest& request) const {
  static const binding::FeatureComparator comparator;
  binding::ReferenceReply result;
  for (auto& x : request.descriptions)
    result.referents.push_back(
      {binding::distinct_referents(binding::find_referents(x, unions_, comparator))});
  for (auto& [id, x] : unions_)
    result.unions.push_back({id, x.proxy_ids.front(), x.features});
  result.relations = relations_;
  result.competences = {{"vision", "thing"}};
  return result;
}

} // namespace castor::communication::test
