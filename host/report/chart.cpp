#include "report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace slant {
namespace {

// Middle tones, so that they stand out from white and from black; Okabe and Ito's hues.
constexpr std::array kColors{"#d9541a", "#2385c8", "#1d9b74", "#b0569c", "#b58a00"};
constexpr const char* kReferenceColor = "#808080";
constexpr int kWidth = 560, kPlotHeight = 400, kLineHeight = 22; ///< pixels

struct Curve {
    const Point* first;
    std::vector<const Point*> points;
};

double errorOf(const Point& point, Figure figure) {
    return figure == Figure::relMse ? point.relMse : point.flip;
}

/// Single quotes keep gnuplot from reading anything into a text but themselves.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text)
        if (c == '\'')
            result += "''";
        else
            result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return result + "'";
}

std::vector<Curve> curvesOf(std::span<const Point> points, Figure figure) {
    std::vector<Curve> curves;
    for (const Point& p : points) {
        if (!(errorOf(p, figure) > 0)) continue; // no place on a logarithmic axis, NaN included
        auto curve = std::ranges::find_if(curves, [&](const Curve& c) {
            return c.first->method == p.method && c.first->outputs == p.outputs &&
                   c.first->device == p.device;
        });
        if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{&p, {}});
        curve->points.push_back(&p);
    }
    for (Curve& curve : curves) std::ranges::sort(curve.points, {}, &Point::spp);
    return curves;
}

/// What tells the curve from the others.
std::string titleOf(const Curve& curve, bool manyDevices) {
    const Point& p = *curve.first;
    std::string title = p.method;
    if (p.outputs > 0) title += fmt::format(", {} outputs", p.outputs);
    if (manyDevices && !p.isReference()) title += ", " + shortDevice(p.device);
    return title;
}

struct Range {
    double low = HUGE_VAL, high = 0;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool contains(double value) const { return value > low && value < high; }
    /// 1, 2, 5, 10, ..., or if these are many, the powers of ten among them.
    std::string tics() const {
        const bool many = high > 300 * low;
        std::string list;
        for (int exponent = -12; exponent < 12; ++exponent)
            for (const int digit : {1, 2, 5})
                if (const double tic = digit * std::pow(10.0, exponent);
                    contains(tic) && (digit == 1 || !many))
                    list += fmt::format("{}{:g}", list.empty() ? "" : ", ", tic);
        return list;
    }
    std::string text() const { return high > 0 ? fmt::format("[{:g}:{:g}]", low, high) : "[0.1:1]"; }
};

std::string dataBlock(const std::string& name, std::span<const Cost> costs, std::span<const int> labels) {
    std::string text = fmt::format("${} << END\n", name);
    for (std::size_t i = 0; i < costs.size(); ++i)
        text +=
            fmt::format("{:g} {:g} {}\n", costs[i].seconds, costs[i].error, labels.empty() ? 0 : labels[i]);
    return text + "END\n";
}

/// What each method gains, a line for each error that it or the reference reaches.
std::vector<std::string> gainLines(std::span<const Point> points, bool manyDevices) {
    std::vector<std::string> lines;
    for (const MethodGain& g : gainsOf(points))
        if (g.gain.equalError)
            lines.push_back(
                fmt::format("{}{}: {} faster than the reference to relMSE {:g}; in that time {} less error",
                            g.method, manyDevices ? " on " + shortDevice(g.device) : "",
                            factorText(g.gain.equalError), g.error, factorText(g.gain.equalTime)));
    return lines;
}

/// A horizontal line with a note, if it is within the chart.
std::string level(double error, const Range& range, const std::string& note) {
    if (!range.contains(error)) return "";
    return fmt::format(
        "set arrow from graph 0, first {0:g} to graph 1, first {0:g} nohead back dt 3 lc rgb "
        "'#808080'\nset label {1} noenhanced at graph 0.01, first {0:g} left offset 0,0.4 font "
        "',12' tc rgb '#808080'\n",
        error, quoted(note));
}

} // namespace

std::string factorText(const std::optional<Factor>& factor) {
    if (!factor) return "\u2014";
    return fmt::format("{}{:.{}f}\u00d7", factor->atLeast ? "\u2265 " : "", factor->value,
                       factor->value < 9.95 ? 1 : 0);
}

std::string shortDevice(const std::string& device) {
    return device.substr(0, device.find(" ("));
}

std::string chartScript(const SceneSummary& scene, std::span<const Point> points, Figure figure) {
    const std::vector<Curve> curves = curvesOf(points, figure);
    std::set<std::string> devices;
    std::vector<Cost> all;
    Range seconds, errors;
    for (const Curve& curve : curves)
        for (const Point* p : curve.points) {
            if (!p->isReference()) devices.insert(p->device);
            all.push_back({p->seconds(), errorOf(*p, figure)});
            seconds.add(0.7 * p->seconds());
            seconds.add(1.4 * p->seconds());
            errors.add(0.6 * all.back().error);
            errors.add(1.8 * all.back().error);
        }
    const bool manyDevices = devices.size() > 1;
    const std::vector<std::string> notes =
        figure == Figure::relMse ? gainLines(points, manyDevices) : std::vector<std::string>();

    // From the bottom: notes, key, label and tics of the x axis, plot.
    const int notesTop = kLineHeight * int(notes.size()) + 8;
    const int keyTop = notesTop + kLineHeight * (int(curves.size()) / 2 + 1);
    const int plotBottom = keyTop + 75, height = plotBottom + kPlotHeight;
    std::string script = fmt::format(
        "set terminal svg size {},{} font 'sans-serif,14' background '#ffffff'\n"
        "set logscale xy\nset grid lc rgb '#d0d0d0'\nset border lc rgb '#404040'\n"
        "set title {} noenhanced\nset xlabel 'seconds, tracing included'\nset ylabel {}\n"
        "set xtics ({})\nset ytics ({})\nset xrange {}\nset yrange {}\nset bmargin screen {:.4f}\n"
        "set key at screen 0.5, screen {:.4f} center bottom horizontal maxcols 2 Left reverse noenhanced\n",
        kWidth, height,
        quoted(fmt::format("{}, {}x{}, against {} samples a pixel", scene.name, scene.width, scene.height,
                           scene.truthSpp)),
        figure == Figure::relMse ? "'relMSE'" : "'FLIP'", seconds.tics(), errors.tics(), seconds.text(),
        errors.text(), double(plotBottom) / height, double(notesTop) / height);
    for (std::size_t i = 0; i < notes.size(); ++i)
        script += fmt::format("set label {} noenhanced at screen 0.03, screen {:.4f} font ',12'\n",
                              quoted(notes[i]), (notesTop - kLineHeight * (double(i) + 0.4)) / height);
    if (figure == Figure::relMse) {
        for (const double error : kGainErrors) script += level(error, errors, fmt::format("{:g}", error));
        script += level(truthNoise(points, scene.truthSpp), errors, "noise of the ground truth");
    }
    if (curves.empty()) return script + "plot 1/0 notitle\n";

    script += dataBlock("front", paretoFront(all), {});
    std::string plots =
        "plot $front using 1:2 with linespoints lw 9 pt 7 ps 1.6 lc rgb '#90f0c000' title 'Pareto front'";
    std::vector<std::string> methods;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const Curve& curve = curves[i];
        std::vector<Cost> costs;
        std::vector<int> labels;
        for (const Point* p : curve.points) {
            costs.push_back({p->seconds(), errorOf(*p, figure)});
            labels.push_back(p->spp);
        }
        script += dataBlock(fmt::format("c{}", i), costs, labels);
        auto method = std::ranges::find(methods, curve.first->method);
        if (method == methods.end()) method = methods.insert(methods.end(), curve.first->method);
        const auto color = std::size_t(method - methods.begin());
        const std::string style =
            curve.first->isReference() ? kReferenceColor : kColors[color % kColors.size()];
        plots +=
            fmt::format(", $c{0} using 1:2 with linespoints lw 2 pt {1} ps 0.7 lc rgb '{2}' title {3}, "
                        "$c{0} using 1:2:3 with labels offset 0.6,0.6 left font ',11' tc rgb '{2}' notitle",
                        i, 4 + 2 * int(i % 6) + 1, style, quoted(titleOf(curve, manyDevices)));
    }
    return script + plots + "\n";
}

} // namespace slant
