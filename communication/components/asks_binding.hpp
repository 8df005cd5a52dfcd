#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/binding/types.hpp"
#include "castor/communication/components/uses_lexicon.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/planning/tabletop/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace castor::communication {

/// A component derived from `Base` that can ask binding for the referents of descriptions, and
/// knows by which concepts binding compares.
template <class Base>
class AsksBinding : public UsesLexicon<Base> {
protected:
  /// Calls binding. Nothing if there is no binding, or no answer in time.
  std::optional<binding::ReferenceReply> ask(const std::string& binding_subarchitecture,
                                             binding::ReferenceRequest request) {
    if (this->now() < no_binding_until_)
      return std::nullopt;
    try {
      request.known_ontology = known_ontology_;
      auto reply = this->template call<binding::ReferenceRequest, binding::ReferenceReply>(
        binding_subarchitecture, std::move(request),
        {.timeout = std::chrono::seconds{3}, .retries = 5});
      if (reply.ontology) {
        vocabulary_ = std::make_shared<const Vocabulary>(
          this->lexicon(), std::make_shared<const Ontology>(reply.ontology->statements));
        known_ontology_ = reply.ontology_version;
      }
      return reply;
    } catch (const UnknownSubarchitectureException&) {
      this->debug("there is no binding in this system");
      // To find that out takes a while, and a move has several questions.
      no_binding_until_ = this->now() + std::chrono::seconds{5};
    } catch (const PermissionException& e) {
      this->warning("binding cannot be asked: {}", e.what());
    } catch (const DeadlineException&) {
      this->warning("binding does not answer");
    } catch (const CallException& e) {
      this->warning("binding does not answer: {}", e.what());
    } catch (const WorkingMemoryLostException& e) {
      this->warning("binding does not answer: {}", e.what());
    }
    return std::nullopt;
  }

  /// What words stand for, by binding's last answer; asks it if there was none.
  const std::shared_ptr<const Vocabulary>& vocabulary(const std::string& binding_subarchitecture) {
    if (known_ontology_ == 0)
      ask(binding_subarchitecture, {});
    if (!vocabulary_)
      vocabulary_ =
        std::make_shared<const Vocabulary>(this->lexicon(), std::make_shared<const Ontology>());
    return vocabulary_;
  }

  /// Returns `f(scene)`, repeated until binding has answered all questions that `f` adds to the
  /// scene.
  template <class F>
  auto with_scene(const std::string& binding_subarchitecture, F f) {
    return with_knowledge(
      vocabulary(binding_subarchitecture),
      [&](const binding::ReferenceRequest& request) {
        auto reply = ask(binding_subarchitecture, request);
        return reply ? std::move(*reply) : unknown_reply(request.descriptions.size());
      },
      std::move(f));
  }

  /// As who moves things knows them. Nothing if nobody does.
  /// @param table the subarchitecture with a TableExecutor; empty if there is none
  RenamedThings renamed_things(const std::string& table,
                               const std::string& binding_subarchitecture) {
    RenamedThings result;
    if (table.empty())
      return result;
    for (const auto& known : this->template read_all_in<planning::RememberedTable>(table, 1))
      for (const auto& x : known->things) {
        auto names = x.former_proxies;
        names.push_back(x.proxy);
        names.push_back(planning::hidden_proxy(x.name));
        const auto now = this->exists(Address{binding_subarchitecture, x.proxy})
                           ? x.proxy
                           : planning::hidden_proxy(x.name);
        for (const auto& name : names)
          if (name != now)
            result.insert_or_assign(name, now);
      }
    return result;
  }

private:
  static binding::ReferenceReply unknown_reply(std::size_t questions) {
    binding::ReferenceReply reply;
    reply.referents.resize(questions);
    return reply;
  }

  std::shared_ptr<const Vocabulary> vocabulary_;
  /// Version of the vocabulary's ontology; 0 if binding has not answered yet.
  std::uint64_t known_ontology_ = 0;
  Timestamp no_binding_until_{0};
};

} // namespace castor::communication
