// The body of a TLFR file: sixteen numbers per sample, as float32 or as lines of text.
#pragma once
#include "base/atomic_file.h"
#include "base/input_file.h"
#include "base/monitor.h"
#include "lightfield/lightfield.h"

namespace slant {

/// The columns of a sample, as the header names them.
inline constexpr const char* kTlfrColumns = "x,y,z/w,w,u,v,t,r,g,b,a,mv_x,mv_y,mv_w,dwdx,dwdy";

/// Fill samples and radiance, which have the right size, and return how many samples have a motion that is
/// not zero. Throw Error(badInput) for a body that does not fit; the first does so before it reads.
void checkTlfrSize(const InputFile& body, std::uint64_t samples, bool text);
std::uint64_t readTlfrBinary(const InputFile& body, LightField& field, Monitor& monitor);
std::uint64_t readTlfrText(const InputFile& body, LightField& field, Monitor& monitor);

void writeTlfrBinary(AtomicFile& body, const LightField& field, Monitor& monitor);
void writeTlfrText(AtomicFile& body, const LightField& field, Monitor& monitor);

} // namespace slant
