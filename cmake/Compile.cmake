# Language level, warnings, sanitizers, and the arithmetic that CPU and compute share.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()

# Warnings, and -ffp-contract=off: without it a*b+c may or may not be fused, and the CPU and compute results
# would differ in the last bit.
function(slant_compile_options target)
    target_compile_options(${target} PRIVATE
        -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wimplicit-fallthrough
        -ffp-contract=off $<$<BOOL:${SLANT_WERROR}>:-Werror>)
    if(SLANT_SANITIZE)
        target_compile_options(${target} PUBLIC -fsanitize=${SLANT_SANITIZE} -fno-omit-frame-pointer
            -fno-sanitize-recover=all)
        # GCC's uninitialized analysis misjudges instrumented code (std::regex is one case); release has it on.
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
        target_link_options(${target} PUBLIC -fsanitize=${SLANT_SANITIZE})
        if(SLANT_SANITIZE STREQUAL "thread")
            # oneTBB's templates would be half instrumented; this file tells the sanitizer about their order itself.
            set_source_files_properties(host/base/parallel.cpp PROPERTIES
                COMPILE_OPTIONS -fno-sanitize=thread COMPILE_DEFINITIONS SLANT_THREAD_SANITIZER)
        endif()
    endif()
endfunction()
