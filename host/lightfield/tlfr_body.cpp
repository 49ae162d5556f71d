#include "lightfield/tlfr_body.h"

#include "base/error.h"
#include "base/parallel.h"
#include "lightfield/field_file.h"
#include "lightfield/motion.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <mutex>
#include <string_view>

namespace slant {
namespace {

static_assert(std::endian::native == std::endian::little, "the binary form is read as it stands");

constexpr std::size_t kColumns = 16;
using Record = std::array<float, kColumns>;
static_assert(sizeof(Record) == 64);

/// Sixteen digits, fifteen commas and a line's end.
constexpr std::uint64_t kShortestLine = 32;
constexpr std::size_t kRecordsAtATime = 1 << 14;
constexpr std::size_t kTextAtATime = 1 << 25;

LightFieldSample sampleOf(const Record& r, const SlopeModel& slope) {
    return {r[0], r[1], r[4], r[5], r[6], r[3], slope(r[3]), std::isinf(r[3]) ? 0.f : 1.f};
}

glm::vec3 radianceOf(const Record& r) {
    return {r[7], r[8], r[9]};
}

Record recordOf(const LightField& field, std::size_t i) {
    const LightFieldSample& s = field.samples[i];
    const glm::vec3& rgb = field.radiance[i];
    const glm::vec3 m = field.moves() ? field.motion[i] : glm::vec3(0);
    return {s.x, s.y, 0, s.w, s.u, s.v, s.t, rgb.r, rgb.g, rgb.b, s.alpha, m.x, m.y, m.z, 0, 0};
}

/// Puts records into a field. There is no room for motion until something moves.
class RecordTaker {
public:
    RecordTaker(LightField& field, TlfrMotion model) : field_(field), model_(model) {}

    /// Of different samples, from any thread.
    void take(std::size_t i, const Record& r) {
        const LightFieldSample& s = field_.samples[i] = sampleOf(r, field_.slopeModel);
        field_.radiance[i] = radianceOf(r);
        const glm::vec3 m(r[11], r[12], r[13]);
        if (isPlusZero(m)) return;
        std::call_once(moves_, [&] { allocateMotion(field_); });
        field_.motion[i] = model_ == TlfrMotion::affine ? perspectiveMotion(s, m) : m;
    }
    void finish() { dropZeroMotion(field_); }

private:
    /// -0 is kept as it is.
    static bool isPlusZero(const glm::vec3& m) {
        return m == glm::vec3(0) && !std::signbit(m.x) && !std::signbit(m.y) && !std::signbit(m.z);
    }
    glm::vec3 perspectiveMotion(const LightFieldSample& s, const glm::vec3& affine) const {
        const glm::vec2 p = pinholePosition(field_, s);
        return {(std::isinf(s.w) ? 1 : s.w) * glm::vec2(affine) + affine.z * p, affine.z};
    }

    LightField& field_;
    TlfrMotion model_;
    std::once_flag moves_;
};

/// Lines of a text, and the place of them and their samples in the whole.
struct Piece {
    std::string_view text;
    std::uint64_t firstLine = 0, firstSample = 0;
};

bool isBlank(std::string_view line) {
    return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

/// Calls visit(line) for every line, the last one with or without its end.
template <typename Visit>
void forEachLine(std::string_view text, const Visit& visit) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        visit(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// Cut after line ends.
std::vector<Piece> cut(std::string_view text, std::size_t size) {
    std::vector<Piece> pieces;
    while (!text.empty()) {
        const std::size_t end =
            std::min(text.find('\n', std::min(size, text.size() - 1)), text.size() - 1) + 1;
        pieces.push_back({text.substr(0, end)});
        text.remove_prefix(end);
    }
    return pieces;
}

/// A number that no float can hold becomes infinite or zero.
bool parseFloat(const char*& place, const char* last, float& value) {
    while (place != last && *place == ' ') ++place;
    auto [end, error] = std::from_chars(place, last, value);
    if (error == std::errc::result_out_of_range) {
        double wide = 0;
        if (std::from_chars(place, last, wide).ec != std::errc()) return false;
        value = float(wide);
    } else if (error != std::errc()) {
        return false;
    }
    place = end;
    while (place != last && (*place == ' ' || *place == '\r')) ++place;
    return true;
}

Record parseLine(std::string_view line, const FileLocation& where) {
    Record record;
    const char *place = line.data(), *const last = line.data() + line.size();
    for (std::size_t i = 0; i < kColumns; ++i) {
        const char* const start = place;
        const bool parsed = parseFloat(place, last, record[i]);
        const bool more = i + 1 < kColumns;
        if (!parsed || (more ? place == last || *place != ',' : place != last))
            throw badInput({where.file, where.line, int(start - line.data()) + 1},
                           "a sample is {} numbers with commas between; number {} is wrong", kColumns, i + 1);
        place += more;
    }
    return record;
}

void parsePiece(const Piece& piece, const std::string& path, RecordTaker& taker) {
    std::uint64_t line = piece.firstLine, sample = piece.firstSample;
    forEachLine(piece.text, [&](std::string_view text) {
        ++line;
        if (!isBlank(text)) taker.take(sample++, parseLine(text, {path, int(line), 0}));
    });
}

/// Places the pieces one after another; returns where the next one would come.
Piece placePieces(std::vector<Piece>& pieces, Piece next) {
    std::vector<Piece> counts(pieces.size());
    parallelFor(0, pieces.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            forEachLine(pieces[i].text, [&](std::string_view line) {
                ++counts[i].firstLine;
                counts[i].firstSample += !isBlank(line);
            });
    });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        pieces[i].firstLine = next.firstLine;
        pieces[i].firstSample = next.firstSample;
        next.firstLine += counts[i].firstLine;
        next.firstSample += counts[i].firstSample;
    }
    return next;
}

void appendNumber(std::string& text, float value, char separator) {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    text += separator;
}

} // namespace

void checkTlfrSize(const InputFile& body, std::uint64_t samples, bool text) {
    if (text ? body.size() < samples * kShortestLine - 1 : body.size() != samples * sizeof(Record))
        throw badInput({body.path()}, "holds {} bytes; the {} samples of its header take {}{}", body.size(),
                       samples, text ? "at least " : "", samples * (text ? kShortestLine : sizeof(Record)));
}

void readTlfrBinary(const InputFile& body, LightField& field, TlfrMotion model, Monitor& monitor) {
    RecordTaker taker(field, model);
    parallelFor(0, field.samples.size(), kRecordsAtATime, [&](std::size_t first, std::size_t last) {
        std::vector<Record> records(std::min(kRecordsAtATime, last - first));
        for (std::size_t i = first; i < last; i += records.size()) {
            const std::size_t count = std::min(records.size(), last - i);
            body.read(i * sizeof(Record), records.data(), count * sizeof(Record));
            for (std::size_t k = 0; k < count; ++k) taker.take(i + k, records[k]);
            monitor.advance(count);
        }
    });
    taker.finish();
}

void readTlfrText(const InputFile& body, LightField& field, TlfrMotion model, Monitor& monitor) {
    RecordTaker taker(field, model);
    std::string text;
    Piece next;
    for (std::uint64_t offset = 0; offset < body.size();) {
        text.resize(std::size_t(std::min<std::uint64_t>(kTextAtATime, body.size() - offset)));
        body.read(offset, text.data(), text.size());
        std::string_view lines = text;
        if (offset + text.size() < body.size()) lines = lines.substr(0, lines.rfind('\n') + 1);
        if (lines.empty())
            throw badInput({body.path(), int(next.firstLine) + 1, 0}, "this line is not a sample");
        std::vector<Piece> pieces = cut(lines, kTextAtATime / 64);
        const std::uint64_t before = next.firstSample;
        next = placePieces(pieces, next);
        if (next.firstSample > field.samples.size())
            throw badInput({body.path()}, "holds more than the {} samples of its header",
                           field.samples.size());
        parallelFor(0, pieces.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) parsePiece(pieces[i], body.path(), taker);
        });
        monitor.advance(next.firstSample - before);
        offset += lines.size();
    }
    if (next.firstSample != field.samples.size())
        throw badInput({body.path()}, "holds {} samples; its header has {}", next.firstSample,
                       field.samples.size());
    taker.finish();
}

void writeTlfrBinary(AtomicFile& body, const LightField& field, Monitor& monitor) {
    std::vector<Record> records;
    for (std::size_t i = 0; i < field.samples.size(); i += records.size()) {
        records.resize(std::min(kRecordsAtATime, field.samples.size() - i));
        for (std::size_t k = 0; k < records.size(); ++k) records[k] = recordOf(field, i + k);
        body.write(records.data(), records.size() * sizeof(Record));
        monitor.advance(records.size());
    }
}

void writeTlfrText(AtomicFile& body, const LightField& field, Monitor& monitor) {
    constexpr std::size_t kPieces = 64;
    std::vector<std::string> pieces(kPieces);
    for (std::size_t i = 0; i < field.samples.size(); i += kPieces * kRecordsAtATime) {
        parallelFor(0, kPieces, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t piece = first; piece < last; ++piece) {
                pieces[piece].clear();
                const std::size_t begin = std::min(i + piece * kRecordsAtATime, field.samples.size());
                const std::size_t end = std::min(begin + kRecordsAtATime, field.samples.size());
                for (std::size_t k = begin; k < end; ++k) {
                    const Record record = recordOf(field, k);
                    for (std::size_t c = 0; c < kColumns; ++c)
                        appendNumber(pieces[piece], record[c], c + 1 < kColumns ? ',' : '\n');
                }
            }
        });
        for (const std::string& piece : pieces) body.write(piece);
        monitor.advance(std::min(kPieces * kRecordsAtATime, field.samples.size() - i));
    }
}

} // namespace slant
