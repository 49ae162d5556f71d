// A place in scene text, cheap enough to store with every token and parameter.
#pragma once
#include "base/error.h"

namespace slant {

/// Counts from 1. `file` is owned by the reader and outlives every Position that points to it.
struct Position {
    const std::string* file = nullptr;
    int line = 0, column = 0;

    operator FileLocation() const { return {file ? *file : std::string(), line, column}; }
};

} // namespace slant
