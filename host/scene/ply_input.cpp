#include "scene/ply_input.h"

#include "scene/spelling.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace slant {
namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
    std::size_t bytes;
};

constexpr TypeName kTypeNames[] = {
    {"char", PlyType::int8, 1},       {"int8", PlyType::int8, 1},       {"uchar", PlyType::uint8, 1},
    {"uint8", PlyType::uint8, 1},     {"short", PlyType::int16, 2},     {"int16", PlyType::int16, 2},
    {"ushort", PlyType::uint16, 2},   {"uint16", PlyType::uint16, 2},   {"int", PlyType::int32, 4},
    {"int32", PlyType::int32, 4},     {"uint", PlyType::uint32, 4},     {"uint32", PlyType::uint32, 4},
    {"float", PlyType::float32, 4},   {"float32", PlyType::float32, 4}, {"double", PlyType::float64, 8},
    {"float64", PlyType::float64, 8},
};

constexpr std::size_t kMaxHeaderItems = 1000; // elements and properties; no real file has a hundred

std::size_t bytesOf(PlyType type) {
    for (const TypeName& t : kTypeNames)
        if (t.type == type) return t.bytes;
    return 1;
}

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Takes the first word off `words`.
std::string_view takeWord(std::string_view& words) {
    std::size_t first = 0;
    while (first < words.size() && isBlank(words[first])) ++first;
    std::size_t end = first;
    while (end < words.size() && !isBlank(words[end])) ++end;
    const std::string_view word = words.substr(first, end - first);
    words.remove_prefix(end);
    return word;
}

} // namespace

PlyInput::PlyInput(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    readHeader();
    inHeader_ = false;
}

Error PlyInput::error(const std::string& message) const {
    if (!inHeader_ && format_ != Format::ascii)
        return badInput({name_, 0, 0}, "{} (at byte {})", message, offset_);
    // The error ends just before the offset, which for a header line lies past its line break.
    const std::size_t end = offset_ - (inHeader_ && offset_ > 0 && bytes_[offset_ - 1] == '\n' ? 1 : 0);
    return badInput(
        {name_, 1 + int(std::count(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(end), '\n')), 0}, "{}",
        message);
}

std::string_view PlyInput::line() {
    if (offset_ == bytes_.size()) throw error("the file ends within its PLY header");
    const std::size_t end = std::min(bytes_.find('\n', offset_), bytes_.size());
    std::string_view text = bytes_.substr(offset_, end - offset_);
    offset_ = std::min(end + 1, bytes_.size());
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
}

void PlyInput::readFormat(std::string_view words) {
    const std::string_view format = takeWord(words), version = takeWord(words);
    if (format == "ascii")
        format_ = Format::ascii;
    else if (format == "binary_little_endian")
        format_ = Format::littleEndian;
    else if (format == "binary_big_endian")
        format_ = Format::bigEndian;
    else
        throw error(fmt::format("unknown PLY format '{}'", printable(format)));
    if (version != "1.0") throw error(fmt::format("unknown PLY version '{}'", printable(version)));
}

void PlyInput::readElement(std::string_view words) {
    PlyElement element;
    element.name = takeWord(words);
    const std::string_view count = takeWord(words);
    const auto [end, status] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || status != std::errc() || end != count.data() + count.size())
        throw error(fmt::format("'{}' is not a number of elements", printable(count)));
    elements_.push_back(std::move(element));
}

void PlyInput::readProperty(std::string_view words) {
    const auto takeType = [&] {
        const std::string_view word = takeWord(words);
        for (const TypeName& type : kTypeNames)
            if (type.name == word) return type.type;
        throw error(fmt::format("unknown PLY type '{}'", printable(word)));
    };
    if (elements_.empty()) throw error("a property stands before any element");
    PlyProperty property;
    std::string_view rest = words;
    if (takeWord(rest) == "list") {
        words = rest;
        property.isList = true;
        property.countType = takeType();
    }
    property.type = takeType();
    property.name = takeWord(words);
    if (property.name.empty()) throw error("a property has no name");
    elements_.back().properties.push_back(std::move(property));
}

void PlyInput::readHeader() {
    if (bytes_.substr(0, 3) != "ply" || line() != "ply") throw error("this is not a PLY file");
    bool hasFormat = false;
    for (std::size_t items = 0;; ++items) {
        std::string_view words = line();
        const std::string_view keyword = takeWord(words);
        if (keyword == "end_header") break;
        if (items > kMaxHeaderItems) throw error("the PLY header is too long");
        if (keyword == "format") {
            readFormat(words);
            hasFormat = true;
        } else if (keyword == "element") {
            readElement(words);
        } else if (keyword == "property") {
            readProperty(words);
        } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
            throw error(fmt::format("unknown keyword '{}' in the PLY header", printable(keyword)));
        }
    }
    if (!hasFormat) throw error("the PLY header names no format");
}

void PlyInput::checkCount(const PlyElement& element) const {
    std::size_t rowBytes = 0;
    for (const PlyProperty& property : element.properties)
        rowBytes +=
            format_ == Format::ascii ? 2 : bytesOf(property.isList ? property.countType : property.type);
    // The last number of a text needs no white space after it.
    const std::size_t left = bytes_.size() - offset_ + (format_ == Format::ascii ? 1 : 0);
    if (rowBytes > 0 && element.count > left / rowBytes)
        throw error(
            fmt::format("the file is too short for {} {} rows", element.count, printable(element.name)));
}

template <typename T>
double PlyInput::binaryScalar() {
    if (bytes_.size() - offset_ < sizeof(T)) throw error("the file ends too early");
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + offset_, sizeof(T));
    offset_ += sizeof(T);
    if ((format_ == Format::littleEndian) != (std::endian::native == std::endian::little))
        std::reverse(raw.begin(), raw.end());
    return double(std::bit_cast<T>(raw));
}

double PlyInput::asciiScalar() {
    while (offset_ < bytes_.size() && isBlank(bytes_[offset_])) ++offset_;
    if (offset_ == bytes_.size()) throw error("the file ends too early");
    const std::size_t first = offset_;
    while (offset_ < bytes_.size() && !isBlank(bytes_[offset_])) ++offset_;
    std::string_view word = bytes_.substr(first, offset_ - first);
    if (word[0] == '+') word.remove_prefix(1);
    double value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status == std::errc::invalid_argument || end != word.data() + word.size())
        throw error(fmt::format("expected a number, found '{}'", printable(word)));
    // Too small for a double reads as 0, too large as infinity, which the caller refuses.
    if (status == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
    return value;
}

double PlyInput::scalar(PlyType type) {
    if (format_ == Format::ascii) return asciiScalar();
    switch (type) {
    case PlyType::int8:
        return binaryScalar<std::int8_t>();
    case PlyType::uint8:
        return binaryScalar<std::uint8_t>();
    case PlyType::int16:
        return binaryScalar<std::int16_t>();
    case PlyType::uint16:
        return binaryScalar<std::uint16_t>();
    case PlyType::int32:
        return binaryScalar<std::int32_t>();
    case PlyType::uint32:
        return binaryScalar<std::uint32_t>();
    case PlyType::float32:
        return binaryScalar<float>();
    default:
        return binaryScalar<double>();
    }
}

std::size_t PlyInput::listLength(const PlyProperty& property) {
    const double length = scalar(property.countType);
    const std::size_t itemBytes = format_ == Format::ascii ? 1 : bytesOf(property.type);
    if (!(length >= 0 && length <= double((bytes_.size() - offset_) / itemBytes)))
        throw error(
            fmt::format("a list of '{}' cannot have {} items here", printable(property.name), length));
    return std::size_t(length);
}

void PlyInput::skip(const PlyProperty& property) {
    const std::size_t count = property.isList ? listLength(property) : 1;
    for (std::size_t i = 0; i < count; ++i) scalar(property.type);
}

} // namespace slant
