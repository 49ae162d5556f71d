# What `slant --version` says: the version and, where the sources are a git checkout, the commit.

# Makes "version.h" for `target` at build time; it is written only where it changes.
function(slant_embed_version target)
    set(header "${PROJECT_BINARY_DIR}/version/version.h")
    add_custom_target(${target}_version BYPRODUCTS "${header}"
        COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DVERSION=${PROJECT_VERSION}" "-DHEADER=${header}"
                -P "${PROJECT_SOURCE_DIR}/cmake/WriteVersion.cmake"
        COMMENT "Version" VERBATIM)
    add_dependencies(${target} ${target}_version)
    target_include_directories(${target} PRIVATE "${PROJECT_BINARY_DIR}/version")
endfunction()
