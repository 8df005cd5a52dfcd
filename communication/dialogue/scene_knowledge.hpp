#pragma once

#include "castor/binding/types.hpp"
#include "castor/communication/dialogue/truth.hpp"
#include "castor/communication/types.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace castor::communication {

/// Proxies of what is known to be meant, such as by a pronoun, by the names of their nominals.
using Antecedents = std::map<std::string, std::vector<std::string>>;

/// After the name of a nominal such as "the other one": what that was chosen from.
inline constexpr std::string_view chosen_from = "/of";

/// After the name of a nominal such as "they": nothing has been said before, so it is about all
/// there is.
inline constexpr std::string_view first_spoken_of = "/first";

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
///     with_knowledge([](auto& questions) { return call<ReferenceRequest, ReferenceReply>(...); },
///                    [](SceneKnowledge& scene) { return respond(..., scene); });
///
/// What is not known yet is `Truth::unknown`.
class SceneKnowledge {
public:
  /// Whether a feature is true of a thing, by binding's comparison of features.
  Truth has(const std::string& id, const binding::Feature& x);

  /// Whether a thing is so related to another.
  Truth is_related(const std::string& relation, const std::string& from, const std::string& to);

  /// Whether there are relations of that name at all.
  bool knows_relation(const std::string& relation) const;

  /// Descriptions asked for and not known yet.
  const std::vector<binding::Description>& open_questions() const { return open_questions_; }

  /// \pre these are open questions, and the reply has as many referents
  void learn(std::span<const binding::Description> asked, binding::ReferenceReply reply);

  /// The unions of things, not of places and relations; empty before anything was learned, which
  /// is an open question then.
  const std::vector<std::string>& things();

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

  /// The largest of a thing's dimensions, metres.
  std::optional<double> extent(const std::string& union_id) const;

  /// Where a thing begins and ends; nothing if its place or its extent is not known.
  std::optional<Body> body(const std::string& union_id) const;

  /// The things that are in a thing, such as the blocks of a tower.
  const std::vector<std::string>& contents(const std::string& union_id) const;

  /// The things that a thing is in.
  const std::vector<std::string>& containers(const std::string& union_id) const;

  /// How a thing lies to others, the nearest of them first.
  std::vector<SpatialFact> spatial_facts(const std::string& union_id) const;

private:
  const binding::KnownUnion* find(const std::string& union_id) const;
  std::optional<Place> place_by(const std::string& union_id, binding::FeatureKind kind) const;
  void ask(const binding::Description& description);
  void relate_things();

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
  /// The locations of each thing.
  std::map<std::string, std::vector<std::string>> locations_;
  /// Between things; sorted and distinct.
  std::vector<binding::UnionRelation> relations_;
  std::map<std::string, std::vector<std::string>> contents_;
  std::map<std::string, std::vector<std::string>> containers_;
};

/// The result of `f` once all that it asks a scene for is known.
/// \param ask answers descriptions with a binding::ReferenceReply
template <class Ask, class F>
auto with_knowledge(Ask ask, F f) {
  SceneKnowledge scene;
  auto result = f(scene);
  while (!scene.open_questions().empty()) {
    auto asked = scene.open_questions();
    scene.learn(asked, ask(asked));
    result = f(scene);
  }
  return result;
}

} // namespace castor::communication
