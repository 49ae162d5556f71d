// The basics of the compute room on a real device: copies, dispatches, and what it refuses.
#include "compute/command_list.h"
#include "compute/vulkan.h"
#include "shared/scan.h"
#include "support/expect_error.h"
#include "support/vulkan_fixture.h"

#include <numeric>

namespace slant {
namespace {

using test::expectError;
using Words = std::vector<std::uint32_t>;

Words counting(std::size_t count) {
    Words words(count);
    std::iota(words.begin(), words.end(), 1u);
    return words;
}

class ComputeTest : public test::VulkanTest {
protected:
    /// Uploads and downloads, whole and in part, must give back what was stored.
    static void expectCopies(Device& on, std::size_t count) {
        const Words words = counting(count);
        Buffer buffer(on, TexelFormat::rgba32ui, count / 4);
        buffer.upload(words);
        Words result(count);
        buffer.download(result);
        EXPECT_TRUE(result == words) << count;

        buffer.upload(std::span(words).first(8), 5); // texels 5 and 6
        Words part(12);
        buffer.download(part, 4);
        EXPECT_EQ(part, (Words{17, 18, 19, 20, 1, 2, 3, 4, 5, 6, 7, 8}));
    }
};

TEST_F(ComputeTest, copiesComeBack) {
    expectCopies(device(), 1 << 16);
}

TEST_F(ComputeTest, copiesComeBackThroughStaging) {
    Device staged({.validate = true, .forceStaging = true});
    expectCopies(staged, 1 << 16);
    expectCopies(staged, (StagingBuffer::kBytes / 4) * 2 + 400); // three pieces
}

TEST_F(ComputeTest, stagedBuffersGoThroughPasses) {
    Device staged({.validate = true, .forceStaging = true});
    const Pass reduce(staged, "scan_reduce");
    Buffer items(staged, TexelFormat::r32ui, 1000);
    const Buffer sums(staged, TexelFormat::r32ui, 4);
    items.upload(Words(1000, 2));
    CommandList commands(staged);
    commands.dispatch(reduce, {items, sums}, ScanPush{1000, 0}, reduce.gridFor(4));
    commands.run();
    Words result(4);
    sums.download(result);
    EXPECT_EQ(result, (Words{512, 512, 512, 464}));
}

TEST_F(ComputeTest, fillSetsEveryWord) {
    const Buffer buffer(device(), TexelFormat::rgba32f, 1001);
    CommandList commands(device());
    commands.fill(buffer, 0x12345678);
    commands.run();
    Words words(4004);
    buffer.download(words);
    EXPECT_TRUE(words == Words(4004, 0x12345678));
}

TEST_F(ComputeTest, emptyBuffersAndGridsDoNothing) {
    const Pass reduce(device(), "scan_reduce");
    Buffer none(device(), TexelFormat::r32ui, 0);
    Words empty;
    none.upload(Words());
    none.download(empty);
    CommandList commands(device());
    commands.dispatch(reduce, {none, none}, ScanPush{0, 0}, reduce.gridFor(0));
    commands.run();
    EXPECT_TRUE(commands.takePassTimes().empty());
}

TEST_F(ComputeTest, manyDispatchesInOneListRunInOrder) {
    const Pass apply(device(), "scan_apply");
    Buffer item(device(), TexelFormat::r32ui, 2);
    item.upload(Words{1, 1});
    CommandList commands(device());
    for (int run = 0; run < 2; ++run) {
        for (int i = 0; i < 700; ++i)
            commands.dispatch(apply, {item, item, item}, ScanPush{2, 0}, apply.gridFor(1));
        commands.fill(item, 7);
        commands.dispatch(apply, {item, item, item}, ScanPush{2, 0}, apply.gridFor(1));
        commands.run();
        Words result(2);
        item.download(result);
        EXPECT_EQ(result, (Words{0, 7}));
    }
    const std::vector<PassTime> times = commands.takePassTimes();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "scan_apply");
    EXPECT_EQ(times[0].dispatches, 1402u);
    EXPECT_EQ(times[1].name, "fill");
    EXPECT_EQ(times[1].dispatches, 2u);
    for (const PassTime& time : times) {
        EXPECT_GT(time.seconds, 0);
        EXPECT_LT(time.seconds, 60);
    }
}

TEST_F(ComputeTest, gridsTakeASecondDimensionWhenTheFirstIsFull) {
    const Pass reduce(device(), "scan_reduce"); // workgroups of 64
    const std::uint64_t most = device().limits().workgroupsX;
    const auto size = [&](std::uint64_t items) {
        const Grid grid = reduce.gridFor(items);
        return std::pair(grid.x, grid.y);
    };
    EXPECT_EQ(size(0), std::pair(0u, 0u));
    EXPECT_EQ(size(1), std::pair(1u, 1u));
    EXPECT_EQ(size(64), std::pair(1u, 1u));
    EXPECT_EQ(size(65), std::pair(2u, 1u));
    EXPECT_EQ(size(most * 64), std::pair(std::uint32_t(most), 1u));
    EXPECT_EQ(size(most * 64 + 1), std::pair(std::uint32_t(most), 2u));
    expectError(ErrorCode::resources, "workgroups", [&] { reduce.gridFor(~std::uint64_t(0) / 128); });
}

TEST_F(ComputeTest, aDispatchOverTwoDimensionsReachesEveryItem) {
    const Pass reduce(device(), "scan_reduce");
    constexpr std::uint32_t kChunks = 1000;
    Buffer items(device(), TexelFormat::r32ui, kChunks * kScanChunk);
    const Buffer sums(device(), TexelFormat::r32ui, kChunks);
    items.upload(Words(kChunks * kScanChunk, 1));
    CommandList commands(device());
    commands.fill(sums, 0);
    commands.dispatch(reduce, {items, sums}, ScanPush{kChunks * kScanChunk, 0},
                      {3, 6}); // 18 x 64 invocations
    commands.run();
    Words result(kChunks);
    sums.download(result);
    EXPECT_TRUE(result == Words(kChunks, kScanChunk));
}

TEST_F(ComputeTest, tracksBytes) {
    const std::uint64_t before = device().allocatedBytes();
    device().resetPeakBytes();
    {
        Buffer a(device(), TexelFormat::rgba32f, 1000);
        const Buffer b(device(), TexelFormat::r32ui, 1000);
        EXPECT_GE(device().allocatedBytes(), before + 20000);
        a = Buffer(device(), TexelFormat::r32ui, 1);
    }
    EXPECT_EQ(device().allocatedBytes(), before);
    EXPECT_GE(device().peakBytes(), before + 20000);
}

TEST_F(ComputeTest, refusesBuffersOverTheLimits) {
    const std::uint64_t most = device().limits().texelBufferElements;
    expectError(ErrorCode::resources, std::to_string(most + 1),
                [&] { Buffer(device(), TexelFormat::r32ui, most + 1); });
    expectError(ErrorCode::resources, std::to_string(~std::uint64_t(0)),
                [&] { Buffer(device(), TexelFormat::rgba32f, ~std::uint64_t(0)); });
    const std::uint64_t heap = device().limits().heapBytes;
    if (heap / 16 + 1 <= most)
        expectError(ErrorCode::resources, "bytes",
                    [&] { Buffer(device(), TexelFormat::rgba32f, heap / 16 + 1); });
}

TEST_F(ComputeTest, refusesCopiesOutsideTheBuffer) {
    Buffer buffer(device(), TexelFormat::rgba32ui, 10);
    Words words(8);
    expectError(ErrorCode::usage, "texel 9", [&] { buffer.upload(words, 9); });
    expectError(ErrorCode::usage, "texel 9", [&] { buffer.download(words, 9); });
    expectError(ErrorCode::usage, "texel 18446744073709551615",
                [&] { buffer.download(words, ~std::uint64_t(0)); });
}

TEST_F(ComputeTest, refusesDispatchesThatDoNotFitTheShader) {
    const Pass reduce(device(), "scan_reduce");
    const Buffer words(device(), TexelFormat::r32ui, 10), floats(device(), TexelFormat::r32f, 10);
    CommandList commands(device());
    const ScanPush push{10, 0};
    expectError(ErrorCode::usage, "1 buffers", [&] { commands.dispatch(reduce, {words}, push, {1, 1}); });
    expectError(ErrorCode::usage, "'items'", [&] {
        commands.dispatch(reduce, {floats, words}, push, {1, 1});
    });
    expectError(ErrorCode::usage, "'sums'", [&] {
        commands.dispatch(reduce, {words, floats}, push, {1, 1});
    });
    expectError(ErrorCode::usage, "4 bytes", [&] { commands.dispatch(reduce, {words, words}, 1u, {1, 1}); });
    const std::uint32_t over = device().limits().workgroupsX + 1;
    if (over > 0)
        expectError(ErrorCode::usage, "workgroups", [&] {
            commands.dispatch(reduce, {words, words}, push, {over, 1});
        });
    expectError(ErrorCode::usage, "no shader 'banana'", [&] { Pass(device(), "banana"); });
    expectError(ErrorCode::usage, "not submitted", [&] { commands.wait(); });
    commands.submit();
    expectError(ErrorCode::usage, "running", [&] { commands.fill(words, 0); });
    commands.wait();
}

TEST_F(ComputeTest, choosesByPartOfTheName) {
    EXPECT_EQ(Device({.name = "LLVMpipe", .validate = false}).info().type, "cpu");
    expectError(ErrorCode::device, "no Vulkan device 'banana'; there is '",
                [] { Device({.name = "banana"}); });
}

// This test breaks a rule on purpose: it proves that validation is on and that its findings are thrown.
TEST_F(ComputeTest, validationFindsWrongUsage) {
    Device::Impl& vulkan = device().impl();
    const vk::raii::Buffer buffer(vulkan.device,
                                  vk::BufferCreateInfo({}, 64, vk::BufferUsageFlagBits::eUniformBuffer));
    const vk::raii::DeviceMemory memory(vulkan.device,
                                        vk::MemoryAllocateInfo(buffer.getMemoryRequirements().size, 0));
    buffer.bindMemory(*memory, 0);
    const vk::raii::BufferView view(vulkan.device,
                                    vk::BufferViewCreateInfo({}, *buffer, vk::Format::eR32Uint, 0, 64));
    expectError(ErrorCode::device, "VUID-VkBufferViewCreateInfo-buffer-00932",
                [&] { device().checkValidation(); });
    device().checkValidation(); // reported once
}

// A write after a write without a barrier between them.
TEST_F(ComputeTest, validationFindsMissingBarriers) {
    const Buffer buffer(device(), TexelFormat::r32ui, 64);
    device().impl().runOnce("writing twice", [&](const vk::raii::CommandBuffer& commands) {
        commands.fillBuffer(*buffer.impl().buffer, 0, VK_WHOLE_SIZE, 1);
        commands.fillBuffer(*buffer.impl().buffer, 0, VK_WHOLE_SIZE, 2);
    });
    expectError(ErrorCode::device, "SYNC-HAZARD-WRITE-AFTER-WRITE", [&] { device().checkValidation(); });
}

} // namespace
} // namespace slant
