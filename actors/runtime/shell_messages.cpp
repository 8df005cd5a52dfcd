// What a component's shell makes of the messages that arrive.
#include "castor/actors/runtime/shell.hpp"

#include <optional>
#include <utility>

namespace castor {

void ComponentShell::file(caf::mailbox_element_ptr x) {
  auto& content = x->content();
  if (content.match_elements<ChangeNotice>()) {
    file_change(std::move(content.get_mutable_as<ChangeNotice>(0)));
  } else if (content.match_elements<ChangeNotices>()) {
    for (auto& notice : content.get_mutable_as<ChangeNotices>(0).notices)
      file_change(std::move(notice));
  } else if (content.match_elements<LeaseOffer>()) {
    client_.claim(content.get_as<LeaseOffer>(0));
  } else if (content.match_elements<DeadlockProbe>()) {
    client_.receive_probe(content.get_as<DeadlockProbe>(0));
  } else if (content.match_elements<NeighboursPtr>()) {
    set_neighbours(content.get_as<NeighboursPtr>(0));
  } else if (content.match_elements<EnterPhase>()) {
    auto& command = content.get_as<EnterPhase>(0);
    phase_controller_ = command.phase_controller;
    life_.command(command.phase);
  } else if (content.match_elements<ComponentFault>()) {
    faults_.take(content.get_as<ComponentFault>(0), Clock::now());
  } else if (content.match_elements<LookAgain>()) {
    inbox_.put(Inbox::Task{"a wake-up call", [] {}});
  } else if (content.match_elements<caf::exit_msg>()) {
    life_.stop();
  } else if (content.match_elements<caf::down_msg>()) {
    file_down(std::move(x));
  } else if (content.match_elements<PushRequest>()) {
    connections_.handle_push_request(*x, content.get_as<PushRequest>(0));
  } else if (content.match_elements<PushesTaken>()) {
    connections_.taken(x->sender, content.get_as<PushesTaken>(0));
  } else if (content.match_elements<CommandDone>()) {
    commands_.done(content.get_as<CommandDone>(0));
  } else {
    inbox_.put(std::move(x));
  }
}

void ComponentShell::file_down(caf::mailbox_element_ptr x) {
  auto& who = x->content().get_as<caf::down_msg>(0).source;
  if (context_.working_memory() && who == context_.working_memory().address())
    life_.set_working_memory_lost(true);
  else if (tasks_.is_manager())
    inbox_.put(std::move(x)); // in its turn: after the last words of who has ended
  else {
    connections_.forget(who);
    commands_.forget(who);
  }
}

void ComponentShell::file_change(ChangeNotice notice) {
  acknowledge(inbox_.put(std::move(notice)));
}

void ComponentShell::acknowledge(const std::optional<EventsTaken>& x) {
  if (x)
    client_.send(*x);
}

void ComponentShell::set_neighbours(NeighboursPtr neighbours) {
  context_.set_neighbours(std::move(neighbours));
  if (identity().subarchitecture.empty() || context_.working_memory())
    return;
  auto& known = context_.neighbours().working_memories;
  auto home = known.find(identity().subarchitecture);
  // Its node is lost, and it will be started again once that is back.
  life_.set_working_memory_lost(home == known.end());
  if (home == known.end())
    return;
  context_.set_working_memory(home->second);
  monitor(home->second);
}

} // namespace castor
