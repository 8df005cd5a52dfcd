#pragma once

#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace castor::communication::test {

/// Something in a box that is seen from the front: its lower left corner, from that of the box, and
/// its size; metres.
struct PicturedItem {
  std::string shape;
  std::string colour;
  double x = 0;
  double z = 0;
  double size = 0;
};

/// Open boxes side by side, as vision would put them into working memory: what lies in which of
/// them, and what is on, above, under, left and right of each other in it. Items of equal width on
/// top of each other are a tower of blocks, which is a thing of its own.
class PictureScene {
public:
  /// \param side of the square box; metres
  /// \param is_stacked its items are the blocks of one tower
  void add_box(const std::vector<PicturedItem>& items, double side, bool is_stacked);

  /// Answers what ReferenceResolver would answer.
  binding::ReferenceReply reply(const binding::ReferenceRequest& request) const;

private:
  void add(const std::string& id, std::vector<binding::Feature> features, double x, double z,
           double width, double height);
  void relate_items(const std::vector<std::string>& ids, const std::vector<PicturedItem>& items,
                    bool is_stacked);

  std::map<std::string, binding::BindingUnion> unions_;
  std::vector<binding::UnionRelation> relations_;
  std::size_t boxes_ = 0;
};

} // namespace castor::communication::test
