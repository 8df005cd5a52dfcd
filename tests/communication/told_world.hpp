#pragma once

#include "castor/base/ontology_reader.hpp"
#include "castor/binding/references.hpp"
#include "castor/communication/parsing/lexicon_reader.hpp"
#include "castor/tests/binding/proxies.hpp"
#include "castor/tests/binding/reference/binding_core.hpp"
#include "castor/tests/communication/shared_vocabulary.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication::test {

/// What is told of a world, bound; with words and concepts besides those that are shared.
class ToldWorld {
public:
  ToldWorld(const std::string& words, const std::string& concepts)
    : vocabulary_(vocabulary(words, concepts)), core_(options()) {}

  void put(const std::string& id, std::vector<binding::Feature> features) {
    features.push_back(binding::feature(binding::FeatureKind::this_proxy_id, id));
    features.push_back(binding::not_from("world"));
    core_.set(id, binding::test::proxy_from("world", std::move(features)));
  }

  void relate(const std::string& label, const std::string& from, const std::string& to) {
    core_.set(label + ' ' + from + ' ' + to,
              binding::test::relation_from("world", label, from, to));
  }

  void know(const std::string& kind) { competences_.push_back({"world", kind, false, false}); }

  void learn_names_of(const std::string& kind) {
    for (auto& x : competences_)
      x.learns_names = x.learns_names || x.kind == kind;
  }

  const std::shared_ptr<const Vocabulary>& words() const { return vocabulary_; }

  TableTalk talk() {
    return TableTalk{
      [this](auto& request) { return reply(request); },
      [this](const std::string& name, std::vector<binding::Feature> features) {
        core_.set(name, binding::test::with_precedence(
                          binding::test::proxy_from("communication", std::move(features)), 1));
      },
      vocabulary_};
  }

  binding::ReferenceReply reply(const binding::ReferenceRequest& request) const {
    binding::ReferenceReply result;
    for (auto& x : request.descriptions)
      result.referents.push_back(
        {binding::distinct_referents(find_referents(x, core_.unions(), core_.comparator()))});
    for (auto& [id, x] : core_.unions())
      result.unions.push_back({id, x.proxy_ids.front(), x.features});
    result.relations = relations_between(core_.unions());
    result.competences = competences_;
    return result;
  }

private:
  static std::shared_ptr<const Vocabulary> vocabulary(const std::string& words,
                                                      const std::string& concepts) {
    std::vector<NamedText> lexicon{shared_lexicon_files().front(), {"robot.words", words}};
    std::vector<NamedText> ontology{binding::shared_ontology_files().front(),
                                    {"robot.ontology", concepts}};
    const auto read = read_lexicon(lexicon);
    EXPECT_EQ(render(read.problems), "");
    const auto stated = read_ontology(ontology);
    EXPECT_EQ(render(stated.problems), "");
    return std::make_shared<const Vocabulary>(read.lexicon,
                                              std::make_shared<const Ontology>(stated.statements));
  }

  binding::ComparatorOptions options() const {
    binding::ComparatorOptions result;
    result.ontology = std::make_shared<const Ontology>(vocabulary_->ontology());
    return result;
  }

  std::shared_ptr<const Vocabulary> vocabulary_;
  binding::BindingCore core_;
  std::vector<binding::KnowledgeCompetence> competences_;
};

} // namespace castor::communication::test
