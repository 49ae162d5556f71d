#include "report/page.h"

#include "base/read_file.h"
#include "reconstruct/options.h"
#include "report/chart.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace slant {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Slant: speed against error</title>
<style>
:root { color-scheme: light dark; --ground: #ffffff; --text: #1c1c20; --faint: #66666e; --line: #d8d8de; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #16161a; --text: #e6e6ea; --faint: #a0a0aa; --line: #3a3a42; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1rem; max-width: 76rem; background: var(--ground); color: var(--text);
  font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; margin: 0.5rem 0; }
h2 { font-size: 1.3rem; margin: 2.5rem 0 0.5rem; padding-top: 0.5rem; border-top: 1px solid var(--line); }
p { max-width: 46rem; }
code { overflow-wrap: anywhere; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2rem 0.7rem; border-bottom: 1px solid var(--line); }
th, td { text-align: right; white-space: nowrap; }
th { color: var(--faint); font-weight: normal; }
.name { text-align: left; }
.charts, .pictures { display: grid; gap: 1rem; }
.pictures { grid-template-columns: repeat(auto-fill, minmax(min(100%, 17rem), 1fr)); }
.charts { grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); }
.charts svg { width: 100%; height: auto; }
@media (prefers-color-scheme: dark) { .charts svg { filter: invert(0.91) hue-rotate(180deg); } }
figure { margin: 0; }
figure img { width: 100%; display: block; }
figcaption { font-size: 0.9rem; padding: 0.3rem 0; }
figcaption span { color: var(--faint); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.2rem 1rem; }
dt { color: var(--faint); }
dd { margin: 0; overflow-wrap: anywhere; }
@media (max-width: 30rem) {
  body { padding: 0.7rem; }
  table { font-size: 0.85rem; }
  th, td { padding: 0.2rem 0.35rem; }
  dl { display: block; }
  dd { margin-bottom: 0.5rem; }
}
</style>
</head>
<body>
)";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    return result;
}

/// RFC 4648.
std::string base64(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

/// "12 ms", "1.23 s" or "123 s".
std::string secondsText(double seconds) {
    if (seconds < 0.9995) return fmt::format("{:.{}f} ms", 1000 * seconds, seconds < 0.00995 ? 1 : 0);
    return fmt::format("{:.{}f} s", seconds, seconds < 9.995 ? 2 : seconds < 99.95 ? 1 : 0);
}

std::string settingText(const Point& p) {
    return p.outputs > 0 ? fmt::format("{} \u2192 {}", p.spp, p.outputs) : fmt::format("{}", p.spp);
}

class Page {
public:
    Page(const Results& results, std::span<const SceneCharts> charts, std::string directory)
        : results_(results), charts_(charts), directory_(std::move(directory)) {}

    std::string text() && {
        html_ = kHead;
        html_ +=
            "<h1>Speed against error</h1>\n"
            "<p>Each method reconstructs a picture from a few samples per pixel; the reference is brute "
            "force at rising sample counts. Errors are against a ground truth of other samples: relMSE is "
            "the mean of err\u00b2/(truth\u00b2 + 0.01), FLIP what a person sees who flips between the "
            "two, 0 to 1.</p>\n";
        addGains();
        for (std::size_t i = 0; i < results_.scenes.size(); ++i) addScene(results_.scenes[i], charts_[i]);
        addTable();
        addCircumstances();
        return std::move(html_) + "</body>\n</html>\n";
    }

private:
    void addGains() {
        html_ += "<div class=\"scroll\"><table>\n<tr><th></th><th></th>";
        for (const double error : kGainErrors)
            html_ += fmt::format("<th colspan=\"2\">relMSE {:g}</th>", error);
        html_ += "</tr>\n<tr><th class=\"name\">scene</th><th class=\"name\">method</th>";
        for (std::size_t i = 0; i < std::size(kGainErrors); ++i) html_ += "<th>speed</th><th>accuracy</th>";
        html_ += "</tr>\n";
        for (const SceneSummary& scene : results_.scenes) {
            const std::vector<MethodGain> gains = gainsOf(results_.of(scene));
            for (std::size_t i = 0; i < gains.size(); ++i) {
                if (i % std::size(kGainErrors) == 0)
                    html_ += fmt::format("<tr><td class=\"name\">{}</td><td class=\"name\">{}, {}</td>",
                                         escaped(scene.name), gains[i].method,
                                         escaped(shortDevice(gains[i].device)));
                html_ += fmt::format("<td>{}</td><td>{}</td>", factorText(gains[i].gain.equalError),
                                     factorText(gains[i].gain.equalTime));
            }
            html_ += "\n";
        }
        html_ +=
            "</table></div>\n<p>Against the reference: how many times faster a method reaches a relMSE "
            "(speed), and "
            "how many times less its error is then than the reference's in the same time (accuracy), on "
            "lines "
            "between the measured points; \u2265 where a curve ends before, \u2014 where the error is not "
            "reached.</p>\n";
    }

    void addScene(const SceneSummary& scene, const SceneCharts& charts) {
        const std::vector<Point> points = results_.of(scene);
        html_ += fmt::format("<h2>{}</h2>\n<div class=\"charts\">\n", escaped(scene.name));
        for (const std::string& svg : {charts.relMse, charts.flip}) html_ += svg.substr(svg.find("<svg"));
        html_ += "</div>\n<p>Below each picture, the FLIP of its pixels: black is 0, pale yellow 0.4 and "
                 "more.</p>\n"
                 "<div class=\"pictures\">\n";
        addFigure({scene.truthPicture}, "ground truth", fmt::format("{} samples per pixel", scene.truthSpp));
        const Point* usual = nullptr; // the default method, else the last one
        for (const Point& p : points) {
            if (p.picture.empty() || p.isReference()) continue;
            addPoint(p, p.method);
            if (!usual || usual->method != nameOf(ReconstructOptions().method)) usual = &p;
        }
        if (usual)
            if (const Point* p = nearestReference(points, usual->seconds()))
                addPoint(*p, fmt::format("reference, nearest in time to {}", usual->method));
        html_ += "</div>\n";
    }

    static const Point* nearestReference(const std::vector<Point>& points, double seconds) {
        const Point* nearest = nullptr;
        const auto distance = [=](const Point& p) { return std::abs(std::log(p.seconds() / seconds)); };
        for (const Point& p : points)
            if (p.isReference() && !p.picture.empty() && (!nearest || distance(p) < distance(*nearest)))
                nearest = &p;
        return nearest;
    }

    void addPoint(const Point& p, const std::string& title) {
        addFigure({p.picture, p.map}, title,
                  fmt::format("{} samples per pixel, {}, relMSE {:.3g}, FLIP {:.4f}", settingText(p),
                              secondsText(p.seconds()), p.relMse, p.flip));
    }

    void addFigure(const std::vector<std::string>& files, const std::string& title, const std::string& note) {
        html_ += "<figure>";
        for (const std::string& file : files)
            html_ += fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escaped(file),
                                 base64(readFile((std::filesystem::path(directory_) / file).string())));
        html_ += fmt::format("<figcaption>{} <span>{}</span></figcaption></figure>\n", escaped(title),
                             escaped(note));
    }

    void addTable() {
        html_ +=
            "<h2>Every point</h2>\n<div class=\"scroll\"><table>\n<tr><th class=\"name\">scene</th><th "
            "class=\"name\">method</th><th class=\"name\">device</th><th>samples \u2192 outputs</th>"
            "<th>total</th><th>tracing</th><th>reconstruction</th><th>runs</th><th>MSE</th><th>relMSE</th>"
            "<th>FLIP</th><th>drift</th></tr>\n";
        for (const Point& p : results_.points)
            html_ += fmt::format(
                "<tr><td class=\"name\">{}</td><td class=\"name\">{}</td><td class=\"name\">{}</td>"
                "<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.3g}</td>"
                "<td>{:.3g}</td><td>{:.4f}</td><td>{:+.3f} %</td></tr>\n",
                escaped(p.scene), p.method, escaped(shortDevice(p.device)), settingText(p),
                secondsText(p.seconds()), secondsText(p.traceSeconds),
                p.isReference() ? "" : secondsText(p.reconstructSeconds), p.runs, p.mse, p.relMse, p.flip,
                100 * p.drift);
        html_ += "</table></div>\n";
    }

    void addCircumstances() {
        const Circumstances& c = results_.circumstances;
        html_ += "<h2>How it was measured</h2>\n<dl>\n";
        for (const auto& [name, value] : {std::pair("date", c.date),
                                          {"machine", c.machine},
                                          {"program", c.program},
                                          {"settings", c.settings}})
            html_ += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escaped(value));
        html_ += fmt::format("<dt>command</dt><dd><code>{}</code></dd>\n</dl>\n", escaped(c.command));
    }

    const Results& results_;
    std::span<const SceneCharts> charts_;
    const std::string directory_;
    std::string html_;
};

} // namespace

std::string pageOf(const Results& results, std::span<const SceneCharts> charts,
                   const std::string& directory) {
    return Page(results, charts, directory).text();
}

} // namespace slant
