// The reconstruction on the CPU: the clear version that the compute path is held against.
#pragma once
#include "reconstruct/method.h"

namespace slant {

class CpuReconstructor final : public Reconstructor {
public:
    std::unique_ptr<PreparedField> prepare(const LightField& field,
                                           const ReconstructOptions& options) override;
};

} // namespace slant
