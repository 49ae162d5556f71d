#include "base/error.h"

#include <cstdio>

int main() {
    std::fputs("slant: no command yet\n", stderr);
    return int(slant::ErrorCode::usage);
}
