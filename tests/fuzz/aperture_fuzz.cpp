// libFuzzer entry for names of apertures.
#include "support/fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    slant::test::fuzzAperture(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
