# How every Castor target is made: one warning level, one place for sanitizers, one include root.
include(GNUInstallDirs)

# The libraries are Castor's own: programs find them through their RPATH, or through CMake, and the loader's
# folders hold none of them. As Debian has it, they are below a folder for the processor that they are for.
set(CASTOR_INSTALL_LIBDIR "${CMAKE_INSTALL_LIBDIR}/castor")
if(CMAKE_LIBRARY_ARCHITECTURE AND CMAKE_INSTALL_LIBDIR STREQUAL "lib")
  set(CASTOR_INSTALL_LIBDIR "lib/${CMAKE_LIBRARY_ARCHITECTURE}/castor")
endif()
# What only developers need says COMPONENT dev; it is a package of its own.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)

# Sources say #include "castor/wm/values/value.hpp", in the tree and installed alike: a link named `castor`
# in the build tree points at the source root.
set(CASTOR_INCLUDE_ROOT "${PROJECT_BINARY_DIR}/include")
file(MAKE_DIRECTORY "${CASTOR_INCLUDE_ROOT}")
file(CREATE_LINK "${PROJECT_SOURCE_DIR}" "${CASTOR_INCLUDE_ROOT}/castor" SYMBOLIC)

# All libraries in one place, so that those loaded by name are found beside those that are linked.
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")

add_library(castor_build_options INTERFACE)
target_compile_features(castor_build_options INTERFACE cxx_std_20)
target_compile_options(castor_build_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 sees overlapping copies in std::string's operator+ that are not there (GCC bug 105651).
  target_compile_options(castor_build_options INTERFACE -Wno-restrict)
endif()
if(CASTOR_SANITIZE)
  target_compile_options(castor_build_options INTERFACE
    -fsanitize=${CASTOR_SANITIZE} -fno-omit-frame-pointer
    # Looked for at every access, which doubles the time that it takes to build. What null pointers,
    # overflowing ones, and objects that are too small do is found by AddressSanitizer all the same.
    -fno-sanitize=null,object-size,vptr,alignment,pointer-overflow)
  target_link_options(castor_build_options INTERFACE -fsanitize=${CASTOR_SANITIZE})
  # Eigen allocates otherwise under sanitizers, but Debian's libraries free what our code has allocated.
  target_compile_definitions(castor_build_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # What sanitizers insert confuses GCC's analysis of what is initialised, and how large it is.
    target_compile_options(castor_build_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds
      -Wno-stringop-overflow)
  endif()
endif()

# What users run and install, without tests and benchmarks.
add_custom_target(castor_product)

# castor_install_target(<target> <argument of install(TARGETS)>...)
#
# Installs a target, and makes it a part of castor_product: after that is built, `cmake --install`
# misses nothing. install(TARGETS) is called nowhere else, which a test checks.
function(castor_install_target target)
  install(TARGETS ${target} ${ARGN})
  add_dependencies(castor_product ${target})
endfunction()

# castor_uses(<module>...)
#
# The sources of the current folder, and of those in it that do not say so themselves, may include the
# headers of these modules, and of what these use: tests/house checks that they include no others. A
# module is a folder that has said so before, "wm_values" for wm/values.
function(castor_uses)
  file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  string(REPLACE "/" "_" name "${folder}")
  set(uses "")
  foreach(module IN LISTS ARGN)
    get_property(others GLOBAL PROPERTY CASTOR_USES_${module})
    if(NOT others)
      message(FATAL_ERROR "${folder} uses '${module}', which is no module that has said what it uses")
    endif()
    list(APPEND uses ${others})
  endforeach()
  # A module uses itself.
  list(APPEND uses ${folder})
  list(REMOVE_DUPLICATES uses)
  set_property(GLOBAL PROPERTY CASTOR_USES_${name} ${uses})
  list(JOIN uses " " uses)
  set_property(GLOBAL APPEND_STRING PROPERTY CASTOR_MODULES "${folder} ${uses}\n")
endfunction()

# castor_module(<name> SOURCES <file>... [USES <module>...] [LIBRARIES <target>...] [UNITY])
#
# The sources of a folder, for castor_library to make a library of; for USES see castor_uses.
# LIBRARIES are those whose headers they include. UNITY: they get along in one translation unit.
function(castor_module name)
  cmake_parse_arguments(ARG "UNITY" "" "SOURCES;USES;LIBRARIES" ${ARGN})
  set(target castor_${name})
  add_library(${target} OBJECT ${ARG_SOURCES})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  castor_unity(${target} "${ARG_UNITY}")
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC "${CASTOR_INCLUDE_ROOT}")
  castor_uses(${ARG_USES})
  list(TRANSFORM ARG_USES PREPEND castor_)
  target_link_libraries(${target} PUBLIC ${ARG_USES} ${ARG_LIBRARIES} PRIVATE castor_build_options)
endfunction()

# castor_unity(<target> <whether its sources get along in one translation unit>)
function(castor_unity target fit)
  if(fit AND CASTOR_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    # What is local to a source looks then as if it were in a header.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# castor_library(<name> [SOURCES <file>...] [MODULES <module>...] [PUBLIC_DEPENDS <target>...]
#   [PRIVATE_DEPENDS <target>...] [UNITY] [DEVELOPMENT])
#
# A shared library libcastor_<name>.so with the alias castor::<name>, installed and exported together
# with the headers below the current folder. UNITY: its sources get along in one translation unit.
# DEVELOPMENT: who only runs systems does not need it.
function(castor_library name)
  cmake_parse_arguments(ARG "UNITY;DEVELOPMENT" "" "SOURCES;MODULES;PUBLIC_DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target castor_${name})
  list(TRANSFORM ARG_MODULES REPLACE "(.+)" "$<TARGET_OBJECTS:castor_\\1>" OUTPUT_VARIABLE objects)
  add_library(${target} SHARED ${ARG_SOURCES} ${objects})
  add_library(castor::${name} ALIAS ${target})
  set_property(TARGET ${target} PROPERTY CASTOR_LIBRARY_MODULES "${ARG_MODULES}")
  castor_note_component_classes(${target} ${ARG_SOURCES})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    BUILD_RPATH "$ORIGIN"
    INSTALL_RPATH "$ORIGIN")
  castor_unity(${target} "${ARG_UNITY}")
  target_compile_features(${target} PUBLIC cxx_std_20)
  if(NOT CASTOR_SANITIZE)
    # A forgotten source file is noticed here, and not when the library is first loaded.
    target_link_options(${target} PRIVATE LINKER:--no-undefined)
  endif()
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CASTOR_INCLUDE_ROOT}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target}
    PUBLIC ${ARG_PUBLIC_DEPENDS}
    PRIVATE ${ARG_PRIVATE_DEPENDS} $<BUILD_INTERFACE:castor_build_options>)
  set(component runtime)
  if(ARG_DEVELOPMENT)
    set(component dev)
  endif()
  castor_install_target(${target} EXPORT castor
    LIBRARY DESTINATION ${CASTOR_INSTALL_LIBDIR} COMPONENT ${component} NAMELINK_COMPONENT dev)
  file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/castor/${folder}" COMPONENT dev
    FILES_MATCHING PATTERN "*.hpp")
endfunction()

# castor_note_component_classes(<target> <file>...)
#
# Notes which component classes the sources of a library register.
function(castor_note_component_classes target)
  foreach(source IN LISTS ARGN)
    get_filename_component(path "${source}" ABSOLUTE)
    if(NOT EXISTS "${path}")
      continue()
    endif()
    file(READ "${path}" text)
    string(REGEX MATCHALL "\nCASTOR_COMPONENT\\([A-Za-z0-9_]+" matches "${text}")
    foreach(match IN LISTS matches)
      string(REGEX REPLACE ".*\\(" "" class "${match}")
      set_property(GLOBAL APPEND_STRING PROPERTY CASTOR_COMPONENT_CLASSES "{\"${class}\", \"${target}\"},\n")
    endforeach()
  endforeach()
endfunction()

# castor_write_component_classes(<file>)
#
# Writes what castor_note_component_classes has noted, as the inside of an array of pairs.
function(castor_write_component_classes file)
  get_property(classes GLOBAL PROPERTY CASTOR_COMPONENT_CLASSES)
  file(CONFIGURE OUTPUT "${file}" CONTENT "${classes}" @ONLY)
endfunction()

# castor_executable(<target> SOURCES <file>... [DEPENDS <target>...])
function(castor_executable target)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE ${ARG_DEPENDS} castor_build_options)
  # Nothing links them: they are loaded when they are needed.
  if(NOT CASTOR_FUZZ)
    add_dependencies(${target} castor_picture_codecs castor_video_sources)
  endif()
endfunction()

# castor_test(<name> SOURCES <file>... [DEPENDS <target>...] [CORE | DETERMINISTIC] [TIMEOUT <seconds>])
#
# A GoogleTest executable whose every test is known to CTest; a test may take TIMEOUT, 120 by default,
# and three times as long under sanitizers.
# CORE tests are run under sanitizers, too: the target core_tests builds them, and they have the label
# core. Those that are DETERMINISTIC have neither threads nor a clock. They are CORE, and otherwise
# left out without CASTOR_DETERMINISTIC_TESTS, as one build of them is enough. Under sanitizers they
# are known to CTest in a few parts only: to start a process takes longer there than most tests.
function(castor_test name)
  cmake_parse_arguments(ARG "CORE;DETERMINISTIC" "TIMEOUT" "SOURCES;DEPENDS" ${ARGN})
  castor_executable(${name} SOURCES ${ARG_SOURCES} DEPENDS ${ARG_DEPENDS} GTest::gtest_main)
  if(ARG_DETERMINISTIC AND NOT CASTOR_DETERMINISTIC_TESTS)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  set(label tests)
  if(ARG_CORE OR ARG_DETERMINISTIC)
    set(label core)
    set_property(GLOBAL APPEND PROPERTY CASTOR_CORE_TESTS ${name})
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(CASTOR_SANITIZE)
    math(EXPR ARG_TIMEOUT "3 * ${ARG_TIMEOUT}")
  endif()
  if(ARG_DETERMINISTIC AND CASTOR_SANITIZE)
    set(parts 8)
    foreach(part RANGE 1 ${parts})
      math(EXPR index "${part} - 1")
      add_test(NAME ${name}.part${part} COMMAND ${name})
      set_tests_properties(${name}.part${part} PROPERTIES LABELS ${label} TIMEOUT 900
        ENVIRONMENT "GTEST_TOTAL_SHARDS=${parts};GTEST_SHARD_INDEX=${index}")
    endforeach()
    return()
  endif()
  gtest_discover_tests(${name}
    DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${label} TIMEOUT ${ARG_TIMEOUT})
endfunction()

# castor_fuzzed(<name> <folder> <source>...)
#
# An object library of these sources of a folder, without .cpp, that fuzzers see the coverage of.
function(castor_fuzzed name folder)
  list(TRANSFORM ARGN REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/${folder}/\\1.cpp")
  file(GLOB sources CONFIGURE_DEPENDS ${ARGN})
  add_library(${name} OBJECT ${sources})
  target_include_directories(${name} PUBLIC "${CASTOR_INCLUDE_ROOT}")
  target_link_libraries(${name} PUBLIC castor_build_options nlohmann_json::nlohmann_json CAF::core)
  target_compile_options(${name} PUBLIC -fsanitize=fuzzer,address,undefined
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(${name} PUBLIC -fsanitize=fuzzer,address,undefined)
endfunction()

# castor_text_source(<namespace>::<function> <file>): a source whose <function> returns the text of
# <file> as std::string_view, added to CASTOR_TEXT_SOURCES, so that programs need not look for it.
function(castor_text_source name text_file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${text_file}")
  file(READ "${text_file}" CASTOR_TEXT)
  string(REGEX MATCH "^(.*)::([^:]+)$" matched "${name}")
  set(CASTOR_TEXT_NAMESPACE ${CMAKE_MATCH_1})
  set(CASTOR_TEXT_FUNCTION ${CMAKE_MATCH_2})
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY "${PROJECT_SOURCE_DIR}"
    OUTPUT_VARIABLE folder)
  set(CASTOR_TEXT_FILE "${folder}/${text_file}")
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${CASTOR_TEXT_FUNCTION}.cpp")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/text_file.cpp.in" "${source}" @ONLY)
  set(CASTOR_TEXT_SOURCES ${CASTOR_TEXT_SOURCES} "${source}" PARENT_SCOPE)
endfunction()
