#include "castor/benchmarks/semeval/robot_commands/grounding.hpp"

#include "castor/benchmarks/semeval/robot_commands/board_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::semeval {

namespace {

std::vector<std::string_view> values(const RclTree& entity, std::string_view label) {
  std::vector<std::string_view> found;
  for (const auto& child : entity.children)
    if (child.label == label)
      found.push_back(child.value);
  return found;
}

bool contains(const std::vector<std::string_view>& values, std::string_view value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

double distance(const Referent& a, const Referent& b) {
  const auto from = middle(a);
  const auto to = middle(b);
  return std::hypot(from.x - to.x, from.y - to.y);
}

bool is_above(const Referent& a, const Referent& b) {
  if ((a.cells & b.cells) == 0)
    return false;
  // What stands on a corner may stand on something else there.
  return b.top < 0 || a.bottom == b.top + 1;
}

bool is_within(const Referent& a, const Referent& b) {
  return (a.cells & ~b.cells) == 0 && (b.top < 0 || (a.bottom >= b.bottom && a.top <= b.top));
}

bool is_adjacent(const Referent& a, const Referent& b) {
  const auto from = middle(a);
  const auto to = middle(b);
  return a.cells != b.cells && std::max(std::abs(from.x - to.x), std::abs(from.y - to.y)) < 1.5;
}

bool is_related(const Referent& a, const Referent& b, std::string_view relation) {
  if (relation == "above")
    return is_above(a, b);
  if (relation == "within")
    return is_within(a, b);
  if (relation == "adjacent")
    return is_adjacent(a, b);
  const auto from = middle(b);
  const auto to = middle(a);
  if (relation == "left")
    return to.y > from.y;
  if (relation == "right")
    return to.y < from.y;
  if (relation == "front" || relation == "forward")
    return to.x > from.x;
  return relation == "backward" && to.x < from.x;
}

/// Those that come nearest to any of `others`, all if there are ties.
std::vector<Referent> nearest(const std::vector<Referent>& candidates,
                              const std::vector<Referent>& others) {
  std::vector<Referent> found;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& candidate : candidates)
    for (const auto& other : others) {
      if (candidate.block != nullptr && candidate.block == other.block)
        continue;
      const double far = distance(candidate, other);
      if (far < least - 1e-9) {
        found.clear();
        least = far;
      }
      if (far < least + 1e-9 && (found.empty() || found.back().block != candidate.block))
        found.push_back(candidate);
    }
  return found;
}

const RclTree* with_id(const RclTree& tree, std::string_view id) {
  if (tree.label == "entity" && tree.value_of("id") == id)
    return &tree;
  for (const auto& child : tree.children)
    if (const auto* found = with_id(child, id))
      return found;
  return nullptr;
}

/// What refers to itself refers to nothing.
bool has_reference(const RclTree& tree) {
  return tree.value_of("type") == "reference" ||
         std::any_of(tree.children.begin(), tree.children.end(), has_reference);
}

Referent referent_of(const Block& block) {
  return {cell(block.position.x, block.position.y), block.position.z, block.position.z, &block};
}

} // namespace

Grounding::Grounding(const Board& board, const RclTree& command)
  : board_(board), command_(command) {
  // nop
}

const RclTree* Grounding::antecedent(const RclTree& tree) const {
  const auto id = tree.value_of("reference-id");
  return id.empty() ? nullptr : with_id(command_, id);
}

std::vector<Referent> Grounding::referents(const RclTree& entity) const {
  auto found = of_type(entity);
  for (const auto indicator : values(entity, "indicator"))
    found = selected(std::move(found), indicator);
  if (const auto* relation = entity.child("spatial-relation"))
    found = related(found, *relation);
  return found;
}

std::vector<Referent> Grounding::of_type(const RclTree& entity) const {
  auto type = entity.value_of("type");
  if (type == "reference") {
    const auto* meant = antecedent(entity);
    return meant == nullptr || has_reference(*meant) ? std::vector<Referent>() : referents(*meant);
  }
  if (type == "type-reference") {
    const auto* meant = antecedent(entity);
    type = meant == nullptr ? "cube" : meant->value_of("type");
  }
  if (is_place(type))
    return places(type, values(entity, "indicator"));
  if (type == "stack")
    return stacks(entity);
  if (type == "cube-group")
    return groups(entity);
  return blocks(entity, type);
}

std::vector<Referent> Grounding::blocks(const RclTree& entity, std::string_view type) const {
  const auto colors = values(entity, "color");
  const auto fits = [&](const Block& block) {
    return block.type == type && (colors.empty() || contains(colors, block.color));
  };
  std::vector<Referent> found;
  for (const auto& block : board_.blocks)
    if (fits(block))
      found.push_back(referent_of(block));
  if (board_.held && fits(*board_.held))
    found.push_back(referent_of(*board_.held));
  return found;
}

/// Columns of two blocks or more, of just the colours of the entity; what crowns them, such as a
/// prism, may have another one.
std::vector<Referent> Grounding::stacks(const RclTree& entity) const {
  const auto colors = values(entity, "color");
  std::vector<Referent> found;
  for (int x = 0; x < board_size; ++x)
    for (int y = 0; y < board_size; ++y) {
      const int height = board_.height(x, y);
      std::vector<std::string_view> seen;
      for (int z = 0; z < height; ++z) {
        const auto* block = board_.at({x, y, z});
        if (block == nullptr || block->type != "cube" ||
            (!colors.empty() && !contains(colors, block->color)))
          break;
        if (!contains(seen, block->color))
          seen.push_back(block->color);
        const bool is_top = z + 1 == height || board_.at({x, y, z + 1}) == nullptr ||
                            board_.at({x, y, z + 1})->type != "cube" ||
                            (!colors.empty() && !contains(colors, board_.at({x, y, z + 1})->color));
        if (z > 0 && is_top && (colors.empty() || seen.size() == colors.size()))
          found.push_back({cell(x, y), 0, z, nullptr});
      }
    }
  return found;
}

/// Two cubes or more upon each other, of just the colours of the entity.
std::vector<Referent> Grounding::groups(const RclTree& entity) const {
  const auto colors = values(entity, "color");
  std::vector<Referent> found;
  for (int x = 0; x < board_size; ++x)
    for (int y = 0; y < board_size; ++y) {
      const int height = board_.height(x, y);
      int bottom = 0;
      std::vector<std::string_view> seen;
      for (int z = 0; z <= height; ++z) {
        const auto* block = board_.at({x, y, z});
        const bool fits = block != nullptr && block->type == "cube" &&
                          (colors.empty() || contains(colors, block->color));
        if (fits) {
          if (!contains(seen, block->color))
            seen.push_back(block->color);
          continue;
        }
        if (z - bottom > 1 && (colors.empty() || seen.size() == colors.size()))
          found.push_back({cell(x, y), bottom, z - 1, nullptr});
        bottom = z + 1;
        seen.clear();
      }
    }
  return found;
}

std::vector<Referent> Grounding::selected(std::vector<Referent> candidates,
                                          std::string_view indicator) const {
  if (candidates.empty() || candidates.front().top < 0)
    return candidates;
  if (indicator == "individual") {
    std::erase_if(candidates, [this](const Referent& referent) {
      const auto at = middle(referent);
      return referent.block == nullptr ||
             board_.height(static_cast<int>(at.x), static_cast<int>(at.y)) != 1;
    });
    return candidates;
  }
  if (indicator == "nearest")
    return nearest(candidates, places("robot", {}));
  const bool is_left = indicator == "leftmost" || indicator == "left";
  const bool is_right = indicator == "rightmost" || indicator == "right";
  if (!is_left && !is_right && indicator != "front" && indicator != "back")
    return candidates;
  const auto rank = [&](const Referent& referent) {
    const auto at = middle(referent);
    return is_left ? at.y : is_right ? -at.y : indicator == "front" ? at.x : -at.x;
  };
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& candidate : candidates)
    best = std::max(best, rank(candidate));
  std::erase_if(candidates, [&](const Referent& referent) { return rank(referent) < best - 1e-9; });
  return candidates;
}

std::vector<Referent> Grounding::related(const std::vector<Referent>& candidates,
                                         const RclTree& relation) const {
  const auto* other = relation.child("entity");
  if (other == nullptr)
    return candidates;
  const auto others = referents(*other);
  const auto name = relation.value_of("relation");
  if (name == "nearest")
    return nearest(candidates, others);
  std::vector<Referent> found;
  for (const auto& candidate : candidates)
    if (std::any_of(others.begin(), others.end(),
                    [&](const Referent& b) { return is_related(candidate, b, name); }))
      found.push_back(candidate);
  return found;
}

bool Grounding::is_clear(const Referent& referent) const {
  const auto at = middle(referent);
  return board_.at({static_cast<int>(at.x), static_cast<int>(at.y), referent.top + 1}) == nullptr;
}

} // namespace castor::semeval
