# cmake -DSOURCE=DIR -DVERSION=1.2.3 -DHEADER=out.h -P WriteVersion.cmake

set(commit "")
find_program(GIT git)
if(GIT AND EXISTS "${SOURCE}/.git")
    execute_process(COMMAND "${GIT}" -C "${SOURCE}" describe --always --dirty --exclude=* --abbrev=10
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(commit)
    set(VERSION "${VERSION} (${commit})")
endif()
set(text "// Made by cmake/WriteVersion.cmake.\n#pragma once\n#define SLANT_VERSION \"${VERSION}\"\n")
set(before "")
if(EXISTS "${HEADER}")
    file(READ "${HEADER}" before)
endif()
if(NOT text STREQUAL before)
    file(WRITE "${HEADER}" "${text}")
endif()
