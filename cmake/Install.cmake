# `cmake --install build/release --prefix DIR` gives a relocatable tree: program, library, headers, CMake package.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS slant)
install(TARGETS slant_lib EXPORT slantTargets)
# What users of the library include, and what these headers need: <slant/...>.
install(CODE "
    set(SOURCE \"${PROJECT_SOURCE_DIR}\")
    set(DESTINATION \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/slant\")
    set(HEADERS render/render.h scene/read_scene.h lightfield/field_file.h lightfield/refocus.h
        image/exr.h image/png.h image/metrics.h image/flip.h)
    include(\"${PROJECT_SOURCE_DIR}/cmake/InstallHeaders.cmake\")")
install(EXPORT slantTargets NAMESPACE slant:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/slant)
configure_package_config_file(cmake/slantConfig.cmake.in "${PROJECT_BINARY_DIR}/slantConfig.cmake"
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/slant)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/slantConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/slantConfig.cmake" "${PROJECT_BINARY_DIR}/slantConfigVersion.cmake"
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/slant)
