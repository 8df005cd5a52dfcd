#include "castor/actors/component/registry.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/motivation/components/hears_requests.hpp"
#include "castor/planning/motivation/table_goals.hpp"
#include "castor/planning/tabletop/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;
using communication::DialogueMove;
using communication::DialogueMoveType;
using communication::MoveReferents;

/// Makes a motive of each step of what people ask to do with things on a table, when the one before
/// is done. Stops, pauses and resumes the arm at once.
class TableMotives final : public HearsRequests {
  void start() override {
    resume();
    on_change(overwritten<Motive>(), [](const ChangeEvent&) {});
    follow_requests();
  }

  /// A predecessor may have left steps, one of them under way.
  void resume() {
    const auto entry = here(requested_steps);
    if (!exists(entry))
      return;
    known_ = told_ = *read<RequestedSteps>(entry);
    if (!known_.motive.id.empty() && !exists(known_.motive)) {
      known_.waiting.insert(known_.waiting.begin(), known_.current);
      known_.motive = {};
    }
  }

  /// For a successor.
  void remember() {
    if (known_ == told_)
      return;
    put(here(requested_steps), known_);
    told_ = known_;
  }

  void arrived(const Address& referents) override { arrived_.push_back(referents); }

  void run() override {
    while (is_running()) {
      while (!arrived_.empty()) {
        const auto address = arrived_.front();
        arrived_.pop_front();
        hear(address);
      }
      go_on();
      remember();
      wait_for_changes();
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

  void heard(const MoveReferents& referents, const DialogueMove& move) override {
    if (referents.asks_whether_possible)
      return answer(referents);
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
        known_.waiting.push_back({referents.move, x});
    remember();
  }

  void end(const EntryPointer<DialogueMove>& move) {
    known_.waiting.clear();
    if (!known_.motive.id.empty())
      try {
        delete_entry(known_.motive);
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
      }
    known_.motive = {};
    remember();
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
    const auto& move = known_.current.move;
    if (!known_.motive.id.empty())
      try {
        const auto motive = read<Motive>(known_.motive);
        if (motive->status == MotiveStatus::completed) {
          const bool was_so = !motive->history.back().why.empty();
          reply(move, was_so ? MotiveReply::already_so : MotiveReply::done,
                was_so ? "It is so already." : known_.result);
        } else if (motive->status == MotiveStatus::rejected ||
                   motive->status == MotiveStatus::dropped) {
          const auto [reason, help] = problem(*motive);
          reply(move, MotiveReply::impossible,
                explained(motive->words, reason) + (help.empty() ? "" : ' ' + help));
          drop_steps_of(move);
        } else {
          return;
        }
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
        reply(move, MotiveReply::impossible, "I do not know any more what I was doing.");
        drop_steps_of(move);
      }
    known_.motive = {};
    while (known_.motive.id.empty() && !known_.waiting.empty()) {
      known_.current = std::move(known_.waiting.front());
      known_.waiting.erase(known_.waiting.begin());
      begin(known_.current);
    }
  }

  void drop_steps_of(const EntryPointer<DialogueMove>& move) {
    std::erase_if(known_.waiting,
                  [&](const RequestedStep& x) { return x.move.address == move.address; });
  }

  /// Why a step of a plan could not be done, or there was no plan.
  TableProblem problem(const Motive& motive) {
    try {
      if (const auto told = read<TableProblem>({table_, table_problem}); !told->reason.empty())
        return *told;
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
    return {motive.history.back().why, {}};
  }

  void begin(const RequestedStep& step) {
    auto asked = goal_of({step.what, true});
    if (!asked.refusal.empty())
      return reply(step.move, MotiveReply::impossible, asked.refusal);
    Motive motive;
    motive.kind = "table";
    motive.goal = std::move(asked.goal);
    motive.words = std::move(asked.words);
    known_.result = std::move(asked.result);
    motive.because = speaker_.get() + " said '" + words_of(*follow(step.move)) + "'";
    // Who asked is told here, by what is seen, so that nobody is named as the asker.
    motive.cause = step.move;
    motive.resources = {"arm"};
    reply(step.move, MotiveReply::accepted, "I will " + motive.words + '.');
    known_.motive = here(new_id());
    // First, so that a successor knows what it is for.
    remember();
    add(known_.motive, std::move(motive));
  }

  Option<SubarchitectureName> table_{this, "table", "table",
                                     "the subarchitecture with a TableExecutor"};
  Option<SubarchitectureName> manipulation_{this, "manipulation", "manipulation",
                                            "the subarchitecture with an ArmExecutor"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 10s,
                                              "how long it waits for the arm and for a goal"};

  std::deque<Address> arrived_;
  RequestedSteps known_;
  /// As it was written last.
  RequestedSteps told_;
};

CASTOR_COMPONENT(TableMotives, "makes motives of what people ask to do with things on a table")

} // namespace

} // namespace castor::planning
