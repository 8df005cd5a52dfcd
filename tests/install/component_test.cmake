# Installs Castor into a folder of its own, builds a component against that, and runs it there.
function(run)
  execute_process(COMMAND ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
set(prefix "${WORK_DIR}/prefix")
run(${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${prefix}")
run(${CMAKE_COMMAND} -S "${SOURCE_DIR}" -B "${WORK_DIR}/build" -G Ninja
  "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}")
run(${CMAKE_COMMAND} --build "${WORK_DIR}/build")
set(castor "${prefix}/bin/castor")
set(plugin "${WORK_DIR}/build/libgreeter.so")
run("${castor}" --plugin "${plugin}" run "${SOURCE_DIR}/greeter.cast" --trace --until-quiet 300ms)
if(NOT output MATCHES "hall +ADD +Greeting")
  message(FATAL_ERROR "the component did not add its entry:\n${output}")
endif()
# The configurations are installed too, and the components that come with Castor are found.
run("${castor}" check "${prefix}/share/castor/configs/vision.cast")
