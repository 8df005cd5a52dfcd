# castor_mutate(<name> <source> <from> <to>)
#
# Sets `mutated` to a copy of the source file in which <from>, which must occur there exactly once,
# says <to>.
function(castor_mutate name source from to)
  set(path "${PROJECT_SOURCE_DIR}/${source}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
  file(READ "${path}" text)
  string(FIND "${text}" "${from}" first)
  string(FIND "${text}" "${from}" last REVERSE)
  if(first EQUAL -1 OR NOT first EQUAL last)
    message(FATAL_ERROR
      "mutant ${name}: this does not stand in ${source} exactly once, adapt the mutant:\n${from}")
  endif()
  string(REPLACE "${from}" "${to}" text "${text}")
  set(path "${CMAKE_CURRENT_BINARY_DIR}/mutants/${name}.cpp")
  file(CONFIGURE OUTPUT "${path}" CONTENT "${text}" @ONLY)
  set(mutated "${path}" PARENT_SCOPE)
endfunction()

# castor_add_mutant(<name> <source> FROM <text> TO <text> SOURCES <source>... DEPENDS <target>...)
#
# castor_mutant_<name>, an executable of these sources and of <source>, in which <text> says something
# else. What an executable defines takes precedence over what its libraries do. Built by the target
# castor_mutants only, and by scripts/mutation-check.
function(castor_add_mutant name source)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "FROM;TO" "SOURCES;DEPENDS")
  castor_mutate(${name} ${source} "${ARG_FROM}" "${ARG_TO}")
  set(target castor_mutant_${name})
  castor_executable(${target}
    SOURCES "${mutated}" ${ARG_SOURCES}
    DEPENDS ${ARG_DEPENDS})
  target_compile_options(${target} PRIVATE -Wno-unused-parameter -Wno-unused-variable)
  set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL TRUE)
  set_property(GLOBAL APPEND PROPERTY CASTOR_MUTANTS ${name})
endfunction()
