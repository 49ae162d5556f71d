// The reconstruction on the CPU: the clear version that the compute path is held against.
#pragma once
#include "reconstruct/method.h"

namespace slant {

class CpuReconstructor final : public Reconstructor {
public:
    Image reconstruct(const LightField& field, const ReconstructOptions& options, Monitor& monitor,
                      ReconstructReport& report, StageObserver* observer) override;
};

} // namespace slant
