// Which item an invocation works on.
#ifndef SLANT_RESOURCES_INVOCATION_GLSL
#define SLANT_RESOURCES_INVOCATION_GLSL

/// The number of an invocation in a grid that took a second dimension because the first was full
/// (Pass::gridFor): call it with gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize and
/// gl_LocalInvocationIndex.
uint linearInvocation(uvec3 group, uvec3 groups, uvec3 groupSize, uint localIndex) {
    return (group.y * groups.x + group.x) * (groupSize.x * groupSize.y * groupSize.z) + localIndex;
}
#endif
