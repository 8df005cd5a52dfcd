#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/base/name_and_value.hpp"
#include "castor/planning/contributors/union_facts.hpp"

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;

/// Says in the words of a domain what is bound: a contributor of continual planning.
class UnionContributor final : public ManagedComponent {
  void configure() override {
    terms_.thing_type = thing_type_;
    terms_.place_type = place_type_;
    terms_.position = position_;
    terms_.free_places = free_places_;
    for (const auto& [label, predicate] : pairs(relations_))
      terms_.relations[label] = predicate;
    for (const auto& [name, predicate] : pairs(unknown_))
      terms_.unknown[feature_named(name)] = predicate;
    for (const auto& rule : words_.get())
      terms_.words.push_back(word_facts(rule));
  }

  static std::vector<std::pair<std::string, std::string>>
  pairs(const std::vector<std::string>& rules) {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto& rule : rules) {
      auto parts = name_and_value(rule);
      if (!parts)
        throw std::invalid_argument("'" + rule + "' is not understood: write NAME=PREDICATE");
      result.push_back(std::move(*parts));
    }
    return result;
  }

  void start() override {
    on_call<StateRequest>([this](const StateRequest&) {
      const auto bound = call<binding::ReferenceRequest, binding::ReferenceReply>(
        binding_, {}, {.timeout = patience_.get()});
      auto result = facts_of(bound, terms_);
      if (!agent_->empty())
        result.objects.push_back({agent_, agent_type_});
      return result;
    });
  }

  Option<SubarchitectureName> binding_{this, "binding", "binding",
                                       "the subarchitecture with a ReferenceResolver"};
  Option<std::string> agent_{this, "agent", "",
                             "the robot as an object; empty: somebody else says"};
  Option<std::string> agent_type_{this, "agent-type", "agent", "its type"};
  Option<std::string> thing_type_{this, "thing-type", "thing", "type of things"};
  Option<std::string> place_type_{this, "place-type", "waypoint", "type of their places"};
  Option<std::string> position_{this, "position", "pos", "state variable: the place of a thing"};
  Option<std::vector<std::string>> relations_{
    this, "relations", {}, "predicates for relations: left=wp-left-of,near=wp-near"};
  Option<std::vector<std::string>> words_{
    this, "words", {}, "predicates for words, and types of these: colour=has-colour:colour"};
  Option<std::vector<std::string>> unknown_{
    this, "unknown", {}, "predicates for words that were looked for in vain: colour=no-colour"};
  Option<std::int64_t> free_places_{this, "free-places", 0, "places at which nothing is"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 1s,
                                              "how long it waits for binding"};

  UnionFactTerms terms_;
};

CASTOR_COMPONENT(UnionContributor, "says what is bound, for planning")

} // namespace

} // namespace castor::planning
