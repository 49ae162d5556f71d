#include "lightfield/tlfr.h"

#include "base/input_file.h"
#include "base/read_file.h"
#include "lightfield/tlfr_body.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace slant {
namespace {

/// Lens maps are the longest lines in a header.
constexpr std::uint64_t kMaxHeaderBytes = 1 << 25;

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Reads a header line by line.
class HeaderReader {
public:
    HeaderReader(const std::string& path, FieldFile& file, Monitor& monitor)
        : where_{path, 0, 0}, file_(file), monitor_(monitor) {}

    void read(std::string_view text) {
        while (!text.empty()) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            ++where_.line;
            line(trimmed(text.substr(0, end)));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        where_.line = 0;
        for (std::size_t i = 0; i < kEntries.size(); ++i)
            if (!seen_[i] && kEntries[i].required)
                throw badInput(where_, "the line '{} ...' is missing", kEntries[i].key);
        if (!columnsSeen_) throw badInput(where_, "the line '{}' is missing", kTlfrColumns);
        finish();
    }
    /// Of a header that has been read.
    TlfrMotion motion() const { return motion_; }

private:
    struct Entry {
        std::string_view key;
        void (HeaderReader::*take)(std::string_view value);
        bool required;
    };

    void line(std::string_view text) {
        if (text.empty()) return;
        if (columnsSeen_) return extension(text);
        for (std::size_t i = 0; i < kEntries.size(); ++i) {
            if (!text.starts_with(kEntries[i].key)) continue;
            if (seen_[i]) throw badInput(where_, "a second '{}'", kEntries[i].key);
            seen_[i] = true;
            text.remove_prefix(kEntries[i].key.size());
            return (this->*kEntries[i].take)(trimmed(text));
        }
        std::string columns(text);
        std::erase(columns, ' ');
        if (columns != kTlfrColumns) throw badInput(where_, "'{}' is not a line of a TLFR 1.3 header", text);
        columnsSeen_ = true;
    }

    void takeVersion(std::string_view value) {
        if (value != "1.3") throw badInput(where_, "version '{}' is not 1.3", value);
    }
    void takeWidth(std::string_view value) { file_.field.bounds.x1 = wholeNumber(value); }
    void takeHeight(std::string_view value) { file_.field.bounds.y1 = wholeNumber(value); }
    void takeSamples(std::string_view value) { file_.field.samplesPerPixel = wholeNumber(value); }
    void takeMotion(std::string_view value) {
        if (value != "perspective" && value != "affine")
            throw badInput(where_, "motion model '{}' is neither perspective nor affine", value);
        if (value == "affine") motion_ = TlfrMotion::affine;
    }
    void takeConstants(std::string_view value) {
        std::string text(value);
        const std::size_t comma = text.find(',');
        if (comma != std::string::npos) text[comma] = ' ';
        const auto numbers = parseNumbers(text, 2);
        if (!numbers || comma == std::string::npos)
            throw badInput(where_, "'{}' is not two numbers with a comma between", value);
        file_.field.slopeModel = {float((*numbers)[0]), float((*numbers)[1])};
    }
    void takeEncoding(std::string_view value) {
        if (value != "text" && value != "binary")
            throw badInput(where_, "encoding '{}' is neither text nor binary", value);
        file_.format = value == "text" ? FieldFormat::tlfrText : FieldFormat::tlfrBinary;
    }

    int wholeNumber(std::string_view text) const {
        int value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || value < 1)
            throw badInput(where_, "'{}' is not a whole number from 1 on", text);
        return value;
    }

    std::vector<int> wholeNumbers(const std::string& text, std::size_t count) const {
        const auto numbers = parseNumbers(text, count);
        std::vector<int> whole;
        for (std::size_t i = 0; numbers && i < count; ++i)
            if (std::abs((*numbers)[i]) <= 1e9 && int((*numbers)[i]) == (*numbers)[i])
                whole.push_back(int((*numbers)[i]));
        if (whole.size() != count) throw badInput(where_, "'{}' is not {} whole numbers", text, count);
        return whole;
    }

    /// A line after the columns: one of ours, or one that the format does not know.
    void extension(std::string_view text) {
        constexpr std::string_view kPrefix = "slant:";
        if (!text.starts_with(kPrefix)) {
            monitor_.warn(fmt::format("{}: the line '{}' is unknown and ignored", where_.text(), text));
            return;
        }
        text.remove_prefix(kPrefix.size());
        const std::string name(text.substr(0, text.find(' ')));
        const std::string value(trimmed(text.substr(name.size())));
        if (name == "origin") {
            const std::vector<int> xy = wholeNumbers(value, 2);
            origin_ = {xy[0], xy[1]};
        } else if (name == "frame") {
            frame_ = rect(value);
        } else if (name == "film") {
            film_ = rect(value);
        } else if (name == "lensMap") {
            file_.field.lensMap = lensMapOf(where_, floats(value));
        } else if (!setMetadata(file_.field, file_.details, where_, name, value)) {
            throw badInput(where_, "'slant:{}' is unknown", name);
        }
    }

    std::vector<float> floats(std::string_view text) const {
        std::vector<float> numbers;
        const char *place = text.data(), *const last = text.data() + text.size();
        while (place != last) {
            float number = 0;
            const auto [end, error] = std::from_chars(place, last, number);
            if (error != std::errc() || (end != last && *end != ' '))
                throw badInput(where_, "its {}th value is not a number", numbers.size() + 1);
            numbers.push_back(number);
            place = end == last ? end : end + 1;
        }
        return numbers;
    }

    Rect rect(const std::string& text) const {
        const std::vector<int> edges = wholeNumbers(text, 4);
        return {edges[0], edges[2], edges[1], edges[3]};
    }

    void finish() {
        Rect& bounds = file_.field.bounds;
        // Allows coordinates slightly beyond those of checkExtent, but none that overflows.
        constexpr int kLimit = 1 << 29;
        bounds = {std::clamp(origin_.x, -kLimit, kLimit), std::clamp(origin_.y, -kLimit, kLimit),
                  std::clamp(origin_.x, -kLimit, kLimit) + std::min(bounds.x1, kLimit),
                  std::clamp(origin_.y, -kLimit, kLimit) + std::min(bounds.y1, kLimit)};
        file_.field.frame = frame_.value_or(bounds);
        file_.details.film = film_.value_or(file_.field.frame);
        checkExtent(where_, file_.field, file_.details);
    }

    static constexpr std::array<Entry, 7> kEntries = {
        {{"Version", &HeaderReader::takeVersion, true},
         {"Width", &HeaderReader::takeWidth, true},
         {"Height", &HeaderReader::takeHeight, true},
         {"Samples per pixel", &HeaderReader::takeSamples, true},
         {"Motion model:", &HeaderReader::takeMotion, false},
         {"CoC coefficients (coc radius = C0/w+C1):", &HeaderReader::takeConstants, true},
         {"Encoding =", &HeaderReader::takeEncoding, true}}};

    FileLocation where_;
    FieldFile& file_;
    Monitor& monitor_;
    TlfrMotion motion_ = TlfrMotion::perspective;
    std::array<bool, 7> seen_{};
    bool columnsSeen_ = false;
    glm::ivec2 origin_{0, 0};
    std::optional<Rect> frame_, film_;
};

std::string rectText(const Rect& r) {
    return fmt::format("{} {} {} {}", r.x0, r.x1, r.y0, r.y1);
}

/// One line, whatever the text holds.
std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text + '\n';
}

std::string headerText(const LightField& field, const FieldMetadata& details, bool text) {
    std::string header =
        fmt::format("Version 1.3\nWidth {}\nHeight {}\nSamples per pixel {}\nMotion model: perspective\n"
                    "CoC coefficients (coc radius = C0/w+C1): {},{}\nEncoding = {}\n{}\n",
                    field.bounds.width(), field.bounds.height(), field.samplesPerPixel, field.slopeModel.c1,
                    field.slopeModel.c2, text ? "text" : "binary", kTlfrColumns);
    if (field.bounds.x0 != 0 || field.bounds.y0 != 0)
        header += fmt::format("slant:origin {} {}\n", field.bounds.x0, field.bounds.y0);
    if (field.frame != field.bounds) header += fmt::format("slant:frame {}\n", rectText(field.frame));
    if (details.film != field.frame) header += fmt::format("slant:film {}\n", rectText(details.film));
    if (!field.lensMap.empty())
        header += fmt::format("slant:lensMap {}\n", fmt::join(numbersOf(field.lensMap), " "));
    for (const auto& [name, value] : metadataOf(field, details)) {
        const std::string spelt = std::visit([](const auto& v) { return fmt::to_string(v); }, value);
        header += oneLine(name + ' ' + spelt);
    }
    return header;
}

} // namespace

FieldFile readTlfr(const std::string& bodyPath, const std::string& headerPath, Monitor& monitor) {
    const InputFile body(bodyPath);
    if (InputFile(headerPath).size() > kMaxHeaderBytes)
        throw badInput({headerPath}, "is longer than any TLFR header");
    FieldFile file;
    HeaderReader header(headerPath, file, monitor);
    header.read(readFile(headerPath));
    const bool text = file.format == FieldFormat::tlfrText;
    const std::uint64_t samples =
        std::uint64_t(file.field.bounds.area()) * std::uint64_t(file.field.samplesPerPixel);
    checkTlfrSize(body, samples, text);
    allocateSamples(file.field, {});
    monitor.beginStage("read", samples, "samples");
    (text ? readTlfrText : readTlfrBinary)(body, file.field, header.motion(), monitor);
    monitor.endStage();
    return file;
}

void writeTlfr(const std::string& path, const LightField& field, const FieldMetadata& details, bool text,
               Monitor& monitor) {
    if (hasOwnSlopes(field))
        throw Error(
            ErrorCode::usage,
            fmt::format("'{}': this field's slopes are not C1/w + C2, which is all that TLFR can say; write "
                        "deep OpenEXR",
                        path));
    if (!field.pixelStart.empty())
        throw Error(ErrorCode::usage,
                    fmt::format("'{}': the pixels of this field differ in their number of samples, and TLFR "
                                "knows one for all; write deep OpenEXR",
                                path));
    AtomicFile body(path), header(path + ".header");
    monitor.beginStage("write", field.samples.size(), "samples");
    if (text)
        writeTlfrText(body, field, monitor);
    else
        writeTlfrBinary(body, field, monitor);
    header.write(headerText(field, details, text));
    body.commit();
    header.commit();
    monitor.endStage();
}

} // namespace slant
