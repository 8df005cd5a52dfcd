#include "castor/actors/component/registry.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/motivation/components/hears_requests.hpp"
#include "castor/planning/motivation/table_goals.hpp"
#include "castor/planning/tabletop/refusals.hpp"
#include "castor/planning/tabletop/request_queue.hpp"
#include "castor/planning/tabletop/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <cctype>
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

constexpr const char* what_an_arm_can_do =
  "I can take things, give them to you, put them somewhere, push, stack, sort and swap them.";

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
    told_ = *read<RequestedSteps>(entry);
    queue_.recall(told_, !told_.motive.id.empty() && exists(told_.motive));
  }

  /// For a successor.
  void remember() {
    if (queue_.steps() == told_)
      return;
    tell_what_waits();
    put(here(requested_steps), queue_.steps());
    told_ = queue_.steps();
  }

  /// What will be done later, for whoever is asked.
  void tell_what_waits() {
    RequestsWaiting waiting;
    for (const auto& x : queue_.steps().waiting)
      waiting.because.push_back(reason_of(x));
    put(here(requests_waiting), std::move(waiting));
  }

  std::string reason_of(const RequestedStep& step) {
    const auto said =
      step.agrees_to ? words_of(*follow(*step.agrees_to)) : words_of(*follow(step.move));
    return speaker_.get() + " said '" + said + "'";
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
      return {"I do not see what is on the table now.", {}, {}, {}, {}, true};
    }
  }

  void heard(const MoveReferents& referents, const DialogueMove& move) override {
    if (referents.asks_whether_possible)
      return answer(referents);
    if (referents.steps.empty() && move.type == DialogueMoveType::action_directive)
      reply(referents.move, MotiveReply::impossible,
            std::string{"I do not know how to do that. "} + what_an_arm_can_do);
    std::vector<RequestedStep> steps;
    bool waits_first = false;
    for (const auto& x : referents.steps)
      if (x.action == "Stop" && steps.empty())
        end(referents.move);
      else if (x.action == "Wait" && steps.empty()) {
        pause_arm(referents.move);
        waits_first = true;
      } else if (x.action == "Wait" || x.action == "Stop")
        debug("after the last step it waits anyway"); // "Take the ball and wait."
      else if (x.action == "GoOn")
        resume_arm(referents.move, referents.steps.size() == 1);
      else if (is_question(x.action) || x.action == "Note") {
        auto answered = goal_of({x, true});
        reply(referents.move, MotiveReply::done, std::move(answered.refusal),
              std::move(answered.things));
      } else if (x.action == "Forbid" || x.action == "Allow")
        restrain(referents.move, x);
      else
        steps.push_back({referents.move, x, referents.agrees_to});
    if (steps.empty())
      return tell_end_of(referents.move, true);
    steps = without_needless_moves(std::move(steps));
    const bool has_to_wait = (queue_.is_busy() || !queue_.steps().waiting.empty()) &&
                             !referents.corrects && !referents.comes_first;
    withdraw(queue_.add(steps, referents));
    // What is to be done now ends the waiting: "Wait. - Give me the ball." "Wait, and then give me
    // the ball" does not.
    if (!has_to_wait && !waits_first && queue_.resume())
      perform(manipulation_, manipulation::ResumeArm{}).wait(patience_.get());
    if (!queue_.has_steps_of(referents.move.address)) {
      reply(referents.move, MotiveReply::accepted, "I am about to do that.");
      tell_end_of(referents.move, true);
    } else if (has_to_wait)
      reply(referents.move, MotiveReply::accepted, "I will do that then.");
    remember();
  }

  /// Something is not to be touched, or may be again. What is done with it now ends.
  void restrain(const EntryPointer<DialogueMove>& move, const communication::DirectiveStep& step) {
    const auto& busy_with = queue_.steps().current.what.things;
    const bool is_busy_with_it = step.action == "Forbid" && queue_.is_busy() &&
                                 std::ranges::any_of(step.things, [&](const std::string& x) {
                                   return std::ranges::find(busy_with, x) != busy_with.end();
                                 });
    if (is_busy_with_it)
      end(move);
    const auto told = goal_of({step, true});
    // Nothing has to be said of what was not forbidden.
    if (step.by == communication::by_the_way && told.things.empty())
      return;
    reply(move, told.things.empty() ? MotiveReply::impossible : MotiveReply::done, told.refusal);
  }

  void end(const EntryPointer<DialogueMove>& move) {
    withdraw(queue_.stop());
    remember();
    command(move, manipulation::StopArm{}, "I have stopped.");
  }

  void pause_arm(const EntryPointer<DialogueMove>& move) {
    queue_.pause();
    remember();
    command(move, manipulation::PauseArm{}, "I wait.");
  }

  /// @param is_alone whether nothing else is asked for: "go on and put it down"
  void resume_arm(const EntryPointer<DialogueMove>& move, bool is_alone) {
    const bool was_paused = queue_.resume();
    if (!queue_.go_on() && !was_paused) {
      if (is_alone)
        reply(move, MotiveReply::impossible, "I have nothing to go on with.");
      return;
    }
    remember();
    const bool has_something_to_do = queue_.is_busy() || !queue_.steps().waiting.empty();
    command(move, manipulation::ResumeArm{},
            has_something_to_do || !is_alone ? "I go on."
                                             : "I do not wait any more, and have nothing to do.");
  }

  /// The arm ends what it does for it.
  void withdraw(const Address& motive) {
    if (!motive.id.empty() && exists(motive))
      delete_entry(motive);
  }

  template <class T>
  void command(const EntryPointer<DialogueMove>& move, T what, const std::string& words) {
    const auto end = perform(manipulation_, std::move(what)).wait(patience_.get());
    const bool is_done = end.outcome == ActionOutcome::succeeded;
    reply(move, is_done ? MotiveReply::done : MotiveReply::impossible,
          is_done ? words : "The arm does not do that: " + end.reason + '.');
  }

  void reply(const EntryPointer<DialogueMove>& move, MotiveReply kind, std::string words,
             std::vector<std::string> things = {}) {
    add(MotiveAcknowledgement{{}, speaker_, move, kind, std::move(words), std::move(things)},
        {.time_to_live = 10min});
  }

  /// Unless another step of the request is left.
  void tell_end_of(const EntryPointer<DialogueMove>& move, bool is_done) {
    if (!queue_.has_steps_of(move.address))
      add(RequestEnded{move, is_done}, {.time_to_live = 10min});
  }

  /// The next step, when the one before is done.
  void go_on() {
    if (queue_.is_busy() && !is_over())
      return;
    while (const auto* next = queue_.next())
      begin(RequestedStep{*next});
  }

  /// Whether the current step is over, and if so, what became of it is said.
  bool is_over() {
    const auto& known = queue_.steps();
    const auto move = known.current.move;
    bool is_half_done = false;
    std::string words;
    try {
      const auto motive = read<Motive>(known.motive);
      if (motive->status == MotiveStatus::completed) {
        const bool was_so = !motive->history.back().why.empty();
        reply(move, was_so ? MotiveReply::already_so : MotiveReply::done,
              was_so ? "It is so already." : known.result);
        queue_.done(was_so);
        tell_end_of(move, true);
        return true;
      }
      if (motive->status != MotiveStatus::rejected && motive->status != MotiveStatus::dropped)
        return false;
      const auto why = problem(*motive);
      words = explained(motive->words, why.reason);
      if (queue_.try_again(why.has_begun)) {
        reply(move, MotiveReply::impossible, std::move(words));
        return true;
      }
      words += why.help.empty() ? "" : ' ' + why.help;
      is_half_done = why.has_begun && known.current.what.action == "Swap";
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
      words = "I do not know any more what I was doing.";
    }
    give_up(move, std::move(words), is_half_done);
    return true;
  }

  /// What depends on the current step is not done either.
  /// @param why a sentence
  void give_up(const EntryPointer<DialogueMove>& move, std::string why, bool undoes = false) {
    if (queue_.give_up(undoes))
      why += " I leave out what comes after that.";
    reply(move, MotiveReply::impossible, std::move(why));
    tell_end_of(move, false);
  }

  /// Why a step of a plan could not be done, or there was no plan.
  TableProblem problem(const Motive& motive) {
    try {
      if (const auto told = read<TableProblem>({table_, table_problem}); !told->reason.empty())
        return *told;
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
    const auto why = explanation_of_planning(motive.history.back().why);
    return {why.reason, why.help, false};
  }

  /// So that the robot can be asked why it did not do it.
  void note_refusal(const RequestedStep& step, std::string refusal) {
    refusal.pop_back();
    if (!refusal.starts_with("I "))
      refusal[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(refusal[0])));
    Motive motive;
    motive.kind = "table";
    motive.words = "do what " + speaker_.get() + " asked for";
    motive.because = reason_of(step);
    motive.cause = step.move;
    motive.status = MotiveStatus::rejected;
    motive.history = {{now().count(), MotiveStatus::rejected, std::move(refusal)}};
    add(std::move(motive));
  }

  void begin(const RequestedStep& step) {
    auto asked = goal_of({step.what, true, reason_of(step)});
    if (!asked.refusal.empty() && !asked.is_impossible) {
      reply(step.move, MotiveReply::done, std::move(asked.refusal), std::move(asked.things));
      return tell_end_of(step.move, true);
    }
    if (!asked.refusal.empty()) {
      note_refusal(step, asked.refusal);
      return give_up(step.move, asked.refusal);
    }
    Motive motive;
    motive.kind = "table";
    motive.goal = std::move(asked.goal);
    motive.words = std::move(asked.words);
    motive.because = reason_of(step);
    // Who asked is told here, by what is seen, so that nobody is named as the asker.
    motive.cause = step.move;
    motive.resources = {"arm"};
    reply(step.move, MotiveReply::accepted, "I will " + motive.words + '.', asked.things);
    const auto address = here(new_id());
    queue_.begin(address, std::move(asked.result), std::move(asked.things));
    // First, so that a successor knows what it is for.
    remember();
    add(address, std::move(motive));
  }

  Option<SubarchitectureName> table_{this, "table", "table",
                                     "the subarchitecture with a TableExecutor"};
  Option<SubarchitectureName> manipulation_{this, "manipulation", "manipulation",
                                            "the subarchitecture with an ArmExecutor"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 10s,
                                              "how long it waits for the arm and for a goal"};

  std::deque<Address> arrived_;
  RequestQueue queue_;
  /// As they were written last.
  RequestedSteps told_;
};

CASTOR_COMPONENT(TableMotives, "makes motives of what people ask to do with things on a table")

} // namespace

} // namespace castor::planning
