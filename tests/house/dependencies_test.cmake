cmake_minimum_required(VERSION 3.25)

# Dependencies point one way: wm knows nothing above it, actors know wm, and the robots' folders know
# both and of one another only the entry types, and what binding monitors are made of. Heavy headers
# stay out of ours.
#
#   cmake -D SOURCE_DIR=... -P dependencies_test.cmake

set(robot_folders perception mapping binding planning communication)
set(violations "")

function(check_folder folder allowed)
  file(GLOB_RECURSE files RELATIVE "${SOURCE_DIR}" "${SOURCE_DIR}/${folder}/*.[hc]pp")
  foreach(file IN LISTS files)
    file(STRINGS "${SOURCE_DIR}/${file}" includes REGEX "^#include [\"<]castor/")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^#include [\"<]castor/([^\">]+)[\">].*" "\\1" included "${line}")
      string(REGEX REPLACE "/.*" "" top "${included}")
      if(NOT top IN_LIST allowed AND NOT (folder IN_LIST robot_folders AND included MATCHES "/(types|binding_monitor)\\.hpp$"))
        list(APPEND violations "${file} includes ${included}")
      endif()
    endforeach()
    if(file MATCHES "\\.hpp$" AND NOT file MATCHES "(opencv_bridge|adopt_connection|link/connection)\\.hpp$")
      file(STRINGS "${SOURCE_DIR}/${file}" heavy REGEX "^#include [\"<](opencv2|mrpt|ompl|caf/io|openssl)/")
      foreach(line IN LISTS heavy)
        list(APPEND violations "${file} makes everybody pay for ${line}")
      endforeach()
    endif()
  endforeach()
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

check_folder(wm "wm")
check_folder(actors "wm;actors")
foreach(folder IN LISTS robot_folders)
  check_folder(${folder} "wm;actors;${folder}")
endforeach()

if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "dependencies that the architecture forbids:\n  ${text}")
endif()
