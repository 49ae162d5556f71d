#include "compute/radix_sort.h"
#include "vulkan_fixture.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace slant {
namespace {

using Words = std::vector<std::uint32_t>;

class ScanTest : public VulkanTest {};

TEST_F(ScanTest, first) {
    Buffer b(device(), TexelFormat::r32ui, 100000);
    Words w(100000, 1);
    b.upload(std::span<const std::uint32_t>(w));
    Scan scan(device(), 100000);
    CommandList list(device());
    scan.record(list, b, 100000);
    list.run();
    b.download(std::span(w));
    for (int i = 0; i < 100000; ++i) ASSERT_EQ(w[std::size_t(i)], std::uint32_t(i));
    for (auto& t : list.passTimes()) printf("%s %g %d\n", t.name.c_str(), t.seconds, int(t.dispatches));
}

} // namespace
} // namespace slant
