// Writes a light field that Slant reconstructs, with OpenEXR alone: what another renderer would do with its
// own samples. Here these come from a scene that is a few lines long, a disc in front of a checkered wall.
//
//     g++ -std=c++17 -O2 scenes/export/write_field.cpp -o write_field $(pkg-config --cflags --libs OpenEXR)
//     ./write_field field.exr [SAMPLES PER PIXEL]
//     slant reconstruct field.exr -o picture.exr
#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <random>
#include <vector>

namespace {

// The camera: a thin lens at the origin that looks along +z, x to the right and y downwards as in the
// picture.
constexpr int kWidth = 96, kHeight = 64;
constexpr float kPixelsPerTangent = 100; // raster pixels per unit of x/z
constexpr float kLensRadius = 0.5f;      // in the unit of the scene, as all that follows
constexpr float kFocusDistance = 6;

// Moving the eye by one lens radius moves a point at depth w by kC1 / w + kC2 pixels the same way.
constexpr float kC1 = -kPixelsPerTangent * kLensRadius;
constexpr float kC2 = kPixelsPerTangent * kLensRadius / kFocusDistance;

constexpr float kDiscDepth = 4, kDiscRadius = 0.6f, kWallDepth = 9;

// Pixels beyond the picture that need samples too: the largest blur that can reach in, and a little more.
constexpr int kOverscan = 8;

/// One deep sample; every member is a channel of the file.
struct Sample {
    float rasterX, rasterY; // pixels; pixel (i, j) covers [i, i+1) x [j, j+1)
    float lensU, lensV;     // in the unit disc
    float z;                // depth along the viewing axis, > 0; infinite where nothing is hit
    float r, g, b;          // linear radiance
};

void shade(Sample& s) {
    // From the lens through the point of the plane in focus that the raster position looks at.
    const float focusX = (s.rasterX - kWidth / 2.f) / kPixelsPerTangent * kFocusDistance;
    const float focusY = (s.rasterY - kHeight / 2.f) / kPixelsPerTangent * kFocusDistance;
    const float lensX = kLensRadius * s.lensU, lensY = kLensRadius * s.lensV;
    const auto x = [&](float z) { return lensX + (focusX - lensX) * z / kFocusDistance; };
    const auto y = [&](float z) { return lensY + (focusY - lensY) * z / kFocusDistance; };
    if (std::hypot(x(kDiscDepth), y(kDiscDepth)) < kDiscRadius) {
        s.z = kDiscDepth;
        s.r = 0.9f, s.g = 0.4f, s.b = 0.1f;
    } else {
        const bool odd = (int(std::floor(x(kWallDepth))) + int(std::floor(y(kWallDepth)))) & 1;
        s.z = kWallDepth;
        s.r = s.g = s.b = odd ? 0.8f : 0.15f;
    }
}

/// Any pattern will do; this one spreads the samples of a pixel over pixel and lens, each in its own cell.
std::vector<Sample> samplesOfPixel(int column, int row, int count, std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto below = [](float value, int next) {
        return std::min(value, std::nextafter(float(next), -1e9f));
    };
    const int columns = int(std::ceil(std::sqrt(float(count)))), rows = (count + columns - 1) / columns;
    const float turn = uniform(random);
    std::vector<Sample> samples;
    for (int i = 0; i < count; ++i) {
        Sample s;
        s.rasterX =
            below(float(column) + (float(i % columns) + uniform(random)) / float(columns), column + 1);
        s.rasterY = below(float(row) + (float(i / columns) + uniform(random)) / float(rows), row + 1);
        const float radius = std::sqrt((float(i) + uniform(random)) / float(count));
        const float angle = 6.2831853f * (turn + 0.618034f * float(i));
        s.lensU = radius * std::cos(angle);
        s.lensV = radius * std::sin(angle);
        shade(s);
        samples.push_back(s);
    }
    return samples;
}

Imf::Header makeHeader() {
    // The display window is the picture, the data window holds every pixel that has samples.
    const Imath::Box2i picture({0, 0}, {kWidth - 1, kHeight - 1});
    const Imath::Box2i traced({-kOverscan, -kOverscan}, {kWidth + kOverscan - 1, kHeight + kOverscan - 1});
    Imf::Header header(picture, traced);
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    for (const char* name : {"raster.x", "raster.y", "lens.u", "lens.v", "Z", "R", "G", "B"})
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    header.insert("slant:c1", Imf::FloatAttribute(kC1));
    header.insert("slant:c2", Imf::FloatAttribute(kC2));
    // What follows is optional.
    header.insert("slant:lensRadius", Imf::FloatAttribute(kLensRadius));
    header.insert("slant:filter", Imf::StringAttribute("gaussian 1.5 1.5 0.5"));
    header.insert("slant:source", Imf::StringAttribute("scenes/export/write_field.cpp"));
    return header;
}

void writeRow(Imf::DeepScanLineOutputFile& file, int row, int samplesPerPixel, std::mt19937& random) {
    const Imath::Box2i window = file.header().dataWindow();
    const std::size_t width = std::size_t(window.max.x - window.min.x + 1);
    std::vector<std::vector<Sample>> pixels;
    std::vector<unsigned> counts(width, unsigned(samplesPerPixel)); // each pixel may have its own
    for (int column = window.min.x; column <= window.max.x; ++column)
        pixels.push_back(samplesOfPixel(column, row, samplesPerPixel, random));

    // OpenEXR takes the address of each pixel's first sample, in each channel, and counts pixels from x = 0.
    // With a y stride of 0 the same addresses serve every row.
    const auto atColumn0 = [&](auto* first) { return reinterpret_cast<char*>(first - window.min.x); };
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, atColumn0(counts.data()), sizeof(unsigned), 0));
    std::vector<std::vector<float*>> addresses;
    addresses.reserve(8);
    const auto add = [&](const char* name, float Sample::*member) {
        addresses.emplace_back();
        for (std::vector<Sample>& samples : pixels) addresses.back().push_back(&(samples.front().*member));
        buffer.insert(name, Imf::DeepSlice(Imf::FLOAT, atColumn0(addresses.back().data()), sizeof(float*), 0,
                                           sizeof(Sample)));
    };
    add("raster.x", &Sample::rasterX);
    add("raster.y", &Sample::rasterY);
    add("lens.u", &Sample::lensU);
    add("lens.v", &Sample::lensV);
    add("Z", &Sample::z);
    add("R", &Sample::r);
    add("G", &Sample::g);
    add("B", &Sample::b);
    file.setFrameBuffer(buffer);
    file.writePixels(1);
}

} // namespace

int main(int argc, char** argv) {
    const int samplesPerPixel = argc == 3 ? std::atoi(argv[2]) : 8;
    if (argc < 2 || argc > 3 || samplesPerPixel < 1) {
        std::cerr << "usage: write_field FILE.exr [SAMPLES PER PIXEL]\n";
        return 2;
    }
    try {
        const Imf::Header header = makeHeader();
        Imf::DeepScanLineOutputFile file(argv[1], header);
        std::mt19937 random(1);
        for (int row = header.dataWindow().min.y; row <= header.dataWindow().max.y; ++row)
            writeRow(file, row, samplesPerPixel, random);
    } catch (const std::exception& error) {
        std::cerr << "write_field: " << error.what() << '\n';
        return 1;
    }
}
