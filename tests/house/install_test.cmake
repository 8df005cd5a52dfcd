cmake_minimum_required(VERSION 3.25)

# Targets are installed by castor_install_target only, which makes castor_product build them.
#
#   cmake -D SOURCE_DIR=... -P install_test.cmake

file(GLOB_RECURSE files RELATIVE "${SOURCE_DIR}" "${SOURCE_DIR}/CMakeLists.txt" "${SOURCE_DIR}/*/CMakeLists.txt"
  "${SOURCE_DIR}/cmake/*.cmake")
list(FILTER files EXCLUDE REGEX "^build/")
set(violations "")
foreach(file IN LISTS files)
  file(STRINGS "${SOURCE_DIR}/${file}" lines REGEX "^ *install *\\( *(TARGETS|PROGRAMS)")
  if(lines AND NOT file STREQUAL "cmake/CastorHelpers.cmake")
    list(APPEND violations "${file}: ${lines}")
  endif()
endforeach()
if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "install targets with castor_install_target (cmake/CastorHelpers.cmake), so that "
    "castor_product builds them:\n  ${text}")
endif()
