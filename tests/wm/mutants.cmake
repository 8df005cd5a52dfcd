# Journals that are wrong on purpose, to see that their tests notice; for scripts/mutation-check.

# castor_journal_mutant(<name> <source> FROM <text> TO <text>)
#
# castor_mutant_journal_<name>, a `wm_tests` in which <text> says something else.
function(castor_journal_mutant name source)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "FROM;TO" "")
  castor_add_mutant(journal_${name} ${source} FROM "${ARG_FROM}" TO "${ARG_TO}"
    SOURCES $<TARGET_OBJECTS:wm_tests>
    DEPENDS castor::wm nlohmann_json::nlohmann_json SQLite::SQLite3 rapidcheck_gtest GTest::gmock
      GTest::gtest_main)
endfunction()

castor_journal_mutant(nothing_is_synced wm/journal/sqlite_journal.cpp
  FROM "PRAGMA synchronous=FULL; PRAGMA cache_size"
  TO "PRAGMA synchronous=OFF; PRAGMA cache_size")

castor_journal_mutant(two_write_at_once wm/journal/sqlite_journal.cpp
  FROM "if (newest == meta_.session)"
  TO "if (true)")

castor_journal_mutant(nothing_is_written wm/journal/journal_writer.cpp
  FROM "parts_.file->append(under_way_);"
  TO "")
