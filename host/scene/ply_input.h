// The header of a PLY file and its numbers, in whatever format they are written.
#pragma once
#include "base/error.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32; ///< of the scalar, or of a list's items
    bool isList = false;
    PlyType countType = PlyType::uint8;
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

/// Reads the header when made, then hands out the body number by number. Every call throws Error(badInput)
/// where the file does not hold what it should.
class PlyInput {
public:
    /// Both must outlive this.
    PlyInput(std::string_view bytes, const std::string& name);

    const std::vector<PlyElement>& elements() const { return elements_; }

    /// Throws if the rest of the file is too short for `element.count` rows; call before allocating for them.
    void checkCount(const PlyElement& element) const;

    double scalar(PlyType type);
    /// Number of items that follow; at most as many as fit into the rest of the file.
    std::size_t listLength(const PlyProperty& property);
    void skip(const PlyProperty& property);

    /// An error at the present place: line of a text, byte of a binary file.
    Error error(const std::string& message) const;

private:
    enum class Format { ascii, littleEndian, bigEndian };

    void readHeader();
    void readFormat(std::string_view words);
    void readElement(std::string_view words);
    void readProperty(std::string_view words);
    std::string_view line();
    double asciiScalar();
    template <typename T>
    double binaryScalar();

    std::string_view bytes_;
    const std::string& name_;
    std::size_t offset_ = 0;
    Format format_ = Format::ascii;
    bool inHeader_ = true;
    std::vector<PlyElement> elements_;
};

} // namespace slant
