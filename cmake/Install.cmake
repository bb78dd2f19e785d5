# Headers, exported target and the files that find_package(scree) reads.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/scree)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/scree DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(TARGETS scree EXPORT scree)
install(EXPORT scree NAMESPACE scree:: FILE scree-targets.cmake DESTINATION ${package_dir})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/scree-config.cmake.in
  ${PROJECT_BINARY_DIR}/scree-config.cmake
  INSTALL_DESTINATION ${package_dir}
)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/scree-config-version.cmake
  COMPATIBILITY SameMinorVersion # before 1.0 a minor version may change the interface
  ARCH_INDEPENDENT
)
install(FILES ${PROJECT_BINARY_DIR}/scree-config.cmake ${PROJECT_BINARY_DIR}/scree-config-version.cmake
  DESTINATION ${package_dir}
)
