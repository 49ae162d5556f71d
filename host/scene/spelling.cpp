#include "scene/spelling.h"

#include <fmt/format.h>

namespace slant {

std::string printable(std::string_view text) {
    constexpr std::size_t kMaxShown = 40;
    std::string shown;
    for (const char c : text.substr(0, kMaxShown)) {
        if (c >= 32 && c < 127)
            shown += c;
        else
            shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    return text.size() > kMaxShown ? shown + "..." : shown;
}

} // namespace slant
