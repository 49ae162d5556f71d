# GLSL -> SPIR-V -> exact arithmetic -> validated -> embedded as constexpr words, all at build time.

find_program(GLSLANG glslangValidator REQUIRED)
find_program(SPIRV_DIS spirv-dis REQUIRED)
find_program(SPIRV_AS spirv-as REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# Compiles every shaders/*.comp, and makes "shaders_embedded.h" with one array kNAME per shader for `target`.
function(slant_embed_shaders target)
    file(GLOB shaders CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/shaders/*.comp")
    set(out "${PROJECT_BINARY_DIR}/shaders")
    set(spirv "")
    foreach(shader IN LISTS shaders)
        get_filename_component(name "${shader}" NAME_WE)
        set(module "${out}/${name}.spv")
        add_custom_command(OUTPUT "${module}"
            COMMAND "${GLSLANG}" --quiet -V --target-env vulkan1.2 "-I${PROJECT_SOURCE_DIR}/shaders"
                    --depfile "${module}.d" -o "${module}" "${shader}"
            COMMAND "${CMAKE_COMMAND}" "-DMODULE=${module}" "-DSPIRV_DIS=${SPIRV_DIS}" "-DSPIRV_AS=${SPIRV_AS}"
                    -P "${PROJECT_SOURCE_DIR}/cmake/ExactArithmetic.cmake"
            COMMAND "${SPIRV_VAL}" --target-env vulkan1.2 "${module}"
            DEPENDS "${shader}" "${PROJECT_SOURCE_DIR}/cmake/ExactArithmetic.cmake" DEPFILE "${module}.d"
            COMMENT "Shader ${name}" VERBATIM)
        list(APPEND spirv "${module}")
    endforeach()
    set(header "${out}/shaders_embedded.h")
    add_custom_command(OUTPUT "${header}"
        COMMAND "${CMAKE_COMMAND}" "-DMODULES=${spirv}" "-DHEADER=${header}"
                -P "${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake"
        DEPENDS ${spirv} "${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake"
        COMMENT "Embedding shaders" VERBATIM)
    target_sources(${target} PRIVATE "${header}")
    target_include_directories(${target} PRIVATE "${out}")
endfunction()
