// Deep OpenEXR files written with OpenEXR alone, right or wrong.
#pragma once
#include <ImathBox.h>
#include <OpenEXR/ImfBoxAttribute.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <functional>
#include <half.h>
#include <map>
#include <string>
#include <vector>

namespace slant::test {

/// A field of 5 x 4 pixels from (0, 0): every channel is constant, except raster.x and raster.y, which are
/// the centres of pixels.
struct DeepFile {
    Imf::Header header{5, 4};
    std::map<std::string, float> channels = {{"R", 0.5f},     {"G", 0.25f},    {"B", 1},      {"Z", 4},
                                             {"raster.x", 0}, {"raster.y", 0}, {"lens.u", 0}, {"lens.v", 0}};
    std::string halfChannel;  ///< stored as half floats
    std::string wholeChannel; ///< stored as whole numbers, which happen to have the bits of its floats
    std::function<unsigned(int x, int y)> count = [](int, int) { return 2u; };

    DeepFile() {
        header.setType(Imf::DEEPSCANLINE);
        header.compression() = Imf::ZIPS_COMPRESSION;
        header.insert("slant:c1", Imf::FloatAttribute(-8));
        header.insert("slant:c2", Imf::FloatAttribute(3));
    }

    /// Parts of the radiance, and the normals that they need.
    void addShading() {
        channels.insert({{"illumination.R", 0.75f},
                         {"illumination.G", 0.5f},
                         {"illumination.B", 2},
                         {"reflectance.R", 0.5f},
                         {"reflectance.G", 0.25f},
                         {"reflectance.B", 0.125f},
                         {"reflection.R", 0.0625f},
                         {"reflection.G", 0},
                         {"reflection.B", 1},
                         {"N.X", 0},
                         {"N.Y", -1},
                         {"N.Z", 0.5f}});
    }

    void write(const std::string& path) {
        const Imath::Box2i window = header.dataWindow();
        for (const auto& [name, value] : channels) header.channels().insert(name, Imf::Channel(typeOf(name)));
        Imf::DeepScanLineOutputFile file(path.c_str(), header);
        const int width = window.max.x - window.min.x + 1;
        for (int y = window.min.y; y <= window.max.y; ++y) {
            std::vector<unsigned> counts;
            for (int x = window.min.x; x <= window.max.x; ++x) counts.push_back(count(x, y));
            writeRow(file, window.min.x, y, width, counts);
        }
    }

private:
    Imf::PixelType typeOf(const std::string& name) const {
        return name == halfChannel ? Imf::HALF : name == wholeChannel ? Imf::UINT : Imf::FLOAT;
    }

    void writeRow(Imf::DeepScanLineOutputFile& file, int x0, int y, int width,
                  std::vector<unsigned>& counts) {
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(
            Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()) - x0 * long(sizeof(unsigned)),
                       sizeof(unsigned), 0));
        std::map<std::string, std::vector<std::vector<float>>> values;
        std::map<std::string, std::vector<std::vector<half>>> halves;
        std::map<std::string, std::vector<void*>> pointers;
        for (const auto& [name, value] : channels) {
            const bool isHalf = name == halfChannel;
            for (int x = 0; x < width; ++x) {
                const float number = name == "raster.x"   ? float(x0 + x) + 0.5f
                                     : name == "raster.y" ? float(y) + 0.5f
                                                          : value;
                values[name].emplace_back(counts[std::size_t(x)], number);
                halves[name].emplace_back(counts[std::size_t(x)], half(number));
                pointers[name].push_back(isHalf ? static_cast<void*>(halves[name].back().data())
                                                : values[name].back().data());
            }
            buffer.insert(name, Imf::DeepSlice(typeOf(name),
                                               reinterpret_cast<char*>(pointers[name].data()) -
                                                   x0 * long(sizeof(void*)),
                                               sizeof(void*), 0, isHalf ? sizeof(half) : sizeof(float)));
        }
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
};

} // namespace slant::test
