# Gates for commands, executors of actions and readers of entries that are wrong on purpose, to see
# that their tests notice; for scripts/mutation-check.

# castor_actors_mutant(<name> <source> FROM <text> TO <text>)
#
# castor_mutant_<name>, an `actors_tests` in which <text> says something else.
function(castor_actors_mutant name source)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "FROM;TO" "")
  castor_add_mutant(${name} ${source} FROM "${ARG_FROM}" TO "${ARG_TO}"
    SOURCES $<TARGET_OBJECTS:actors_tests>
    DEPENDS castor::actors rapidcheck_gtest GTest::gmock GTest::gtest_main)
endfunction()

castor_actors_mutant(command_tokens_are_not_looked_at actors/runtime/command_gate.cpp
  FROM "if (!demands_lease() || (is_confirmed(now) && is_holder(x.offer)))"
  TO "if (true)")

castor_actors_mutant(command_former_holders_are_obeyed actors/runtime/command_gate.cpp
  FROM "return confirmed_ && confirmed_->holder && x.token == confirmed_->token &&
         *x.commander == *confirmed_->holder;"
  TO "return confirmed_ && x.token > 0;")

castor_actors_mutant(command_confirmations_never_grow_old actors/runtime/command_gate.cpp
  FROM "return confirmed_ && now < confirmed_->asked + trusted_for;"
  TO "return confirmed_.has_value();")

castor_actors_mutant(command_answers_overtake_each_other actors/runtime/command_gate.cpp
  FROM "if (confirmed_ && x.asked < confirmed_->asked)"
  TO "if (false)")

castor_actors_mutant(command_age_counts_from_arrival actors/runtime/component_commands.cpp
  FROM "from_reading(message.sent)"
  TO "std::max(from_reading(message.sent), Clock::now())")

castor_actors_mutant(command_the_last_command_holds_for_ever actors/runtime/command_gate.cpp
  FROM "if (!cause && now >= in_force_->until)"
  TO "if (false)")

castor_actors_mutant(command_lost_commanders_are_not_noticed actors/runtime/component_commands.cpp
  FROM "obedience.gate.forget(*i->second);"
  TO "{}")

castor_actors_mutant(action_is_accepted_twice actors/runtime/action_executor.cpp
  FROM "if (action.status != ActionStatus::proposed)
      return std::nullopt;"
  TO "{}")

castor_actors_mutant(action_without_a_will actors/runtime/action_executor.cpp
  FROM ".last_will(failed_by_end(action), life_of_outcome)"
  TO "")

castor_actors_mutant(action_of_nobody_goes_on actors/runtime/executed_actions.cpp
  FROM "if (x.what == entry)"
  TO "if (false)")

# Also where the table that was replaced is closed, and the reader has looked for the new one.
castor_actors_mutant(read_cells_outlive_their_working_memory actors/runtime/entry_reader.cpp
  FROM "auto entry = x.entries->read(address.id, std::chrono::steady_clock::now);"
  TO "static thread_local std::map<Address, EntryPtr> cells;
    auto entry = x.entries->read(address.id, std::chrono::steady_clock::now);
    auto& cell = cells[address];
    cell = entry = entry ? entry : cell;")
