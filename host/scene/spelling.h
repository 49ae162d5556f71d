// Text from a file, for messages about it.
#pragma once
#include <string>
#include <string_view>

namespace slant {

/// `text` fit for one line of a message: control and non-ASCII bytes as \xNN, cut after 40 characters.
std::string printable(std::string_view text);

} // namespace slant
