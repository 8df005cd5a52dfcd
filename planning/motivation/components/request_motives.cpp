#include "castor/actors/component/registry.hpp"
#include "castor/planning/motivation/components/hears_requests.hpp"
#include "castor/planning/motivation/motive_file.hpp"
#include "castor/planning/motivation/request_values.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;
using communication::DialogueMove;
using communication::DialogueMoveType;
using communication::MoveReferents;

/// Makes motives of what people say: of requests, and of questions and statements that templates
/// name.
class RequestMotives final : public HearsRequests {
  void configure() override { templates_ = load_motives(file_); }

  void start() override { follow_requests(); }

  void heard(const MoveReferents& referents, const DialogueMove& move) override {
    const auto occasion = occasion_of(move, referents);
    const bool is_request = move.type == DialogueMoveType::action_directive;
    if (occasion.empty() && !is_request)
      return;
    const auto values = values_of_request(move, referents, speaker_, words_of(move));
    std::optional<Motive> motive;
    for (const auto& x : templates_)
      if (!motive && !x.on.empty() && x.on == occasion)
        motive = make_motive(x, values);
    const auto id = referents.move.address.id;
    try {
      if (motive) {
        motive->asker = speaker_;
        motive->cause = referents.move;
        add(here("motive of " + id), std::move(*motive));
      } else if (is_request) {
        add(
          here("refusal of " + id),
          MotiveAcknowledgement{
            {}, speaker_, referents.move, MotiveReply::impossible, "I do not know how to do that."},
          {.time_to_live = 10min});
      }
    } catch (const AlreadyExistsOnWM&) {
      trace("{} was proposed before", id);
    }
  }

  Option<std::string> file_{this, "motives", "", "file of motives"};

  std::vector<MotiveTemplate> templates_;
};

CASTOR_COMPONENT(RequestMotives, "makes motives of what people ask for")

} // namespace

} // namespace castor::planning
