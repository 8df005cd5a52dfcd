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
