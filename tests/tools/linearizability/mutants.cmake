# Working memories, components and links that are wrong on purpose, to see that the simulation or the
# runs over nodes notice.

# castor_mutant(<name> <source> FROM <text> TO <text> [ALL])
#
# castor_mutant_<name>, the simulation of working memories in whose source file <text> says something
# else. With ALL it is built and tested with everything else; without, by the target castor_mutants
# and scripts/mutation-check.
function(castor_mutant name source)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "ALL" "FROM;TO" "")
  cmake_path(GET source FILENAME file)
  set(target castor_mutant_${name})
  get_target_property(modules castor_wm CASTOR_LIBRARY_MODULES)
  list(TRANSFORM modules REPLACE "(.+)" "$<TARGET_OBJECTS:castor_\\1>" OUTPUT_VARIABLE objects)
  # Linked together from objects: a mutant differs from the product by one file.
  castor_add_mutant(${name} ${source} FROM "${ARG_FROM}" TO "${ARG_TO}"
    SOURCES $<TARGET_OBJECTS:castor_simulation>
      $<FILTER:${objects},EXCLUDE,/${file}\\.o$>
    DEPENDS castor_history_checks castor_progress castor_simulation_parts castor::base CAF::core nlohmann_json::nlohmann_json SQLite::SQLite3
      ZLIB::ZLIB CLI11::CLI11 fmt::fmt)
  target_include_directories(${target} PRIVATE "${CASTOR_INCLUDE_ROOT}")
  if(ARG_ALL)
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL FALSE)
    add_test(NAME Mutant.${name}.IsCaught
      COMMAND ${target} --seeds 1..20000 --expect-violation)
    set_tests_properties(Mutant.${name}.IsCaught PROPERTIES LABELS tests TIMEOUT 120)
  endif()
endfunction()

# castor_node_mutant(<name> <source> FROM <text> TO <text>)
#
# castor_mutant_node_<name>, a `castor_real_runs` in which <text> says something else: for
# scripts/mutation-check.
function(castor_node_mutant name source)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "FROM;TO" "")
  castor_add_mutant(node_${name} ${source} FROM "${ARG_FROM}" TO "${ARG_TO}"
    SOURCES $<TARGET_OBJECTS:castor_real_runs>
    DEPENDS castor_progress castor_real_run_parts CAF::io CLI11::CLI11 fmt::fmt)
endfunction()

castor_mutant(no_version_check wm/store/entry_store.cpp ALL
  FROM "if (*request.last_seen != old.version)"
  TO "if (false)")

castor_mutant(no_token_check wm/leases/lease_table.cpp ALL
  FROM "return x && *x->holder == client && x->lease.token == token ? Verdict::permitted"
  TO "return true ? Verdict::permitted")

castor_mutant(last_come_first_served wm/leases/lease_table.cpp ALL
  FROM "row->second.queue.push_back(std::move(waiter));"
  TO "row->second.queue.push_front(std::move(waiter));")

castor_mutant(holder_not_compared wm/leases/lease_table.cpp
  FROM "return x && *x->holder == client && x->lease.token == token ? Verdict::permitted"
  TO "return x && x->lease.token == token ? Verdict::permitted")

castor_mutant(reads_pass_locks wm/leases/lease_table.cpp
  FROM "return !x || x->lease.level != LockLevel::odr || *x->holder == client;"
  TO "return true;")

castor_mutant(entries_are_read_here_in_spite_of_locks wm/store/entry_table.cpp
  FROM "i->may_end || i->is_excluded"
  TO "i->may_end")

castor_mutant(deleted_entries_are_still_read_here wm/store/entry_table.cpp
  FROM "if (i == part.slots.end() || i->may_end || i->is_excluded)
      return nullptr;
    result = i->entry;"
  TO "static std::vector<std::pair<const EntryTable*, EntryPtr>> cells;
    auto is_here = [&](auto& x) { return x.first == this && x.second->address.id == id; };
    if (i == part.slots.end()) {
      auto cell = std::find_if(cells.begin(), cells.end(), is_here);
      return cell == cells.end() ? nullptr : cell->second;
    }
    if (i->may_end || i->is_excluded)
      return nullptr;
    result = i->entry;
    std::erase_if(cells, is_here);
    cells.emplace_back(this, result);")

castor_mutant(reads_here_miss_ends_of_leases wm/memory/working_memory_shell.cpp
  FROM "next < never ? epoch_ + (next - clock_jump_) : EntryTable::Time::max()"
  TO "EntryTable::Time::max()")

castor_mutant(locks_exclude_too_late wm/leases/lease_table.cpp
  FROM "row->first);
  note_exclusion(row);"
  TO "row->first);")

castor_mutant(nested_locks_do_not_exclude wm/leases/lease_table.cpp
  FROM "std::max(holding->lease.level, level);
  note_exclusion(row);"
  TO "std::max(holding->lease.level, level);")

castor_mutant(reads_overtake_odr_locks wm/leases/lease_table.cpp
  FROM "if (holding && holding->lease.level == LockLevel::odr && !(*waiter.client == *holding->holder))
      return false;"
  TO "")

castor_mutant(overtaking_has_no_end wm/leases/lease_table.cpp ALL
  FROM "return !row.overtaken_until || now < *row.overtaken_until;"
  TO "return true;")

castor_mutant(leases_outlive_holders wm/leases/lease_table.cpp
  FROM "if (*row.holding->holder == client)
      held.push_back(id);"
  TO "")

castor_mutant(waits_outlive_clients wm/leases/lease_table.cpp
  FROM "forget_waits(row, [&](auto& x) { return *x.client == client; });"
  TO "")

castor_mutant(leases_never_expire wm/leases/lease_table.cpp
  FROM "if (expires > now)
      break;"
  TO "break;")

castor_mutant(tokens_stay wm/leases/lease_table.cpp
  FROM "holding = Holding{{next_token_++,"
  TO "holding = Holding{{next_token_,")

castor_mutant(unlocking_forgets_nesting wm/leases/lease_table.cpp
  FROM "holding.levels.pop_back();"
  TO "holding.levels.clear();")

castor_mutant(weakened_leases_keep_readers_out wm/leases/lease_table.cpp
  FROM "holding.lease.level = *std::max_element(holding.levels.begin(), holding.levels.end());"
  TO "")

castor_mutant(granted_waits_cannot_be_cancelled wm/leases/lease_table.cpp
  FROM "if (holding && holding->number == number && *holding->holder == client) {"
  TO "if (false) {")

castor_mutant(deletion_keeps_the_lease wm/memory/working_memory_shell.cpp
  FROM "leases_.erase(change.event->address.id);"
  TO "{}")

castor_mutant(waiters_hear_nothing_of_a_deletion wm/leases/lease_table.cpp
  FROM "for (auto& waiter : row->second.queue)
    settle(waiter, SettledWait::Result::deleted);"
  TO "for (auto& waiter : row->second.queue)
    deadlines_.erase({waiter.deadline, waiter.arrival});")

castor_mutant(versions_begin_anew wm/store/tombstones.cpp
  FROM "return last ? *last + 1 : floor_;"
  TO "return last ? 0 : floor_;")

castor_mutant(half_a_batch wm/memory/working_memory_shell.cpp
  FROM "commit(*std::move(effects));
  return versions;"
  TO "commit({effects->begin() + (effects->size() > 1), effects->end()});
  return versions;")

castor_mutant(batches_ignore_leases wm/memory/write_preparation.cpp
  FROM "if (auto refused = leases.check(request))"
  TO "if (auto refused = requests.size() > 1 ? std::nullopt : leases.check(request))")

castor_mutant(deaths_settle_nothing wm/memory/working_memory_shell.cpp
  FROM "// Also if that was the last lease, when there is nothing to catch up with.
  settle();"
  TO "")

castor_mutant(changes_told_backwards wm/memory/subscriptions.cpp
  FROM "batch_of(number, notices).push_back({event, std::move(ids)});"
  TO "auto& batch = batch_of(number, notices);
    batch.push_back({event, std::move(ids)});
    std::ranges::rotate(batch, batch.end() - 1);")

castor_mutant(nobody_is_told_of_deletions wm/memory/peer_routes.cpp
  FROM "interests_.match(event, content, matched_);"
  TO "if (event.operation != Operation::remove)
    interests_.match(event, content, matched_);")

# -- over nodes

castor_node_mutant(messages_arrive_twice actors/link/session.cpp
  FROM "deliver(std::move(result));"
  TO "if (received_ % 64 == 0)
    deliver(result);
  deliver(std::move(result));")

castor_node_mutant(resumed_sessions_send_all_again actors/link/session.cpp
  FROM "acknowledge(received_by_peer);
  rewritten_ = 0;"
  TO "rewritten_ = 0;")

castor_node_mutant(messages_are_lost_with_a_connection actors/link/session.cpp
  FROM "acknowledge(received_by_peer);
  rewritten_ = 0;"
  TO "")

castor_node_mutant(late_connections_are_taken actors/link/link_end.cpp
  FROM "hello.incarnation == incarnation_ && hello.attempt <= attempt_"
  TO "false")

castor_node_mutant(reads_are_answered_from_a_cache actors/runtime/component_operations.cpp
  FROM "note_read(**outcome);
    return *outcome;"
  TO "static thread_local std::map<Address, EntryPtr> cache;
    auto& known = cache[address];
    if (!known || parts_.context.counters().reads % 4 == 0)
      known = *outcome;
    seen_.set(address, known->version);
    return known;")

castor_node_mutant(acknowledged_before_applied wm/memory/working_memory.cpp
  FROM "[shell](const WriteRequest& x) {"
  TO "[shell](const WriteRequest& x) -> caf::result<Outcome<Version>> {
      auto* owner = shell->events().find_peer(x.address.subarchitecture);
      if (owner && x.last_seen) {
        caf::anon_send(*owner, x);
        return Outcome<Version>{*x.last_seen + 1};
      }")

castor_node_mutant(stale_tokens_are_good wm/leases/lease_table.cpp
  FROM "return x && *x->holder == client && x->lease.token == token ? Verdict::permitted"
  TO "return true ? Verdict::permitted")

castor_node_mutant(leases_never_expire wm/leases/lease_table.cpp
  FROM "if (expires > now)
      break;"
  TO "break;")

castor_node_mutant(leases_expire_too_early wm/leases/lease_table.cpp
  FROM "level, now + options_.duration}, client"
  TO "level, now + options_.duration / 2}, client")

castor_node_mutant(stale_values_are_referred_to actors/link/kept_contents.cpp
  FROM "auto i = by_value_.find(x.weak());"
  TO "static std::map<std::pair<SentContents*, std::string>, std::weak_ptr<const void>> firsts;
  auto& first = firsts[{this, x.type_name()}];
  auto i = by_value_.find(first);
  if (i == by_value_.end())
    i = by_value_.find(first = x.weak());")
