# What `cmake --install` adds to the libraries, headers and the executable: configurations, and the
# package that find_package(castor) finds.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/castor")
configure_package_config_file(cmake/castorConfig.cmake.in castorConfig.cmake
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file(castorConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT castor NAMESPACE castor:: FILE castorTargets.cmake DESTINATION "${package_dir}"
  COMPONENT dev)
install(FILES
  "${PROJECT_BINARY_DIR}/castorConfig.cmake"
  "${PROJECT_BINARY_DIR}/castorConfigVersion.cmake"
  cmake/FindCAF.cmake
  DESTINATION "${package_dir}" COMPONENT dev)
install(FILES castor.hpp fwd.hpp DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/castor" COMPONENT dev)
install(DIRECTORY configs/ DESTINATION "${CMAKE_INSTALL_DATADIR}/castor/configs")
# The libraries have them inside; these are for people to read and to copy.
install(FILES
  binding/ontology/general.ontology
  binding/ontology/tabletop.ontology
  communication/lexicon/english.ccg
  communication/lexicon/actions.ccg
  communication/lexicon/paraphrases.words
  communication/lexicon/examples.words
  communication/lexicon/tabletop.words
  DESTINATION "${CMAKE_INSTALL_DATADIR}/castor/language")
# The command finds them in the build tree, too.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/share/castor")
file(CREATE_LINK "${PROJECT_SOURCE_DIR}/configs" "${PROJECT_BINARY_DIR}/share/castor/configs" SYMBOLIC)
