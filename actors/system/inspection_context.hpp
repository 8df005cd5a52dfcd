#pragma once

#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/system/inspection_json.hpp"
#include "castor/actors/system/inspection_protocol.hpp"
#include "castor/actors/system/known_names.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <caf/event_based_actor.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

/// Context that the requests of an inspection share.
namespace castor {

/// How long processes may take to answer.
inline constexpr std::chrono::seconds inspection_patience{2};

/// Byte fields are shown up to this length, unless the request is for all.
inline constexpr std::size_t shown_bytes = 64;

/// Most bytes of a byte field to show for the request.
inline std::size_t bytes_shown(const Json& request) {
  return request.value("full", false) ? std::numeric_limits<std::size_t>::max() : shown_bytes;
}

/// An invalid request, or one that comes too early.
class InspectionError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// One request: the actor that answers it, and functions for answers.
class InspectionContext : public std::enable_shared_from_this<InspectionContext> {
public:
  InspectionContext(caf::event_based_actor* actor, InspectionParts x)
    : self(actor), parts(std::move(x)) {}

  void send(std::string text, bool last = false);
  /// The whole answer.
  void answer(const Json& x) { send(as_line(x), true); }
  void refuse(const std::string& why) { answer({{"error", why}}); }

  /// Calls `f`; answers with the error if it throws.
  template <class F>
  void guarded(F&& f) {
    try {
      f();
    } catch (const Json::exception& e) {
      refuse(std::string{"the request cannot be read: "} + e.what());
    } catch (const std::exception& e) {
      refuse(e.what());
    }
  }

  /// Sends a request to a working memory on behalf of a client, and logs the operation if
  /// operations are logged. Calls `answered` with the outcome, or `failed` if there is none.
  template <class Reply, class Request, class Answered, class Failed>
  void ask(const WorkingMemoryActor& wm, const ClientPtr& client, const Request& request,
           Answered answered, Failed failed) {
    std::shared_ptr<OperationRecorder> recorder;
    if (parts.operations) {
      recorder = std::make_shared<OperationRecorder>(*parts.operations, client);
      recorder->sent(0, recorder->begin(request));
    }
    self->request(wm, inspection_patience, request)
      .then(
        // The log has to outlive the recorder.
        [recorder, answered, log = parts.operations](const Outcome<Reply>& x) {
          if (recorder)
            recorder->end(0, x);
          answered(x);
        },
        [failed](const caf::error&) { failed(); });
  }

  /// Throws InspectionError.
  const WorkingMemoryActor& working_memory(const std::string& name) const;

  /// Calls `f` with the entry types that the processes of the system know.
  void with_types(std::function<void(TypeCatalogue)> f);

  /// All names that a filter may use.
  KnownNames known_names(TypeCatalogue types) const;

  caf::event_based_actor* self;
  InspectionParts parts;
  /// Called with every change event, if the request has subscribed to some.
  std::function<void(const ChangeEventPtr&)> on_event;

private:
  void with_known_types(std::function<void(TypeCatalogue)> f);
};

using InspectionContextPtr = std::shared_ptr<InspectionContext>;

} // namespace castor
