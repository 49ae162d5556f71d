# cmake -DMODULES=a.spv;b.spv -DHEADER=out.h -P EmbedSpirv.cmake: writes a table of SPIR-V words by shader name.

set(text "// Made by cmake/EmbedSpirv.cmake.\n#pragma once\n#include <cstdint>\n#include <span>\n#include <string_view>\n\n")
string(APPEND text "namespace slant::shaders {\n\n")
set(table "")
foreach(module IN LISTS MODULES)
    get_filename_component(name "${module}" NAME_WE)
    file(READ "${module}" hex HEX)
    # SPIR-V here is little-endian: bytes b0 b1 b2 b3 make the word b3b2b1b0.
    string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
    string(APPEND text "inline constexpr std::uint32_t ${name}Words[] = {${words}};\n")
    string(APPEND table "    {\"${name}\", ${name}Words},\n")
endforeach()
string(APPEND text "\nstruct Module {\n    std::string_view name;\n    std::span<const std::uint32_t> words;\n};\n")
string(APPEND text "inline constexpr Module kModules[] = {\n${table}};\n\n} // namespace slant::shaders\n")
file(WRITE "${HEADER}" "${text}")
