#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/binding/types.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

/// A component derived from `Base` that can ask binding for the referents of descriptions.
template <class Base>
class AsksBinding : public Base {
protected:
  /// Calls binding. Nothing if there is no binding, or no answer in time.
  std::optional<binding::ReferenceReply> ask(const std::string& binding_subarchitecture,
                                             std::vector<binding::Description> descriptions) {
    try {
      return this->template call<binding::ReferenceRequest, binding::ReferenceReply>(
        binding_subarchitecture, {std::move(descriptions)},
        {.timeout = std::chrono::seconds{3}, .retries = 5});
    } catch (const UnknownSubarchitectureException&) {
      this->debug("there is no binding in this system");
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

  /// Returns `f(scene)`, repeated until binding has answered all questions that `f` adds to the
  /// scene.
  template <class F>
  auto with_scene(const std::string& binding_subarchitecture, F f) {
    return with_knowledge(
      [&](const std::vector<binding::Description>& asked) {
        auto reply = ask(binding_subarchitecture, asked);
        return reply ? std::move(*reply) : unknown_reply(asked.size());
      },
      std::move(f));
  }

private:
  static binding::ReferenceReply unknown_reply(std::size_t questions) {
    binding::ReferenceReply reply;
    reply.referents.resize(questions);
    return reply;
  }
};

} // namespace castor::communication
