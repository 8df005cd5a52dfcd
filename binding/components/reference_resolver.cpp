#include "castor/actors/component/registry.hpp"
#include "castor/binding/components/binding_component.hpp"
#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/known_scene.hpp"
#include "castor/binding/references.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace castor::binding {

namespace {

/// Answers what a description may be about: calls with a ReferenceRequest. Asks who is competent
/// for the kinds that it is about.
class ReferenceResolver final : public BindingComponent {
  void start() override {
    BindingComponent::start();
    on_change(changed<KnowledgeCompetence>(),
              [this](const ChangeEvent&) { are_competences_new_ = true; });
    on_call<ReferenceRequest>([this](const ReferenceRequest& x) { return resolve(x); });
  }

  void work(const Changes&) override {}

  ReferenceReply resolve(const ReferenceRequest& request) {
    catch_up();
    update_ontology(comparator_);
    update_competences();
    auto known = perceived(view());
    for (auto& x : competences_)
      if (x.answers_calls && is_concerned(x, request.kinds))
        if (auto told = ask(x))
          known.add(x, *std::move(told));
    ReferenceReply reply;
    for (auto& x : request.descriptions) {
      auto all = find_referents(x, known.unions, comparator_, known.relations, limit_);
      reply.referents.push_back({distinct_referents(all)});
    }
    for (auto& [id, x] : known.unions)
      reply.unions.push_back({id, x.proxy_ids.front(), x.features});
    reply.relations = std::move(known.relations);
    reply.competences = competences_;
    reply.ontology_version = ontology().version;
    if (request.known_ontology != ontology().version)
      reply.ontology = ConceptStatements{subarchitecture(), ontology().statements};
    return reply;
  }

  void update_competences() {
    if (!std::exchange(are_competences_new_, false))
      return;
    competences_.clear();
    for (auto& x : read_all<KnowledgeCompetence>())
      if (std::ranges::find(competences_, *x) == competences_.end())
        competences_.push_back(*x);
    // Whatever the order in which they came.
    std::ranges::sort(competences_, {},
                      [](auto& x) { return std::tie(x.subarchitecture, x.kind); });
  }

  bool is_concerned(const KnowledgeCompetence& x, const std::vector<std::string>& kinds) const {
    const auto& known = *ontology().ontology;
    return std::ranges::any_of(kinds, [&](auto& kind) {
      return known.is_kind_of(kind, x.kind) || known.is_kind_of(x.kind, kind);
    });
  }

  std::optional<KnowledgeReply> ask(const KnowledgeCompetence& x) {
    try {
      return call<KnowledgeRequest, KnowledgeReply>(x.subarchitecture, {x.kind},
                                                    {.timeout = patience_.get()});
    } catch (const WorkingMemoryException& e) {
      warning("{} does not tell what there is of the kind {}: {}", x.subarchitecture, x.kind,
              e.what());
      return std::nullopt;
    }
  }

  Option<std::uint32_t> limit_{this, "limit", 100000,
                               "how many readings of a description are looked at"};
  Option<std::chrono::milliseconds> patience_{
    this, "patience", std::chrono::seconds{1},
    "how long somebody may take to say what there is of a kind"};

  FeatureComparator comparator_;
  std::vector<KnowledgeCompetence> competences_;
  bool are_competences_new_ = true;
};

CASTOR_COMPONENT(ReferenceResolver, "answers which unions a description may be about")

} // namespace

} // namespace castor::binding
