#include "castor/benchmarks/semeval/robot_commands/command_features.hpp"

#include "castor/benchmarks/semeval/robot_commands/grounding_features.hpp"

#include <algorithm>

namespace castor::semeval {

namespace {

/// Longer sequences of words are too rare to learn from.
constexpr int max_words_between = 3;

class FeatureExtractor {
public:
  FeatureExtractor(const CommandDerivation& derivation, const communication::Lexicon& lexicon)
    : derivation_(derivation), lexicon_(lexicon), ends_(derivation.words.size() + 1, 0) {
    for (const auto& choice : derivation.meaning->choices)
      ends_[choice.begin] = choice.end;
  }

  std::vector<CommandFeature> extract(const RclTree& tree) {
    add("lexical", derivation_.meaning->weight);
    add_words();
    if (tree.label == "event") {
      add_event(tree, "single");
    } else {
      for (std::size_t i = 0; i < tree.children.size(); ++i)
        add_event(tree.children[i], i == 0 ? "first" : "second");
    }
    return std::move(features_);
  }

private:
  void add(std::string name, double value = 1) {
    std::replace(name.begin(), name.end(), ' ', '_');
    features_.push_back({std::move(name), value});
  }

  std::string word(int position) const {
    if (position < 0)
      return "<";
    if (position >= static_cast<int>(derivation_.words.size()))
      return ">";
    return derivation_.words[static_cast<std::size_t>(position)];
  }

  /// The phrase that a leaf is from; empty if there is none.
  std::string phrase(const RclTree& leaf) const {
    return leaf.first_token == 0 ? "" : words(leaf.first_token - 1, end_of(leaf));
  }

  int end_of(const RclTree& leaf) const {
    return leaf.first_token == 0 ? 0 : ends_[static_cast<std::size_t>(leaf.first_token - 1)];
  }

  std::string words(int begin, int end) const {
    std::string text;
    for (int i = begin; i < end; ++i)
      text += (text.empty() ? "" : "_") + word(i);
    return text;
  }

  std::string between(int begin, int end) const {
    return end - begin > max_words_between ? "many" : words(begin, end);
  }

  void add_words() {
    std::vector<bool> is_used(derivation_.words.size(), false);
    for (const auto& choice : derivation_.meaning->choices) {
      const auto& entry = lexicon_.entry(choice.entry);
      const auto name = entry.phrase + "=" + entry.predicate + "/" + entry.family;
      add("w:" + name);
      add("w:" + name + "|<" + word(choice.begin - 1));
      add("w:" + name + "|>" + word(choice.end));
      for (auto i = choice.begin; i < choice.end; ++i)
        is_used[i] = true;
    }
    for (std::size_t i = 0; i < is_used.size(); ++i)
      if (!is_used[i]) {
        const auto at = static_cast<int>(i);
        add("f:" + word(at));
        add("f:" + word(at) + "|<" + word(at - 1));
        add("f:" + word(at) + "|>" + word(at + 1));
      }
  }

  void add_event(const RclTree& event, const std::string& place) {
    const auto* action = event.child("action");
    const auto* entity = event.child("entity");
    const auto* destination = event.child("destination");
    const auto verb = phrase(*action);
    add("a:" + action->value + "|" + place + (destination != nullptr ? "|to" : ""));
    add("a:" + verb + "=" + action->value + "|" + place + (destination != nullptr ? "|to" : ""));
    add_entity(*entity, "what");
    const auto* inner = entity->child("spatial-relation");
    if (destination == nullptr) {
      if (inner != nullptr)
        add("p:" + place + "|what|" + phrase(*inner->child("relation")));
      return;
    }
    const auto& relation = destination->children.front();
    const auto* leaf = relation.child("relation");
    add("d:" + leaf->value + "|" + place);
    add("d:" + phrase(*leaf) + "|" + place + (inner != nullptr ? "|full" : "|bare"));
    add("d:<" + word(leaf->first_token - 2) + "|" + phrase(*leaf));
    add("d:<" + word(leaf->first_token - 2) + "|" + place);
    if (relation.child("measure") != nullptr)
      add("d:measure|" + leaf->value + (relation.child("entity") != nullptr ? "|of" : ""));
    if (const auto* other = relation.child("entity")) {
      const auto type = std::string(other->value_of("type"));
      add("d:" + leaf->value + "|" + type);
      add("d:" + phrase(*leaf) + "|" + type);
      add_entity(*other, "where");
    }
  }

  void add_entity(const RclTree& entity, const std::string& role) {
    const auto* type = entity.child("type");
    const auto colors = std::count_if(entity.children.begin(), entity.children.end(),
                                      [](const RclTree& child) { return child.label == "color"; });
    const auto name = phrase(*type) + "=" + type->value;
    add("e:" + name + "|" + std::to_string(colors));
    add("e:" + name + "|" + role);
    add("e:" + type->value + "|" + std::to_string(colors));
    for (const auto& child : entity.children)
      if (child.label == "indicator" || child.label == "cardinal")
        add("e:" + child.value + "|" + type->value);
    if (const auto* id = entity.child("id"))
      add("e:id" + id->value + "|" + role + "|" + type->value);
    const auto* relation = entity.child("spatial-relation");
    if (relation == nullptr) {
      add("e:" + role + "|bare|" + type->value);
      return;
    }
    const auto* leaf = relation->child("relation");
    const auto* other = relation->child("entity");
    if (other == nullptr)
      return;
    const auto other_type = std::string(other->value_of("type"));
    add("r:" + leaf->value + "|" + role);
    add("r:" + phrase(*leaf) + "|" + role);
    add("r:" + leaf->value + "|" + type->value + "|" + other_type);
    add("r:" + phrase(*leaf) + "=" + leaf->value + "|" + other_type);
    add("r:<" + between(end_of(*type), leaf->first_token - 1) + "|" + role);
    add("r:<" + word(leaf->first_token - 2) + "|" + phrase(*leaf));
    add_entity(*other, role + ".of");
  }

  const CommandDerivation& derivation_;
  const communication::Lexicon& lexicon_;
  /// Where the phrase that begins at each word ends.
  std::vector<int> ends_;
  std::vector<CommandFeature> features_;
};

} // namespace

std::vector<CommandFeature> command_features(const CommandDerivation& derivation,
                                             const communication::Lexicon& lexicon,
                                             const RclTree& tree, const Board* board) {
  auto features = FeatureExtractor(derivation, lexicon).extract(tree);
  if (board != nullptr)
    add_grounding_features(tree, *board, features);
  return features;
}

} // namespace castor::semeval
