#include "report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace slant {
namespace {

// Middle tones, so that they stand out from white and from black; Okabe and Ito's hues.
constexpr std::array kColors{"#d9541a", "#2385c8", "#1d9b74", "#b0569c", "#b58a00"};
constexpr const char* kReferenceColor = "#808080";
constexpr int kWidth = 560, kPlotHeight = 400, kLineHeight = 22; ///< pixels
constexpr std::size_t kTitleOfHalfWidth = 22;                    ///< characters of a title in the key

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

struct Range {
    double low = HUGE_VAL, high = 0;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool contains(double value) const { return value > low && value < high; }
    /// 1, 2, 5, 10, ..., or only the powers of ten if these are too many.
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

/// Index of `value` in `list`, at whose end it is added if it is new.
template <typename Value>
std::size_t indexIn(std::vector<Value>& list, const Value& value) {
    const auto found = std::ranges::find(list, value);
    if (found != list.end()) return std::size_t(found - list.begin());
    list.push_back(value);
    return list.size() - 1;
}

/// Writes one chart as a gnuplot script.
class Script {
public:
    Script(const SceneSummary& scene, std::span<const Point> points, Figure figure)
        : scene_(scene), points_(points), figure_(figure), curves_(curvesOf(points, figure)) {
        for (const Curve& curve : curves_)
            for (const Point* p : curve.points) {
                const double error = errorOf(*p, figure);
                if (!p->isReference()) indexIn(devices_, p->device);
                all_.push_back({p->seconds(), error});
                for (const double factor : {0.7, 1.5}) seconds_.add(factor * p->seconds());
                for (const double factor : {0.6, 1.8}) errors_.add(factor * error);
            }
    }

    std::string text() {
        const std::vector<std::string> notes = gainLines();
        frame(int(notes.size()));
        for (std::size_t i = 0; i < notes.size(); ++i)
            text_ += fmt::format("set label {} noenhanced at screen 0.03, screen {:.4f} font ',13'\n",
                                 quoted(notes[i]),
                                 kLineHeight * (double(notes.size() - i) - 0.4) / double(heightPx_));
        if (figure_ == Figure::relMse) {
            for (const double error : kGainErrors) level(error, fmt::format("{:g}", error));
            level(truthNoise(points_, scene_.truthSpp), "noise of the ground truth at most");
        }
        if (curves_.empty()) return text_ + "plot 1/0 notitle\n";
        dataBlock("front", paretoFront(all_));
        plots_ = "plot $front using 1:2 with linespoints lw 9 pt 7 ps 1.6 lc rgb '#90f0c000' "
                 "title 'Pareto front'";
        for (std::size_t i = 0; i < curves_.size(); ++i) plot(curves_[i], i);
        return text_ + plots_ + "\n";
    }

private:
    /// The gains of each method, one line for each error that it or the reference reaches.
    std::vector<std::string> gainLines() const {
        std::vector<std::string> lines;
        if (figure_ != Figure::relMse) return lines;
        for (const MethodGain& g : gainsOf(points_)) {
            if (!g.gain.equalError) continue;
            if (lines.empty())
                lines.push_back("Speed to equal error and accuracy in equal time, times the reference's:");
            lines.push_back(fmt::format("{}{}, relMSE {:g}: speed {}, accuracy {}", g.method,
                                        devices_.size() > 1 ? " on " + shortDevice(g.device) : "", g.error,
                                        factorText(g.gain.equalError), factorText(g.gain.equalTime)));
        }
        return lines;
    }

    /// The parts of a curve's title that distinguish it from the others.
    std::string titleOf(const Curve& curve) const {
        const Point& p = *curve.first;
        std::string title = p.method;
        if (p.outputs > 0) title += fmt::format(", {} outputs", p.outputs);
        if (devices_.size() > 1 && !p.isReference()) title += ", " + shortDevice(p.device);
        return title;
    }

    /// Size, axes and key; from the bottom: notes, key, label and tics of the x axis, plot.
    void frame(int noteLines) {
        std::size_t longest = 0;
        for (const Curve& curve : curves_) longest = std::max(longest, titleOf(curve).size());
        const int columns = longest <= kTitleOfHalfWidth ? 2 : 1;
        const int keyLines = (int(curves_.size()) + columns) / columns; // one more for the front
        const int keyPx = kLineHeight * noteLines + 8, plotPx = keyPx + kLineHeight * keyLines + 75;
        heightPx_ = plotPx + kPlotHeight;
        text_ = fmt::format(
            "set terminal svg size {},{} font 'sans-serif,14' background '#ffffff'\n"
            "set logscale xy\nset grid lc rgb '#d0d0d0'\nset border lc rgb '#404040'\n"
            "set title {} noenhanced\nset xlabel 'seconds, tracing included'\nset ylabel {}\n"
            "set xtics ({})\nset ytics ({})\nset xrange {}\nset yrange {}\nset bmargin screen {:.4f}\n"
            "set key at screen 0.5, screen {:.4f} center bottom horizontal maxcols {} Left reverse "
            "noenhanced\n",
            kWidth, heightPx_,
            quoted(fmt::format("{}, {}x{}, against {} samples per pixel", scene_.name, scene_.width,
                               scene_.height, scene_.truthSpp)),
            figure_ == Figure::relMse ? "'relMSE'" : "'FLIP'", seconds_.tics(), errors_.tics(),
            seconds_.text(), errors_.text(), double(plotPx) / heightPx_, double(keyPx) / heightPx_, columns);
    }

    /// A horizontal line with a note, if it is within the chart.
    void level(double error, const std::string& note) {
        if (!errors_.contains(error)) return;
        text_ += fmt::format(
            "set arrow from graph 0, first {0:g} to graph 1, first {0:g} nohead back dt 3 lc rgb '#808080'\n"
            "set label {1} noenhanced at graph 0.01, first {0:g} left offset 0,0.4 font ',12' tc rgb "
            "'#808080'\n",
            error, quoted(note));
    }

    void dataBlock(const std::string& name, std::span<const Cost> costs) {
        text_ += fmt::format("${} << END\n", name);
        for (const Cost& cost : costs) text_ += fmt::format("{:g} {:g}\n", cost.seconds, cost.error);
        text_ += "END\n";
    }

    /// The method gives a curve its colour, the outputs its marks, the device its dashes.
    void plot(const Curve& curve, std::size_t index) {
        const Point& p = *curve.first;
        std::vector<Cost> costs;
        for (const Point* point : curve.points) costs.push_back({point->seconds(), errorOf(*point, figure_)});
        const std::string name = fmt::format("c{}", index);
        dataBlock(name, costs);
        const std::string color =
            p.isReference() ? kReferenceColor : kColors[indexIn(methods_, p.method) % kColors.size()];
        plots_ += fmt::format(", ${} using 1:2 with linespoints lw 2 pt {} dt {} ps 0.7 lc rgb '{}' title {}",
                              name, p.isReference() ? 9 : 5 + 2 * (indexIn(outputs_, p.outputs) % 5),
                              p.isReference() ? 1 : indexIn(devices_, p.device) % 5 + 1, color,
                              quoted(titleOf(curve)));
        for (const Point* point : curve.points)
            if (p.isReference() || point == curve.points.front() || point == curve.points.back())
                text_ +=
                    fmt::format("set label '{}' at first {:g}, first {:g} left offset 0.6,0.5 font ',11' tc "
                                "rgb '{}'\n",
                                point->spp, point->seconds(), errorOf(*point, figure_), color);
    }

    const SceneSummary& scene_;
    const std::span<const Point> points_;
    const Figure figure_;
    const std::vector<Curve> curves_;
    std::vector<Cost> all_;
    Range seconds_, errors_;
    std::vector<std::string> devices_, methods_;
    std::vector<int> outputs_;
    int heightPx_ = 0;
    std::string text_, plots_;
};

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
    return Script(scene, points, figure).text();
}

} // namespace slant
