// Layout of an aperture's table (Aperture::table of host/camera/aperture.h), for C++ and GLSL.
#ifndef SLANT_SHARED_APERTURE_H
#define SLANT_SHARED_APERTURE_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

/// Of an aperture that is given by weights; both powers of two.
SLANT_SHARED_CONSTANT int kApertureSectors = 512;
SLANT_SHARED_CONSTANT int kApertureRings = 128;

SLANT_SHARED_END

#endif
