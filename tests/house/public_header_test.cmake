cmake_minimum_required(VERSION 3.25)

# castor.hpp, which component authors include, can be compiled alone, agrees with fwd.hpp, and includes
# no header of CAF or of another large library. Prints what it costs.
#
#   cmake -D COMPILER=... -D INCLUDE_ROOT=... -D FOLDER=... -P public_header_test.cmake

file(WRITE "${FOLDER}/author.cpp" "#include \"castor/fwd.hpp\"\n#include \"castor/castor.hpp\"\n")
set(command "${COMPILER}" -std=c++20 -I "${INCLUDE_ROOT}" "${FOLDER}/author.cpp")
execute_process(COMMAND ${command} -M OUTPUT_VARIABLE dependencies COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n\\\\]+" headers "${dependencies}")
list(FILTER headers INCLUDE REGEX "/(caf|nlohmann|spdlog|opencv2|Eigen)/")
if(headers)
  list(JOIN headers "\n  " text)
  message(FATAL_ERROR "castor.hpp includes what component authors should not pay for:\n  ${text}")
endif()

string(TIMESTAMP begin "%s%f")
execute_process(COMMAND ${command} -fsyntax-only COMMAND_ERROR_IS_FATAL ANY)
string(TIMESTAMP end "%s%f")
math(EXPR milliseconds "(${end} - ${begin}) / 1000")
string(REGEX MATCHALL "/castor/[^ \n]+\\.hpp" ours "${dependencies}")
string(REGEX MATCHALL "[^ \n\\\\]+" all "${dependencies}")
list(LENGTH ours ours)
list(LENGTH all all)
message("castor.hpp: ${ours} headers of Castor's, ${all} in all, read in ${milliseconds} ms")
