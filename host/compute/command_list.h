// Records dispatches, runs them in order on the device and times each of them.
//
// A full memory barrier follows every command, so each sees all that those before it wrote. Buffers and
// passes must live, and buffers must not be uploaded or downloaded, from recording until wait() returns.
#pragma once
#include "compute/buffer.h"
#include "compute/pass.h"

#include <functional>
#include <initializer_list>
#include <type_traits>

namespace slant {

/// Device time of all commands with one name.
struct PassTime {
    std::string name; ///< the shader's, or "fill"
    double seconds = 0;
    std::uint64_t dispatches = 0;
};

class CommandList {
public:
    explicit CommandList(Device& device);
    /// Waits for what was submitted.
    ~CommandList();
    CommandList(const CommandList&) = delete;
    CommandList& operator=(const CommandList&) = delete;

    /// The buffer at binding 0, at binding 1, ...
    using Bindings = std::initializer_list<std::reference_wrapper<const Buffer>>;

    /// Throws Error(usage) where number or format of the buffers or the size of `push` is not what the shader
    /// declares, or the grid is over the device's limits. An empty grid records nothing.
    template <typename Push>
    void dispatch(const Pass& pass, Bindings buffers, const Push& push, Grid grid) {
        static_assert(std::is_trivially_copyable_v<Push>);
        dispatchBytes(pass, buffers, std::as_bytes(std::span(&push, 1)), grid);
    }

    /// Sets every 32-bit word of the buffer.
    void fill(const Buffer& buffer, std::uint32_t word);

    /// Starts what was recorded and returns; nothing can be recorded before wait().
    void submit();
    /// Waits for the submitted commands, adds up their times, and leaves the list empty. Throws Error(device)
    /// if the device was lost or validation complained.
    void wait();
    void run() {
        submit();
        wait();
    }

    /// Sums over every run since the last call, in the order in which names first came; no seconds where the
    /// device has no timestamps.
    std::vector<PassTime> takePassTimes();

private:
    void dispatchBytes(const Pass& pass, Bindings buffers, std::span<const std::byte> push, Grid grid);

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace slant
