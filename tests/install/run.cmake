# run(<command>...): runs it and leaves what it printed in `output`; anything but success is fatal.
# run_with_status(<status> <command>...): the same, where the exit status is to be another.
function(run_with_status expected)
  execute_process(COMMAND ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL expected)
    message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

macro(run)
  run_with_status(0 ${ARGN})
endmacro()
