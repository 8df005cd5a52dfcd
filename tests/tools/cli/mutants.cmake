# Gates for commands that are wrong on purpose, to see that `castor chaos` notices.

# castor_chaos_mutant(<name> <source> FROM <text> TO <text> [ALL])
#
# castor_mutant_chaos_<name>, a `castor` in which <text> says something else. With ALL it is built and
# tested with everything else; without, by the target castor_mutants and scripts/mutation-check.
function(castor_chaos_mutant name source)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "ALL" "FROM;TO" "")
  set(target castor_mutant_chaos_${name})
  get_target_property(libraries castor_cli LINK_LIBRARIES)
  castor_add_mutant(chaos_${name} ${source} FROM "${ARG_FROM}" TO "${ARG_TO}"
    SOURCES $<TARGET_OBJECTS:castor_cli>
    DEPENDS ${libraries})
  add_dependencies(${target} castor_test_plugin)
  if(ARG_ALL)
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL FALSE)
    add_test(NAME Mutant.chaos_${name}.IsCaught
      COMMAND ${target} --plugin $<TARGET_FILE:castor_test_plugin> chaos
        "${CMAKE_CURRENT_SOURCE_DIR}/wheel.cast" --plan "${CMAKE_CURRENT_SOURCE_DIR}/wheel.plan"
        --duration 3s)
    # Whatever else the run violates: the check of commands has to notice.
    set_tests_properties(Mutant.chaos_${name}.IsCaught PROPERTIES LABELS tests TIMEOUT 120
      PASS_REGULAR_EXPRESSION "VIOLATED   commands with valid tokens")
  endif()
endfunction()

castor_chaos_mutant(tokens_are_not_looked_at actors/runtime/command_gate.cpp ALL
  FROM "if (!demands_lease() || (is_confirmed(now) && is_holder(x.offer)))"
  TO "if (true)")

castor_chaos_mutant(former_holders_are_obeyed actors/runtime/command_gate.cpp
  FROM "return confirmed_ && confirmed_->holder && x.token == confirmed_->token &&
         *x.commander == *confirmed_->holder;"
  TO "return confirmed_ && x.token > 0;")
