// libFuzzer entry for sampled spectra.
#include "support/fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    slant::test::fuzzSpd(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
