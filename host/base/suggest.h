// "Did you mean": the name in a list that is nearest to a misspelt one.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

/// The candidate with the fewest edits (insert, delete, replace, swap neighbours; Damerau 1964) from `word`,
/// letter case aside; empty if none is within a third of the word's length (at least one edit), or if it is
/// one letter.
std::string closestName(std::string_view word, std::span<const std::string_view> candidates);

/// ", did you mean 'NAME'?" for the end of a message, or nothing. `names` is any range of strings.
template <typename Names>
std::string didYouMean(std::string_view word, const Names& names) {
    const std::string name =
        closestName(word, std::vector<std::string_view>(std::begin(names), std::end(names)));
    return name.empty() ? "" : ", did you mean '" + name + "'?";
}

} // namespace slant
