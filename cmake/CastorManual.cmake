# Manual pages and shell completion, which the command itself makes: a part of castor_product.
if(CASTOR_SANITIZE OR (CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR))
  message(STATUS "Manual pages and shell completion are left out: the command is not run in this build")
  return()
endif()

set(manual_dir "${PROJECT_BINARY_DIR}/manual")
add_custom_command(OUTPUT "${manual_dir}/made"
  # Without pages of commands that are no more.
  COMMAND ${CMAKE_COMMAND} -E rm -rf "${manual_dir}"
  COMMAND castor_cli man --output "${manual_dir}/man1"
  COMMAND castor_cli completion bash > "${manual_dir}/castor.bash"
  COMMAND castor_cli completion zsh > "${manual_dir}/castor.zsh"
  COMMAND castor_cli completion fish > "${manual_dir}/castor.fish"
  COMMAND ${CMAKE_COMMAND} -E touch "${manual_dir}/made"
  DEPENDS castor_cli
  COMMENT "Making manual pages and shell completion"
  VERBATIM)
add_custom_target(castor_manual ALL DEPENDS "${manual_dir}/made")
add_dependencies(castor_product castor_manual)

install(DIRECTORY "${manual_dir}/man1/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${manual_dir}/castor.bash" RENAME castor
  DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
install(FILES "${manual_dir}/castor.zsh" RENAME _castor
  DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
install(FILES "${manual_dir}/castor.fish"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
