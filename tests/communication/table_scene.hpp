#pragma once

#include "castor/binding/references.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/tests/binding/proxies.hpp"
#include "castor/tests/binding/reference/binding_core.hpp"
#include "castor/tests/communication/shared_vocabulary.hpp"

#include <string>
#include <utility>
#include <vector>

namespace castor::communication::test {

/// Things on a table, bound; answers what ReferenceResolver would answer.
class TableScene {
public:
  /// \param of_place what else is known of the place
  void put(const std::string& id, std::vector<binding::Feature> features, double x, double y,
           std::vector<binding::Feature> of_place = {}) {
    features.push_back(feature(binding::FeatureKind::concept_name, "thing"));
    features.push_back(feature(binding::FeatureKind::this_proxy_id, id));
    features.push_back(binding::not_from("vision"));
    core_.set(id, binding::test::proxy_from("vision", std::move(features)));
    of_place.push_back(binding::location_at(x, y, 0, "table"));
    of_place.push_back(binding::not_from("vision"));
    core_.set("at " + id, binding::test::proxy_from("vision", std::move(of_place)));
    core_.set("pos " + id, binding::test::relation_from("vision", "pos", "at " + id, id));
  }

  /// `target` is so of `landmark`.
  void relate(const std::string& relation, const std::string& target, const std::string& landmark) {
    core_.set(relation + ' ' + target + ' ' + landmark,
              binding::test::relation_from("spatial", relation, "at " + target, "at " + landmark));
  }

  /// Somebody says so of something.
  void tell(const std::string& name, std::vector<binding::Feature> features) {
    core_.set(name, binding::test::with_precedence(
                      binding::test::proxy_from("communication", std::move(features)), 1));
  }

  binding::ReferenceReply reply(const binding::ReferenceRequest& request) const {
    binding::ReferenceReply result;
    for (auto& x : request.descriptions) {
      auto all = find_referents(x, core_.unions(), core_.comparator());
      result.referents.push_back({binding::distinct_referents(all)});
    }
    for (auto& [id, x] : core_.unions())
      result.unions.push_back({id, x.proxy_ids.front(), x.features});
    result.relations = relations_between(core_.unions());
    result.competences = {{"vision", "thing"}};
    return result;
  }

  /// What `f` makes of what is known, asked for as long as it asks.
  template <class F>
  auto known_to(F f) const {
    return with_knowledge(
      shared_vocabulary(), [this](auto& asked) { return reply(asked); }, std::move(f));
  }

private:
  binding::BindingCore core_;
};

} // namespace castor::communication::test
