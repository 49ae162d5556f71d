# cmake -DMODULE=a.spv -DSPIRV_DIS=... -DSPIRV_AS=... -P ExactArithmetic.cmake: decorates every floating-point result
# NoContraction, in place. What `precise` does in GLSL, but nothing can be forgotten: drivers may then neither fuse
# nor rearrange arithmetic, so that CPU and compute agree to the last bit.

execute_process(COMMAND "${SPIRV_DIS}" --raw-id "${MODULE}" OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE " *OpDecorate %[0-9]+ NoContraction\n" "" text "${text}")
string(REGEX MATCHALL "%[0-9]+ = Op(F(Add|Sub|Mul|Div|Rem|Mod|Negate|Ord[A-Za-z]+|Unord[A-Za-z]+)|Dot|VectorTimesScalar|ExtInst) "
    results "${text}")
set(decorations "")
foreach(result IN LISTS results)
    string(REGEX MATCH "^%[0-9]+" id "${result}")
    string(APPEND decorations "OpDecorate ${id} NoContraction\n")
endforeach()
# Decorations stand together before the first type.
string(REGEX REPLACE "( *%[0-9]+ = OpTypeVoid\n)" "${decorations}\\1" text "${text}")
file(WRITE "${MODULE}.asm" "${text}")
execute_process(COMMAND "${SPIRV_AS}" --preserve-numeric-ids --target-env vulkan1.2 -o "${MODULE}" "${MODULE}.asm"
    COMMAND_ERROR_IS_FATAL ANY)
