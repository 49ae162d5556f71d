# `cmake --install build/release --prefix DIR` gives a relocatable tree: program, library, headers, CMake package.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS slant)
install(TARGETS slant_lib EXPORT slantTargets)
install(DIRECTORY host/ DESTINATION include/slant FILES_MATCHING PATTERN "*.h" PATTERN "commands" EXCLUDE
    PATTERN "kernels.h" EXCLUDE PATTERN "bin_fetches.h" EXCLUDE) # they include shaders/lib/
install(DIRECTORY shaders/ DESTINATION include/slant FILES_MATCHING REGEX "/shared/[^/]*\\.h$" PATTERN "lib" EXCLUDE
    PATTERN "resources" EXCLUDE)
install(EXPORT slantTargets NAMESPACE slant:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/slant)
configure_package_config_file(cmake/slantConfig.cmake.in "${PROJECT_BINARY_DIR}/slantConfig.cmake"
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/slant)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/slantConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/slantConfig.cmake" "${PROJECT_BINARY_DIR}/slantConfigVersion.cmake"
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/slant)
