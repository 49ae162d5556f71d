// A digest of contents, for cache keys; it does not resist deliberate collisions.
#pragma once
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <type_traits>

namespace slant {

/// FNV-1a of 64 bits (Fowler, Noll and Vo). Successive calls hash one continuous sequence of bytes.
class Hash {
public:
    void addBytes(std::string_view bytes) {
        for (const char byte : bytes) state_ = (state_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
    }
    /// Length and bytes, so that "ab", "c" and "a", "bc" differ.
    void add(std::string_view text) {
        add(std::uint64_t(text.size()));
        addBytes(text);
    }
    template <typename Number>
    requires std::is_arithmetic_v<Number>
    void add(Number number) { addBytes({reinterpret_cast<const char*>(&number), sizeof number}); }

    /// 16 hexadecimal digits.
    std::string hex() const { return fmt::format("{:016x}", state_); }

private:
    std::uint64_t state_ = 0xcbf29ce484222325;
};

} // namespace slant
