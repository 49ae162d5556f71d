// The body of a TLFR file: sixteen numbers per sample, as float32 or as lines of text.
#pragma once
#include "base/atomic_file.h"
#include "base/input_file.h"
#include "base/monitor.h"
#include "lightfield/lightfield.h"

namespace slant {

/// The columns of a sample, as the header names them.
inline constexpr const char* kTlfrColumns = "x,y,z/w,w,u,v,t,r,g,b,a,mv_x,mv_y,mv_w,dwdx,dwdy";

/// How a header says that points move.
enum class TlfrMotion {
    perspective, ///< mv is the m of lightfield.h
    affine,      ///< mv is in pixels and in the unit of w: p' = p + (t' - t) mv.xy, w' = w + (t' - t) mv.w
};

/// Fill samples and radiance, which have the right size, and motion if anything moves. Affine motion becomes
/// the m with the same place and velocity on screen at the sample's own time, and the same depths. Throw
/// Error(badInput) for a body that does not fit; the first does so before it reads.
void checkTlfrSize(const InputFile& body, std::uint64_t samples, bool text);
void readTlfrBinary(const InputFile& body, LightField& field, TlfrMotion model, Monitor& monitor);
void readTlfrText(const InputFile& body, LightField& field, TlfrMotion model, Monitor& monitor);

void writeTlfrBinary(AtomicFile& body, const LightField& field, Monitor& monitor);
void writeTlfrText(AtomicFile& body, const LightField& field, Monitor& monitor);

} // namespace slant
