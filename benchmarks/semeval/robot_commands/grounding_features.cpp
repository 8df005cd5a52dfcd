#include "castor/benchmarks/semeval/robot_commands/grounding_features.hpp"

#include "castor/benchmarks/semeval/robot_commands/board_places.hpp"
#include "castor/benchmarks/semeval/robot_commands/grounding.hpp"

#include <algorithm>

namespace castor::semeval {

namespace {

std::string how_many(std::size_t count) {
  return count == 0 ? "none" : count == 1 ? "one" : "many";
}

class GroundingFeatures {
public:
  GroundingFeatures(const RclTree& command, const Board& board,
                    std::vector<CommandFeature>& features)
    : board_(board), grounding_(board, command), features_(features) {
    // nop
  }

  void add_event(const RclTree& event, bool is_second) {
    const auto action = std::string(event.value_of("action"));
    if (!is_second)
      add("g:" + action + (board_.held ? "|held" : "|free"));
    const auto& entity = *event.child("entity");
    const auto taken = add_entity(entity, is_second ? "it" : "what");
    if (!is_second)
      add_taken(taken);
    if (const auto* destination = event.child("destination"))
      add_destination(destination->children.front(), taken);
  }

private:
  void add(std::string name) { features_.push_back({std::move(name), 1}); }

  std::vector<Referent> add_entity(const RclTree& entity, const std::string& role) {
    const auto referents = grounding_.referents(entity);
    const auto type = std::string(entity.value_of("type"));
    add("g:" + role + "|" + how_many(referents.size()));
    add("g:" + role + "|" + type + "|" + how_many(referents.size()));
    if (referents.empty())
      add("g:none");
    if (const auto* relation = entity.child("spatial-relation")) {
      auto bare = entity;
      std::erase_if(bare.children,
                    [](const RclTree& child) { return child.label == "spatial-relation"; });
      const auto all = grounding_.referents(bare);
      add("g:" + role + "|" + how_many(all.size()) + ">" + how_many(referents.size()));
      add("g:" + role + "|" + std::string(relation->value_of("relation")) + "|" +
          how_many(all.size()) + ">" + how_many(referents.size()));
      if (const auto* other = relation->child("entity"))
        add_entity(*other, role + ".of");
    }
    return referents;
  }

  void add_taken(const std::vector<Referent>& taken) {
    const auto clear = std::count_if(taken.begin(), taken.end(), [this](const Referent& referent) {
      return grounding_.is_clear(referent);
    });
    add("g:clear|" + how_many(static_cast<std::size_t>(clear)));
    if (board_.held) {
      const bool is_held =
        std::any_of(taken.begin(), taken.end(),
                    [this](const Referent& referent) { return referent.block == &*board_.held; });
      add(is_held ? "g:is-held" : "g:is-not-held");
    }
  }

  /// Blocks are put where nothing is yet, and not upon prisms or themselves.
  void add_destination(const RclTree& relation, const std::vector<Referent>& taken) {
    const auto* other = relation.child("entity");
    if (other == nullptr)
      return;
    const auto places = add_entity(*other, "where");
    if (relation.value_of("relation") != "above")
      return;
    const auto is_taken = [&taken](const Referent& place) {
      return std::any_of(taken.begin(), taken.end(), [&place](const Referent& referent) {
        return referent.block != nullptr && referent.block == place.block;
      });
    };
    const auto free = std::count_if(places.begin(), places.end(), [&](const Referent& place) {
      return place.top < 0 || (grounding_.is_clear(place) && !is_taken(place) &&
                               (place.block == nullptr || place.block->type == "cube"));
    });
    const auto there = std::count_if(places.begin(), places.end(), [&](const Referent& place) {
      return std::any_of(taken.begin(), taken.end(), [&place](const Referent& referent) {
        return (referent.cells & place.cells) != 0 && referent.bottom == place.top + 1;
      });
    });
    add("g:room|" + how_many(static_cast<std::size_t>(free)));
    add("g:there|" + how_many(static_cast<std::size_t>(there)));
  }

  const Board& board_;
  Grounding grounding_;
  std::vector<CommandFeature>& features_;
};

} // namespace

void add_grounding_features(const RclTree& tree, const Board& board,
                            std::vector<CommandFeature>& features) {
  GroundingFeatures grounding(tree, board, features);
  if (tree.label == "event")
    return grounding.add_event(tree, false);
  for (std::size_t i = 0; i < tree.children.size(); ++i)
    grounding.add_event(tree.children[i], i > 0);
}

} // namespace castor::semeval
