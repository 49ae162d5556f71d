// Radiance pictures (.hdr): colours with a common exponent, packed row by row.
#pragma once
#include "image/image.h"

#include <string>
#include <string_view>

namespace slant {

/// Its pixels, R, G, B, from the top; `path` is for messages. Throws Error(badInput) if it is damaged, cut
/// short, or has rows in another order.
Image parseRadiance(std::string_view bytes, const std::string& path);

} // namespace slant
