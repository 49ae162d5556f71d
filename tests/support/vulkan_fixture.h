// A validated Vulkan device for tests. None on this machine is a failure, unless
// SLANT_TESTS_WITHOUT_VULKAN=1.
#pragma once
#include "base/error.h"
#include "compute/device.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace slant::test {

class VulkanTest : public testing::Test {
protected:
    static void SetUpTestSuite() {
        if (!skipped()) device_ = std::make_unique<Device>(DeviceOptions{.validate = true});
    }
    static void TearDownTestSuite() { device_.reset(); }

    void SetUp() override {
        if (skipped()) GTEST_SKIP() << "SLANT_TESTS_WITHOUT_VULKAN";
        ASSERT_NE(device_, nullptr) << "no Vulkan device";
    }
    void TearDown() override {
        if (!device_) return;
        EXPECT_NO_THROW(device_->checkValidation());
    }

    static Device& device() { return *device_; }

private:
    static bool skipped() {
        const char* value = std::getenv("SLANT_TESTS_WITHOUT_VULKAN");
        return value && std::string_view(value) == "1";
    }

    inline static std::unique_ptr<Device> device_;
};

} // namespace slant::test
