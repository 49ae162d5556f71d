// What lib/search.glsl fetches, on the CPU: included in the structs that include it, which are templates of
// `bool kMoving`, and get a `const SearchContext& context` as their first member. For source files only.

/// The CPU has no limit.
static constexpr int kMaxSteps = std::numeric_limits<int>::max();

const SearchContext& context;
const MotionLayout& motionLayout = context.bins.motion.layout;

const vec4& positionAt(uint record) const {
    return context.bins.positions[record];
}
const vec4& valueAt(uint record) const {
    return context.bins.values[record];
}
const vec4& motionAt(uint record) const {
    return context.bins.motions[record];
}
uint cellStartAt(uint cell) const {
    return context.bins.cellStart[cell];
}
const Brick& listedBrick(uint entry) const {
    return context.bins.bricks[context.bricks[entry]];
}
const BrickMotion& listedMotion(uint entry) const {
    return context.bins.brickMotions[context.bricks[entry]];
}
/// Where in cellStart the brick's cell at the grid's origin would stand, modulo 2^32.
uint listedCellBase(uint entry) const {
    const uint id = context.bricks[entry], side = uint(context.bins.grid.cellsPerBrick);
    const uvec2 corner = uvec2(firstCell(context.bins.bricks[id])) / side * side;
    return (id * side - corner.y) * side - corner.x;
}
uint listLength() const {
    return uint(context.bricks.size());
}
