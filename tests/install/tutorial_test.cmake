# Holds a page of docs to what it says: the files that it quotes are those of the folder of its name, they
# build against an installed Castor, their tests pass, and the commands that it gives print what it shows.
# What stands before a fence says what is in it:
#
#   `NAME`:                     the whole file
#   From `NAME`:                a part of it
#   `castor ...` [fails ...]    without a language: lines that the command prints, or parts of them
#   `castor ...` soon says ...  the same, of what it prints in the end, if it is asked again and again
# and, without a fence,
#   `castor ...` goes on ...    the command runs until the end of the page, and no other system is in sight
#   `castor ...` soon succeeds  it does, if it is tried again and again
# $HOME/castor is where Castor is installed. With MOST_LINES, C++ and .cast files have no more lines than that.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

file(REMOVE_RECURSE "${WORK_DIR}")
file(COPY "${SOURCE_DIR}/" DESTINATION "${WORK_DIR}")
run(${CMAKE_COMMAND} -S "${WORK_DIR}" -B "${WORK_DIR}/build" -G Ninja
  "-DCMAKE_PREFIX_PATH=${PREFIX}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
  "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")
run(${CMAKE_COMMAND} --build "${WORK_DIR}/build")
if(EXISTS "${WORK_DIR}/build/CTestTestfile.cmake")
  run(${CMAKE_CTEST_COMMAND} --test-dir "${WORK_DIR}/build" --output-on-failure --no-tests=error)
endif()

cmake_path(GET SOURCE_DIR FILENAME name)
set(name "docs/${name}")

function(expect_part whole part what)
  string(FIND "${whole}" "${part}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${what} has not what ${name}.md quotes:\n${part}\nbut:\n${whole}")
  endif()
endfunction()

# What a command prints that succeeds, with all these lines, sooner or later.
function(run_until arguments lines)
  string(TIMESTAMP begin "%s")
  while(TRUE)
    execute_process(COMMAND "${PREFIX}/bin/castor" ${arguments} WORKING_DIRECTORY "${WORK_DIR}"
      RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    set(missing "")
    foreach(line IN LISTS lines)
      string(FIND "${output}" "${line}" at)
      if(at EQUAL -1)
        set(missing "${line}")
      endif()
    endforeach()
    if(status EQUAL 0 AND missing STREQUAL "")
      return()
    endif()
    string(TIMESTAMP now "%s")
    math(EXPR waited "${now} - ${begin}")
    if(waited GREATER 30)
      set(background "")
      if(EXISTS "${WORK_DIR}/going-on.log")
        file(READ "${WORK_DIR}/going-on.log" background)
      endif()
      message(FATAL_ERROR "castor ${arguments}\nends with ${status} and without\n${missing}\neven now:\n"
        "${output}\nwhat goes on:\n${background}")
    endif()
    execute_process(COMMAND ${CMAKE_COMMAND} -E sleep 0.1)
  endwhile()
endfunction()

# Where sockets of running systems are found; their names have to be short.
execute_process(COMMAND mktemp -d OUTPUT_VARIABLE runtime_dir OUTPUT_STRIP_TRAILING_WHITESPACE)
set(ENV{XDG_RUNTIME_DIR} "${runtime_dir}")
set(going_on "")

file(READ "${SOURCE_DIR}.md" page)
set(quoted_files "")
set(in_fence FALSE)
while(NOT page STREQUAL "")
  string(FIND "${page}" "\n" end)
  string(SUBSTRING "${page}" 0 ${end} line)
  math(EXPR end "${end} + 1")
  string(SUBSTRING "${page}" ${end} -1 page)

  if(in_fence AND line STREQUAL "```")
    set(in_fence FALSE)
    if(whole_file)
      if(NOT block STREQUAL content)
        message(FATAL_ERROR "${name}/${whole_file} and ${name}.md differ")
      endif()
      list(APPEND quoted_files "${whole_file}")
    elseif(part_of)
      expect_part("${content}" "${block}" "${name}/${part_of}")
    elseif(language MATCHES "cpp|cmake")
      message(FATAL_ERROR "${name}.md does not say which file this is from:\n${block}")
    elseif(soon)
      run_until("${arguments}" "${lines}")
      set(soon FALSE)
    endif()
    set(whole_file "")
    set(part_of "")
  elseif(in_fence)
    string(APPEND block "${line}\n")
    list(APPEND lines "${line}")
    if(NOT whole_file AND NOT soon AND language STREQUAL "")
      expect_part("${output}" "${line}" "${command}")
    endif()
  elseif(line MATCHES "^```(.*)$")
    set(in_fence TRUE)
    set(language "${CMAKE_MATCH_1}")
    set(block "")
    set(lines "")
  elseif(line MATCHES "^`([^` ]+)`:$")
    set(whole_file "${CMAKE_MATCH_1}")
    file(READ "${SOURCE_DIR}/${whole_file}" content)
  elseif(line MATCHES "^From `([^`]+)`:$")
    set(part_of "${CMAKE_MATCH_1}")
    file(READ "${SOURCE_DIR}/${part_of}" content)
  elseif(line MATCHES "^`castor ([^`]+)`( fails| goes on| soon says| soon succeeds)?")
    set(command "castor ${CMAKE_MATCH_1}")
    set(outcome "${CMAKE_MATCH_2}")
    string(REPLACE "$HOME/castor" "${PREFIX}" arguments "${CMAKE_MATCH_1}")
    separate_arguments(arguments UNIX_COMMAND "${arguments}")
    set(soon FALSE)
    if(outcome STREQUAL " goes on")
      # It ends of itself should this test fail.
      execute_process(
        COMMAND sh -c "timeout -s INT 120 \"$@\" </dev/null >going-on.log 2>&1 & echo $!" sh
          "${PREFIX}/bin/castor" ${arguments}
        WORKING_DIRECTORY "${WORK_DIR}" OUTPUT_VARIABLE going_on OUTPUT_STRIP_TRAILING_WHITESPACE)
    elseif(outcome STREQUAL " soon says")
      set(soon TRUE)
    elseif(outcome STREQUAL " soon succeeds")
      run_until("${arguments}" "")
    else()
      set(status 0)
      if(outcome STREQUAL " fails")
        set(status 1)
      endif()
      run_with_status(${status} "${PREFIX}/bin/castor" ${arguments} WORKING_DIRECTORY "${WORK_DIR}")
    endif()
  endif()
endwhile()

if(going_on)
  execute_process(COMMAND sh -c "kill -INT ${going_on}; while kill -0 ${going_on}; do sleep 0.1; done"
    OUTPUT_QUIET ERROR_QUIET)
endif()
file(REMOVE_RECURSE "${runtime_dir}")

file(GLOB files RELATIVE "${SOURCE_DIR}" "${SOURCE_DIR}/*")
foreach(file IN LISTS files)
  if(NOT file IN_LIST quoted_files)
    message(FATAL_ERROR "${name}.md does not quote ${name}/${file}")
  endif()
endforeach()

if(MOST_LINES)
  file(GLOB counted "${SOURCE_DIR}/*.[hc]pp" "${SOURCE_DIR}/*.cast")
  set(text "")
  foreach(file IN LISTS counted)
    file(READ "${file}" content)
    string(APPEND text "${content}")
  endforeach()
  string(REGEX MATCHALL "\n" ends "${text}")
  list(LENGTH ends count)
  if(count GREATER MOST_LINES)
    message(FATAL_ERROR "${name} has ${count} lines, more than ${MOST_LINES}")
  endif()
endif()
