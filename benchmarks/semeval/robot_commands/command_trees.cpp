#include "castor/benchmarks/semeval/robot_commands/command_trees.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <charconv>

namespace castor::semeval {

namespace {

/// The word of a nominal such as w12; 0 if no word brought it.
int word_of(const communication::Nominal& nominal) {
  int word = 0;
  if (nominal.name.starts_with('w'))
    std::from_chars(nominal.name.data() + 1, nominal.name.data() + nominal.name.size(), word);
  return word;
}

RclTree leaf(const std::string& label, const communication::Nominal& nominal) {
  const int word = word_of(nominal);
  return {label, nominal.proposition, {}, word, word};
}

/// Writes a logical form as a tree, children in RCL's order.
class TreeWriter {
public:
  explicit TreeWriter(const communication::LogicalForm& form) : form_(form) {
    // nop
  }

  RclTree write() const {
    const auto* root = find_nominal(form_, form_.root);
    if (root->sort == "event")
      return event(*root);
    RclTree sequence{"sequence", {}, {}, 0, 0};
    for (const auto* mode : {"first", "second"})
      if (const auto* part = dependent(form_, *root, mode))
        sequence.children.push_back(event(*part));
    return sequence;
  }

private:
  RclTree event(const communication::Nominal& nominal) const {
    RclTree tree{"event", {}, {leaf("action", nominal)}, 0, 0};
    if (const auto* what = dependent(form_, nominal, "entity"))
      tree.children.push_back(entity(*what));
    if (const auto* where = dependent(form_, nominal, "destination"))
      tree.children.push_back({"destination", {}, {relation(*where)}, 0, 0});
    return tree;
  }

  RclTree entity(const communication::Nominal& nominal) const {
    RclTree tree{"entity", {}, {}, 0, 0};
    for (const auto* label : {"cardinal", "indicator", "color", "type"})
      for (const auto& relation : nominal.relations)
        if (relation.mode == label)
          tree.children.push_back(leaf(label, *find_nominal(form_, relation.dependent)));
    if (const auto* place = dependent(form_, nominal, "spatial-relation"))
      tree.children.push_back(relation(*place));
    return tree;
  }

  RclTree relation(const communication::Nominal& nominal) const {
    RclTree tree{"spatial-relation", {}, {}, 0, 0};
    if (const auto* measure = dependent(form_, nominal, "measure"))
      tree.children.push_back({"measure", {}, {entity(*measure)}, 0, 0});
    tree.children.push_back(leaf("relation", nominal));
    if (const auto* other = dependent(form_, nominal, "entity"))
      tree.children.push_back(entity(*other));
    return tree;
  }

  const communication::LogicalForm& form_;
};

void collect_entities(RclTree& tree, std::vector<RclTree*>& entities) {
  if (tree.label == "entity")
    entities.push_back(&tree);
  for (auto& child : tree.children)
    collect_entities(child, entities);
}

bool is_type_reference(const RclTree& entity) {
  return entity.value_of("type").starts_with("type-reference");
}

void insert_reference(RclTree& entity) {
  const auto place = std::find_if(entity.children.begin(), entity.children.end(),
                                  [](const RclTree& child) { return child.label == "type"; });
  entity.children.insert(place + 1, {"reference-id", "1", {}, 0, 0});
}

/// Says that all references in the tree are to its entity number `antecedent`, in text order.
RclTree with_references(RclTree tree, std::size_t antecedent) {
  std::vector<RclTree*> entities;
  collect_entities(tree, entities);
  // From behind, because children move when something is inserted before them.
  for (auto i = entities.size(); i-- > 0;) {
    if (is_type_reference(*entities[i]) || entities[i]->value_of("type") == "reference")
      insert_reference(*entities[i]);
    if (i == antecedent)
      entities[i]->children.insert(entities[i]->children.begin(), {"id", "1", {}, 0, 0});
  }
  return tree;
}

} // namespace

std::vector<RclTree> command_trees(const communication::LogicalForm& form) {
  auto tree = TreeWriter(form).write();
  std::vector<RclTree*> entities;
  collect_entities(tree, entities);
  const bool has_reference =
    std::any_of(entities.begin(), entities.end(),
                [](const RclTree* entity) { return entity->value_of("type") == "reference"; });
  if (has_reference)
    return {with_references(tree, 0)};
  const auto one = std::find_if(entities.begin(), entities.end(),
                                [](const RclTree* entity) { return is_type_reference(*entity); });
  if (one == entities.end())
    return {tree};
  std::vector<RclTree> trees;
  for (std::size_t i = 0; i < static_cast<std::size_t>(one - entities.begin()); ++i)
    trees.push_back(with_references(tree, i));
  return trees;
}

} // namespace castor::semeval
