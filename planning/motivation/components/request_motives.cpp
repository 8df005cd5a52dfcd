#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/motivation/motive_file.hpp"
#include "castor/planning/motivation/request_values.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
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
class RequestMotives final : public ManagedComponent {
  void configure() override { templates_ = load_motives(file_); }

  void start() override {
    on_change(added<MoveReferents>().in(communication_),
              [this](const ChangeEvent& event) { look(event.address); });
    try {
      heard_ = read<RequestsHeard>(heard_address())->turn;
    } catch (const DoesNotExistOnWM&) {
      add(heard_address(), RequestsHeard{});
    }
    // What a predecessor did not get to.
    auto all = read_all_in<MoveReferents>(communication_);
    std::ranges::sort(all, {}, [](const auto& x) { return x->turn; });
    for (const auto& x : all)
      look(x.address);
  }

  Address heard_address() const { return here("requests that " + component_name() + " has heard"); }

  void look(const Address& address) {
    try {
      const auto referents = read<MoveReferents>(address);
      if (referents->turn <= heard_)
        return;
      const auto move = follow(referents->move);
      if (move->problem.empty() && !referents->is_unclear)
        request(referents->move, *move, *referents);
      heard_ = referents->turn;
      put(heard_address(), RequestsHeard{heard_});
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  void request(const EntryPointer<DialogueMove>& pointer, const DialogueMove& move,
               const MoveReferents& referents) {
    const auto occasion = occasion_of(move, referents);
    const bool is_request = move.type == DialogueMoveType::action_directive;
    if (occasion.empty() && !is_request)
      return;
    auto text = follow(move.utterance)->word_sequence;
    while (text.ends_with('.') || text.ends_with('!') || text.ends_with('?'))
      text.pop_back();
    const auto values = values_of_request(move, referents, speaker_, text);
    std::optional<Motive> motive;
    for (const auto& x : templates_)
      if (!motive && !x.on.empty() && x.on == occasion)
        motive = make_motive(x, values);
    const auto id = pointer.address.id;
    try {
      if (motive) {
        motive->asker = speaker_;
        motive->cause = pointer;
        add(here("motive of " + id), std::move(*motive));
      } else if (is_request) {
        add(here("refusal of " + id),
            MotiveAcknowledgement{
              {}, speaker_, pointer, MotiveReply::impossible, "I do not know how to do that."},
            {.time_to_live = 10min});
      }
    } catch (const AlreadyExistsOnWM&) {
      trace("{} was proposed before", id);
    }
  }

  Option<std::string> file_{this, "motives", "", "file of motives"};
  Option<SubarchitectureName> communication_{this, "communication", "communication",
                                             "the subarchitecture that hears requests"};
  Option<std::string> speaker_{this, "speaker", "you", "who speaks, as the robot calls them"};

  std::vector<MotiveTemplate> templates_;
  /// Turn of the last move that was looked at.
  std::int32_t heard_ = -1;
};

CASTOR_COMPONENT(RequestMotives, "makes motives of what people ask for")

} // namespace

} // namespace castor::planning
