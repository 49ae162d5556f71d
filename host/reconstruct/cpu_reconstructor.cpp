#include "reconstruct/cpu_reconstructor.h"

#include "reconstruct/cpu_engine.h"

namespace slant {

std::unique_ptr<Engine> CpuReconstructor::makeEngine(const SceneSideSamples& samples) {
    return std::make_unique<CpuEngine>(samples);
}

} // namespace slant
