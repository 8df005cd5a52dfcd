# Builds a component against an installed Castor, and runs it there.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

file(REMOVE_RECURSE "${WORK_DIR}")
run(${CMAKE_COMMAND} -S "${SOURCE_DIR}" -B "${WORK_DIR}" -G Ninja
  "-DCMAKE_PREFIX_PATH=${PREFIX}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}")
run(${CMAKE_COMMAND} --build "${WORK_DIR}")
set(castor "${PREFIX}/bin/castor")
set(plugin "${WORK_DIR}/libgreeter.so")
run("${castor}" --plugin "${plugin}" run "${SOURCE_DIR}/greeter.cast" --trace --until-quiet 300ms)
if(NOT output MATCHES "hall +ADD +Greeting")
  message(FATAL_ERROR "the component did not add its entry:\n${output}")
endif()
# The configurations are installed too, and the components that come with Castor are found.
run("${castor}" check "${PREFIX}/share/castor/configs/vision.cast")
