# `cmake --install` gives the command, the shipped models, and what another project needs to add blocks of its own and
# to run models: headers, libraries, and the package that find_package(flyball) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/flyball")
set(libraries blocks models solvers studies command)
foreach(library IN LISTS libraries)
  set_target_properties(flyball_${library} PROPERTIES EXPORT_NAME ${library})
  list(APPEND library_targets flyball_${library})
endforeach()
set_target_properties(flyball_options PROPERTIES EXPORT_NAME options)
install(TARGETS flyball flyball_options ${library_targets} EXPORT flyball
        RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT flyball NAMESPACE flyball:: FILE flyball-targets.cmake DESTINATION "${package_dir}")
foreach(folder blocks models solvers studies tools)
  install(DIRECTORY ${folder} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/flyball" FILES_MATCHING PATTERN "*.h")
endforeach()
install(DIRECTORY models/ DESTINATION "${CMAKE_INSTALL_DATADIR}/flyball/models"
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv" PATTERN language EXCLUDE)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/flyball-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES tools/flyball-config.cmake "${CMAKE_CURRENT_BINARY_DIR}/flyball-config-version.cmake"
        DESTINATION "${package_dir}")
