#include "base/suggest.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace slant {
namespace {

std::string lowerCase(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// Edit distance of optimal string alignment, by dynamic programming over three rows.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        beforeLast.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
    }
    return row[b.size()];
}

} // namespace

std::string closestName(std::string_view word, std::span<const std::string_view> candidates) {
    // None of our names is nearly this long, and the distance takes quadratic time. One letter is like any
    // other.
    if (word.size() > 100 || word.size() < 2) return {};
    const std::string wanted = lowerCase(word);
    std::size_t best = std::max<std::size_t>(1, word.size() / 3) + 1;
    std::string name;
    for (const std::string_view candidate : candidates) {
        const std::size_t distance = editDistance(wanted, lowerCase(candidate));
        if (distance < best) {
            best = distance;
            name = candidate;
        }
    }
    return name;
}

} // namespace slant
