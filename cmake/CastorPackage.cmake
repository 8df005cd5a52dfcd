# Debian packages of what is installed: `castor` to run systems, `castor-dev` to write components.
# scripts/package builds them from any build tree, and checks them.
set(CASTOR_MAINTAINER "Castor authors <castor@castor.invalid>" CACHE STRING
  "Who answers for the Debian packages, as in \"NAME <ADDRESS>\"")

# The libraries that the packages need are those of one release of Debian.
file(STRINGS /etc/os-release release REGEX "^VERSION_CODENAME=")
string(REGEX REPLACE "^VERSION_CODENAME=\"?([a-z]*)\"?" "\\1" release "${release}")
if(NOT release)
  set(release local)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME castor)
set(CPACK_PACKAGE_VENDOR Castor)
set(CPACK_PACKAGE_CONTACT "${CASTOR_MAINTAINER}")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~${release}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Each package has a synopsis of its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME castor)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
# The font that pictures of timelines are measured for, and a list of words that are spelt rightly.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "fonts-liberation2, wamerican-small")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "bash-completion, castor-dev, graphviz")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "runtime for the architectures of intelligent robots
Castor runs information-processing architectures: components that meet on
typed, shared working memories, and hear of changes through filtered events.
Vision, spatial relations, language and binding come with it, and a robot at
a table that puts them together.
.
This package has the castor command, the libraries, and example systems.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME castor-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# Those that castorConfig.cmake finds.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "castor (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), libcaf-dev, libfmt-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS
  "cmake, g++, libeigen3-dev, libgtest-dev, libopencv-dev, nlohmann-json3-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "runtime for the architectures of intelligent robots - development
Castor runs information-processing architectures: components that meet on
typed, shared working memories, and hear of changes through filtered events.
.
This package has what it takes to write components in C++ and to test them:
headers, the libraries to link with, and the package for CMake's
find_package(castor).")

# What Debian's policy wants besides: compressed pages, copyright, changelogs.
set(CASTOR_CHANGELOG_VERSION "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(CASTOR_CHANGELOG_RELEASE "${release}")
configure_file("${PROJECT_SOURCE_DIR}/cmake/debianise.cmake.in"
  "${PROJECT_BINARY_DIR}/debianise.cmake" @ONLY)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_BINARY_DIR}/debianise.cmake")
include(CPack)
