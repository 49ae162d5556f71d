// The reconstruction on the CPU.
#pragma once
#include "reconstruct/prepared_field.h"

namespace slant {

class CpuReconstructor final : public Reconstructor {
    std::unique_ptr<Engine> makeEngine(const SceneSideSamples& samples) override;
};

} // namespace slant
