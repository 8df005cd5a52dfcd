#pragma once

#include "castor/binding/types.hpp"
#include "castor/communication/dialogue/truth.hpp"
#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/types.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor::communication {

/// Proxies of what is known to be meant, such as by a pronoun, by the names of their nominals.
using Antecedents = std::map<std::string, std::vector<std::string>>;

/// After the name of a nominal such as "the other one": what that was chosen from.
inline constexpr std::string_view chosen_from = "/of";

/// After the name of a nominal such as "they": nothing has been said before, so it is about all
/// there is.
inline constexpr std::string_view first_spoken_of = "/first";

/// After the name of a nominal such as "the ball": things that were spoken of last, one by one. Of
/// several balls it is the one among these.
inline constexpr std::string_view spoken_of_last = "/last";

/// After the name of a nominal such as "the taller one": several things that were the last answer,
/// or spoken of last.
inline constexpr std::string_view last_group = "/group";

/// After the name of a nominal such as "this cube" or "here": what somebody points at and may mean
/// by it. None if there is no such thing.
inline constexpr std::string_view pointed_at = "/at";

/// A point on the table, metres.
struct Place {
  double x = 0;
  double y = 0;
};

/// A thing in space, metres; z upwards.
struct Body {
  std::array<double, 3> centre{};
  std::array<double, 3> extent{};

  double low(std::size_t axis) const { return centre[axis] - extent[axis] / 2; }
  double high(std::size_t axis) const { return centre[axis] + extent[axis] / 2; }
};

/// Spatial relation of a thing to a landmark (a union id).
struct SpatialFact {
  std::string relation;
  std::string landmark;
  /// Distance in metres; negative if unknown.
  double distance = -1;
};

/// Cache of binding's answers about the scene. It collects the questions that it could not answer,
/// so that the caller can ask binding and try again:
///
///     with_knowledge(vocabulary,
///                    [](const auto& request) { return call<ReferenceRequest, ...>(...); },
///                    [](SceneKnowledge& scene) { return respond(..., scene); });
///
/// What is not known yet is `Truth::unknown`.
///
/// Individuals are all of which a concept is known. Those of the vocabulary's general kind are
/// things; rooms and the robot itself are others.
class SceneKnowledge {
public:
  explicit SceneKnowledge(std::shared_ptr<const Vocabulary> vocabulary)
    : vocabulary_(std::move(vocabulary)) {}

  /// With the ontology of binding's last answer.
  const Vocabulary& vocabulary() const { return *vocabulary_; }
  const std::shared_ptr<const Vocabulary>& shared_vocabulary() const { return vocabulary_; }

  /// Whether a feature is true of a thing, by binding's comparison of features.
  Truth has(const std::string& id, const binding::Feature& x);

  /// Whether a thing is so related to another.
  Truth is_related(const std::string& relation, const std::string& from, const std::string& to);

  /// Whether a thing is on that side of another - left, right, front or back - if what is rather on
  /// the next side counts, too: up to 70 degrees off.
  bool is_toward(std::string_view side, const std::string& from, const std::string& to) const;

  /// Whether there are relations of that name at all.
  bool knows_relation(const std::string& relation) const;

  /// Descriptions asked for and not known yet.
  const std::vector<binding::Description>& open_questions() const { return open_questions_; }

  /// The open questions, and of what kinds they are.
  binding::ReferenceRequest request() const { return {open_questions_, kinds_}; }

  /// \pre these are open questions, and the reply has as many referents
  void learn(std::span<const binding::Description> asked, binding::ReferenceReply reply);

  /// The unions of things, not of places and relations; empty before anything was learned, which
  /// is an open question then.
  const std::vector<std::string>& things();

  /// The individuals that a noun may stand for: rooms for "kitchen". Who is competent for the kind
  /// is asked, which is an open question before.
  const std::vector<std::string>& candidates(const std::string& noun);

  /// All of which a concept is known, whatever they are; an open question as things are.
  const std::vector<std::string>& individuals() {
    things();
    return all_;
  }

  bool is_thing(const std::string& union_id) const {
    return all_.size() == things_.size() || std::ranges::find(things_, union_id) != things_.end();
  }

  /// Whether somebody knows what there is of the kind that a noun stands for.
  bool is_kind_known(const std::string& noun) const;

  /// The subarchitecture that takes note of names such as this noun, which is no name for all of
  /// their kind; empty if there is none, or while it is an open question.
  std::string learner_of(const std::string& noun);

  /// Who is spoken to; empty if nobody tells of it.
  std::vector<std::string> addressee();

  /// What an individual is in that is no thing, such as a room.
  std::vector<std::string> surroundings(const std::string& union_id) const;

  /// The proxy by which to refer to a union in the long term.
  std::string proxy_of(const std::string& union_id) const;

  /// The known words of a kind, perceived ones first.
  std::vector<std::string> words(const std::string& union_id, binding::FeatureKind kind) const;

  /// Whether nobody who says one of these words is unsure of it.
  bool is_sure(const std::string& union_id, binding::FeatureKind kind) const;

  /// In the coordinates of vision.
  std::optional<Place> place(const std::string& union_id) const;

  /// As the viewer sees it: x to the right, y away. The same as the place if nothing else is known.
  std::optional<Place> place_in_view(const std::string& union_id) const;

  /// Whether something is in what is no thing, such as a room.
  bool has_places() const {
    return std::ranges::any_of(relations_, [this](auto& x) {
      return x.label == binding::containment_label && !is_thing(x.to);
    });
  }

  /// The largest of a thing's dimensions, metres.
  std::optional<double> extent(const std::string& union_id) const;
  /// The larger one of its horizontal dimensions, metres.
  std::optional<double> width(const std::string& union_id) const;
  /// Upwards; metres.
  std::optional<double> height(const std::string& union_id) const;

  /// Where a thing begins and ends; nothing if its place or its extent is not known.
  std::optional<Body> body(const std::string& union_id) const;

  /// The things that are in a thing, such as the blocks of a tower; none in a room.
  const std::vector<std::string>& contents(const std::string& union_id) const;

  /// The things that a thing is in.
  const std::vector<std::string>& containers(const std::string& union_id) const;

  /// How a thing lies to others, the nearest of them first, and of one of them the relation in
  /// whose direction it is farther.
  std::vector<SpatialFact> spatial_facts(const std::string& union_id) const;

private:
  bool ask_for_kind(const std::string& name);
  void take_ontology(const binding::ConceptStatements& stated);
  void sort_individuals();
  const binding::KnownUnion* find(const std::string& union_id) const;
  std::optional<Place> place_by(const std::string& union_id, binding::FeatureKind kind) const;
  void ask(const binding::Description& description);
  void relate_things();

  std::shared_ptr<const Vocabulary> vocabulary_;
  bool has_learned_ = false;
  /// What things a feature is or may be true of, by their ids; of no others.
  struct KnownFeature {
    binding::Feature feature;
    std::unordered_map<std::string, Truth> truth;
  };

  std::vector<KnownFeature> known_;
  /// Each is of one thing with one feature.
  std::vector<binding::Description> open_questions_;
  /// Its unions are sorted by id.
  binding::ReferenceReply scene_;
  std::vector<std::string> things_;
  std::vector<std::string> others_;
  /// Those of which it is not known whether they are things, after the things.
  std::vector<std::string> all_;
  /// Concepts of the kinds that were asked for, and how many of them binding has been asked for.
  std::vector<std::string> kinds_;
  std::size_t kinds_asked_ = 0;
  /// The locations of each thing.
  std::map<std::string, std::vector<std::string>> locations_;
  /// Between things; sorted and distinct.
  std::vector<binding::UnionRelation> relations_;
  std::map<std::string, std::vector<std::string>> contents_;
  std::map<std::string, std::vector<std::string>> containers_;
};

/// The result of `f` once all that it asks a scene for is known.
/// \param ask answers a binding::ReferenceRequest with a binding::ReferenceReply
template <class Ask, class F>
auto with_knowledge(const std::shared_ptr<const Vocabulary>& vocabulary, Ask ask, F f) {
  SceneKnowledge scene{vocabulary};
  auto result = f(scene);
  while (!scene.open_questions().empty()) {
    const auto request = scene.request();
    scene.learn(request.descriptions, ask(request));
    result = f(scene);
  }
  return result;
}

} // namespace castor::communication
