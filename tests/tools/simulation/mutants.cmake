# Systems that are wrong on purpose, to see that the simulation of whole systems notices; for
# scripts/mutation-check, with those of tests/tools/linearizability.

# castor_system_mutant(<name> <source> FROM <text> TO <text>)
#
# castor_mutant_system_<name>, a `castor_system_simulation`, which is `castor simulate`, in which <text> says something else.
function(castor_system_mutant name source)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "FROM;TO" "")
  castor_add_mutant(system_${name} ${source} FROM "${ARG_FROM}" TO "${ARG_TO}"
    SOURCES $<TARGET_OBJECTS:castor_system_simulation>
    DEPENDS castor_simulator CAF::io spdlog::spdlog CLI11::CLI11 fmt::fmt)
endfunction()

# -- supervision

castor_system_mutant(failures_are_left actors/supervision/supervision_tree.cpp
  FROM "result.start = result.stop;"
  TO "")

castor_system_mutant(restarts_forget_dependents actors/supervision/supervision_tree.cpp
  FROM "if (all || children_.at(x).kind == ComponentKind::managed)"
  TO "if (false)")

castor_system_mutant(nodes_that_return_stay_empty actors/supervision/supervisor.cpp
  FROM "if (auto awaited = failover_.take_awaited(x.peer)) {"
  TO "if (auto awaited = failover_.take_awaited(ProcessNumber(x.peer + 100))) {")

castor_system_mutant(lives_are_not_counted actors/supervision/system_model.cpp
  FROM "++children_.at(name).incarnation;"
  TO "children_.at(name).incarnation = 2;")

castor_system_mutant(early_ends_are_missed actors/supervision/transition_scheduler.cpp
  FROM "if (i->step() == Step::make)
      i->add_failure(x);"
  TO "")

castor_system_mutant(waiting_transitions_lose_their_patience actors/supervision/transition_scheduler.cpp
  FROM "begun->restart_turn(driver_.now());"
  TO "")

castor_system_mutant(nobody_is_asked_again actors/supervision/transition_scheduler.cpp
  FROM "(x.is_commanded() && !driver_.is_replaced(*name))"
  TO "x.is_commanded()")

castor_system_mutant(the_awaited_are_made_early actors/supervision/system_model.cpp
  FROM "if (failover_.is_between_processes(name))"
  TO "if (false)")

castor_system_mutant(memories_throw wm/memory/lease_service.cpp
  FROM "if (table_.unlock(address.id, *client, token, now))"
  TO "if (token % 50 == 7)
    throw std::runtime_error{\"out of order\"};
  if (table_.unlock(address.id, *client, token, now))")

# -- filters and leases

castor_system_mutant(new_memories_do_not_know_filters wm/memory/event_dispatcher.cpp
  FROM "if (!peers_.is_concerned(peer, filter))
        return;
      ++pending->missing;"
  TO "if (true)
        return;
      ++pending->missing;")

castor_system_mutant(the_dead_keep_their_leases wm/memory/lease_service.cpp
  FROM "table_.drop(client, now);"
  TO "static_cast<void>(now);")

castor_system_mutant(memories_count_from_the_start wm/memory/working_memory_shell.cpp
  FROM "return (options.incarnation - 1) * numbers_per_life;"
  TO "return 0 * options.incarnation;")

# -- links

castor_system_mutant(resumed_sessions_send_all_again actors/link/session.cpp
  FROM "acknowledge(received_by_peer);
  rewritten_ = 0;"
  TO "rewritten_ = 0;")

castor_system_mutant(messages_are_lost_with_a_connection actors/link/session.cpp
  FROM "acknowledge(received_by_peer);
  rewritten_ = 0;"
  TO "")

castor_system_mutant(half_deaf_links_go_on actors/link/link_end.cpp
  FROM "discarding_input_ = discarding_input_ || is_silent();
  if (discarding_input_)
    return;"
  TO "if (is_silent()) {
    discarding_input_ = true;
    return;
  }")

castor_system_mutant(late_connections_are_taken actors/node/memberships.cpp
  FROM "(x.known != 0 && x.known != self.incarnation) || x.receiver < self.process"
  TO "false")

castor_system_mutant(requests_to_the_lost_stay_open actors/link/mesh.cpp
  FROM "for (auto& x : unanswered)
    reply_receiver_down(x.sender, x.id);"
  TO "")

castor_system_mutant(ends_are_not_told actors/link/actor_names.cpp
  FROM "port->tell_end(name);"
  TO "(void)port;")

castor_system_mutant(stale_values_are_referred_to actors/link/kept_contents.cpp
  FROM "auto i = by_value_.find(x.weak());"
  TO "static std::map<std::pair<SentContents*, std::string>, std::weak_ptr<const void>> firsts;
  auto& first = firsts[{this, x.type_name()}];
  auto i = by_value_.find(first);
  if (i == by_value_.end())
    i = by_value_.find(first = x.weak());")

# -- journals

castor_system_mutant(unsynced_changes_are_told wm/memory/journal_outbox.cpp
  FROM "    return {options.most_unsynced, options.most_unsynced_bytes};
  return {};"
  TO "    return {options.most_unsynced, options.most_unsynced_bytes};
  return {100, 100'000};")

castor_system_mutant(bounds_of_batched_journals_are_ignored wm/memory/journal_outbox.cpp
  FROM "return {options.most_unsynced, options.most_unsynced_bytes};"
  TO "return {10'000, options.most_unsynced_bytes};")

castor_system_mutant(batched_changes_are_late wm/journal/journal_writer.cpp
  FROM "self_->delayed_send(self_, parts_.delay, SyncAtom::value);"
  TO "self_->delayed_send(self_, 20 * parts_.delay, SyncAtom::value);")

castor_system_mutant(journals_are_not_written wm/journal/journal_writer.cpp
  FROM "parts_.file->append(under_way_);"
  TO "")

castor_system_mutant(journals_forget_deletions wm/journal/journal_image.cpp
  FROM "    entries_.erase(i);
    tombstones_.add(record.id"
  TO "    tombstones_.add(record.id")

castor_system_mutant(sessions_repeat_tokens wm/memory/working_memory_shell.cpp
  FROM "options.opened_journal->session * numbers_per_incarnation"
  TO "numbers_per_incarnation")

castor_system_mutant(journals_bring_back_what_has_ended wm/store/entry_store.cpp
  FROM "    if (ephemeral)
      lifetimes_.orphan(id, now);"
  TO "")

# -- clocks that jump

castor_system_mutant(clocks_jump_twice wm/memory/working_memory_shell.cpp
  FROM "clock_jump_ += by;"
  TO "clock_jump_ += 2 * by;")

# -- tasks

castor_system_mutant(budgets_are_exceeded actors/task_manager/task_schedule.cpp
  FROM "return used + cost <= rules_.budget * (1 + 1e-9);"
  TO "return cost <= rules_.budget * (1 + 1e-9);")

castor_system_mutant(tasks_overtake_their_predecessors actors/task_manager/task_schedule.cpp
  FROM "  if (added.awaited.empty())
    ready_"
  TO "  ready_")

castor_system_mutant(tasks_that_are_over_cost_on actors/task_manager/task_schedule.cpp
  FROM "  running_.erase(id);
  ready_"
  TO "  ready_")

castor_system_mutant(successors_are_forgotten actors/task_manager/task_schedule.cpp
  FROM "        ready_.emplace(place_of(task), y);"
  TO "        static_cast<void>(task);")

castor_system_mutant(retractions_let_nobody_in actors/task_manager/task_schedule.cpp
  FROM "    end(id, End::retracted, out);
    adopt_what_fits(out);"
  TO "    end(id, End::retracted, out);")

# -- calls

castor_system_mutant(calls_are_taken_again wm/store/entry_store.cpp
  FROM "if (life.only_once && tombstones_.contains(address.id))"
  TO "if (false)")

castor_system_mutant(the_dead_leave_their_entries wm/store/lifetimes.cpp
  FROM "    if (lifetime.owner && *lifetime.owner == owner)
      set_due"
  TO "    if (lifetime.owner == nullptr)
      set_due")

castor_system_mutant(calls_outlive_their_working_memory actors/runtime/served_calls.cpp
  FROM "if (call.subarchitecture == subarchitecture)"
  TO "if (call.id == subarchitecture)")
