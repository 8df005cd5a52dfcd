#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/motivation/table_goals.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/planning/tabletop/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;
using communication::DialogueMove;
using communication::DialogueMoveType;
using communication::DirectiveStep;
using communication::MoveReferents;

/// Makes a motive of each step of what people ask to do with things on a table, when the one before
/// is done. Stops, pauses and resumes the arm at once.
class TableMotives final : public ManagedComponent {
  struct Step {
    EntryPointer<DialogueMove> move;
    DirectiveStep what;
  };

  void start() override {
    on_change(added<MoveReferents>().in(communication_),
              [this](const ChangeEvent& event) { arrived_.push_back(event.address); });
    on_change(overwritten<Motive>(), [](const ChangeEvent&) {});
    try {
      heard_ = read<RequestsHeard>(heard_address())->turn;
    } catch (const DoesNotExistOnWM&) {
      add(heard_address(), RequestsHeard{});
    }
    // What a predecessor did not get to.
    auto all = read_all_in<MoveReferents>(communication_);
    std::ranges::sort(all, {}, [](const auto& x) { return x->turn; });
    for (const auto& x : all)
      arrived_.push_back(x.address);
  }

  void run() override {
    while (is_running()) {
      while (!arrived_.empty()) {
        const auto address = arrived_.front();
        arrived_.pop_front();
        hear(address);
      }
      go_on();
      wait_for_changes();
    }
  }

  Address heard_address() const { return here("requests that " + component_name() + " has heard"); }

  void hear(const Address& address) {
    try {
      const auto referents = read<MoveReferents>(address);
      if (referents->turn <= heard_)
        return;
      const auto move = follow(referents->move);
      if (move->problem.empty() && !referents->is_unclear) {
        if (referents->asks_whether_possible)
          answer(*referents);
        else
          hear(*referents, *move);
      }
      heard_ = referents->turn;
      put(heard_address(), RequestsHeard{heard_});
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  /// Whether it can do what it is asked about; it does nothing.
  void answer(const MoveReferents& referents) {
    for (const auto& x : referents.steps)
      if (const auto asked = goal_of({x, false}); !asked.refusal.empty())
        return reply(referents.move, MotiveReply::impossible, asked.refusal);
    if (!referents.steps.empty())
      reply(referents.move, MotiveReply::done, "Yes, I think so.");
  }

  TableGoalReply goal_of(TableGoalRequest request) {
    try {
      return call<TableGoalRequest, TableGoalReply>(table_, std::move(request),
                                                    {.timeout = patience_.get()});
    } catch (const WorkingMemoryException& e) {
      warning("{}", e.what());
      return {"I do not see what is on the table now.", {}, {}, {}};
    }
  }

  void hear(const MoveReferents& referents, const DialogueMove& move) {
    if (referents.steps.empty() && move.type == DialogueMoveType::action_directive)
      reply(referents.move, MotiveReply::impossible, "I do not know how to do that.");
    for (const auto& x : referents.steps)
      if (x.action == "Stop")
        end(referents.move);
      else if (x.action == "Wait")
        command(referents.move, manipulation::PauseArm{}, "I wait.");
      else if (x.action == "GoOn")
        command(referents.move, manipulation::ResumeArm{}, "I go on.");
      else
        steps_.push_back({referents.move, x});
  }

  void end(const EntryPointer<DialogueMove>& move) {
    steps_.clear();
    if (!motive_.id.empty())
      try {
        delete_entry(motive_);
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
      }
    motive_ = {};
    command(move, manipulation::StopArm{}, "I have stopped.");
  }

  template <class T>
  void command(const EntryPointer<DialogueMove>& move, T what, const std::string& words) {
    const auto end = perform(manipulation_, std::move(what)).wait(patience_.get());
    const bool is_done = end.outcome == ActionOutcome::succeeded;
    reply(move, is_done ? MotiveReply::done : MotiveReply::impossible,
          is_done ? words : "The arm does not do that: " + end.reason + '.');
  }

  void reply(const EntryPointer<DialogueMove>& move, MotiveReply kind, std::string words) {
    add(MotiveAcknowledgement{{}, speaker_, move, kind, std::move(words)}, {.time_to_live = 10min});
  }

  /// The next step, when the one before is done. What comes after one that is not done is not done
  /// either.
  void go_on() {
    if (!motive_.id.empty())
      try {
        const auto motive = read<Motive>(motive_);
        if (motive->status == MotiveStatus::completed) {
          const bool was_so = !motive->history.back().why.empty();
          reply(step_.move, was_so ? MotiveReply::already_so : MotiveReply::done,
                was_so ? "It is so already." : result_);
        } else if (motive->status == MotiveStatus::rejected ||
                   motive->status == MotiveStatus::dropped) {
          reply(step_.move, MotiveReply::impossible, explained(motive->words, problem(*motive)));
          std::erase_if(steps_, [&](const Step& x) { return x.move.address == step_.move.address; });
        } else {
          return;
        }
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
      }
    motive_ = {};
    while (motive_.id.empty() && !steps_.empty()) {
      step_ = std::move(steps_.front());
      steps_.pop_front();
      begin(step_);
    }
  }

  /// Why the last step of a plan failed, or there was no plan.
  std::string problem(const Motive& motive) {
    try {
      if (const auto told = read<TableProblem>({table_, table_problem}); !told->reason.empty())
        return told->reason;
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
    return motive.history.back().why;
  }

  void begin(const Step& step) {
    auto asked = goal_of({step.what, true});
    if (!asked.refusal.empty())
      return reply(step.move, MotiveReply::impossible, asked.refusal);
    Motive motive;
    motive.kind = "table";
    motive.goal = std::move(asked.goal);
    motive.words = std::move(asked.words);
    result_ = std::move(asked.result);
    motive.because = speaker_.get() + " said '" + said(step.move) + "'";
    // Who asked is told here, by what is seen, so that nobody is named as the asker.
    motive.cause = step.move;
    motive.resources = {"arm"};
    reply(step.move, MotiveReply::accepted, "I will " + motive.words + '.');
    motive_ = add(std::move(motive));
  }

  std::string said(const EntryPointer<DialogueMove>& move) {
    auto text = follow(follow(move)->utterance)->word_sequence;
    while (text.ends_with('.') || text.ends_with('!') || text.ends_with('?'))
      text.pop_back();
    return text;
  }

  Option<SubarchitectureName> communication_{this, "communication", "communication",
                                             "the subarchitecture that hears requests"};
  Option<SubarchitectureName> table_{this, "table", "table",
                                     "the subarchitecture with a TableExecutor"};
  Option<SubarchitectureName> manipulation_{this, "manipulation", "manipulation",
                                            "the subarchitecture with an ArmExecutor"};
  Option<std::string> speaker_{this, "speaker", "you", "who speaks, as the robot calls them"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 10s,
                                              "how long it waits for the arm and for a goal"};

  std::deque<Address> arrived_;
  std::deque<Step> steps_;
  /// The step that is done now, its motive, and what to say when it is done.
  Step step_;
  Address motive_;
  std::string result_;
  /// Turn of the last move that was looked at.
  std::int32_t heard_ = -1;
};

CASTOR_COMPONENT(TableMotives, "makes motives of what people ask to do with things on a table")

} // namespace

} // namespace castor::planning
