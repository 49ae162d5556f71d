#include "report/results.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace slant {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN: it is null there.
double numberOr(const Json& json, double otherwise) {
    return json.is_null() ? otherwise : json.get<double>();
}

Json pointJson(const Point& p) {
    return {{"scene", p.scene},
            {"method", p.method},
            {"spp", p.spp},
            {"outSpp", p.outputs},
            {"device", p.device},
            {"seconds", p.seconds()},
            {"traceSeconds", p.traceSeconds},
            {"reconstructSeconds", p.reconstructSeconds},
            {"runs", p.runs},
            {"mse", p.mse},
            {"relMse", p.relMse},
            {"flip", p.flip},
            {"drift", p.drift},
            {"picture", p.picture},
            {"map", p.map},
            {"key", p.key}};
}

Point pointOf(const Json& json) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    Point p;
    json.at("key").get_to(p.key);
    json.at("scene").get_to(p.scene);
    json.at("method").get_to(p.method);
    json.at("spp").get_to(p.spp);
    json.at("outSpp").get_to(p.outputs);
    json.at("device").get_to(p.device);
    json.at("runs").get_to(p.runs);
    json.at("traceSeconds").get_to(p.traceSeconds);
    json.at("reconstructSeconds").get_to(p.reconstructSeconds);
    p.mse = numberOr(json.at("mse"), kNaN);
    p.relMse = numberOr(json.at("relMse"), kNaN);
    p.flip = numberOr(json.at("flip"), kNaN);
    p.drift = numberOr(json.at("drift"), kNaN);
    json.at("picture").get_to(p.picture);
    json.at("map").get_to(p.map);
    return p;
}

Json factorJson(const std::optional<Factor>& factor) {
    if (!factor) return nullptr;
    return {{"factor", factor->value}, {"atLeast", factor->atLeast}};
}

Json sceneJson(const SceneSummary& scene, const std::vector<Point>& points) {
    Json gains = Json::array();
    for (const MethodGain& g : gainsOf(points))
        gains.push_back({{"method", g.method},
                         {"device", g.device},
                         {"relMse", g.error},
                         {"equalError", factorJson(g.gain.equalError)},
                         {"equalTime", factorJson(g.gain.equalTime)}});
    return {{"name", scene.name},
            {"path", scene.path},
            {"width", scene.width},
            {"height", scene.height},
            {"truthSpp", scene.truthSpp},
            {"truthNoiseRelMse", truthNoise(points, scene.truthSpp)},
            {"truthPicture", scene.truthPicture},
            {"gainsOverReference", std::move(gains)}};
}

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

} // namespace

std::vector<Point> Results::of(const SceneSummary& scene) const {
    std::vector<Point> list;
    std::ranges::copy_if(points, std::back_inserter(list),
                         [&](const Point& point) { return point.scene == scene.name; });
    return list;
}

std::vector<MethodGain> gainsOf(std::span<const Point> points) {
    struct Group {
        std::string method, device;
        std::vector<Cost> costs;
    };
    std::vector<Group> groups;
    std::vector<Cost> references;
    for (const Point& p : points) {
        if (p.isReference()) {
            references.push_back({p.seconds(), p.relMse});
            continue;
        }
        auto group = std::ranges::find_if(
            groups, [&](const Group& g) { return g.method == p.method && g.device == p.device; });
        if (group == groups.end()) group = groups.insert(groups.end(), {p.method, p.device, {}});
        group->costs.push_back({p.seconds(), p.relMse});
    }
    const std::vector<Cost> reference = paretoFront(references);
    std::vector<MethodGain> gains;
    for (const Group& group : groups)
        for (const double error : kGainErrors)
            gains.push_back(
                {group.method, group.device, error, gainAt(paretoFront(group.costs), reference, error)});
    return gains;
}

double truthNoise(std::span<const Point> points, int truthSpp) {
    const Point* best = nullptr;
    for (const Point& p : points)
        if (p.isReference() && (!best || p.spp > best->spp)) best = &p;
    // Its measured error is e/spp + e/truthSpp for samples of relMSE e each.
    return best ? best->relMse * best->spp / (best->spp + truthSpp) : 0;
}

Json toJson(const Results& results) {
    const Circumstances& c = results.circumstances;
    Json scenes = Json::array(), points = Json::array();
    for (const SceneSummary& scene : results.scenes) scenes.push_back(sceneJson(scene, results.of(scene)));
    for (const Point& point : results.points) points.push_back(pointJson(point));
    return {{"date", c.date},
            {"command", c.command},
            {"program", c.program},
            {"machine", c.machine},
            {"settings", c.settings},
            {"scenes", std::move(scenes)},
            {"points", std::move(points)}};
}

std::vector<Point> pointsFromJson(const Json& json) {
    std::vector<Point> points;
    for (const Json& point : json.at("points")) points.push_back(pointOf(point));
    return points;
}

std::string toCsv(std::span<const Point> points) {
    std::string csv =
        "scene,method,spp,outSpp,device,seconds,traceSeconds,reconstructSeconds,runs,mse,relMse,"
        "flip,drift\n";
    for (const Point& p : points)
        csv += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.6g},{},{:.6g},{:.6g},{:.6g},{:.6g}\n",
                           csvField(p.scene), csvField(p.method), p.spp, p.outputs, csvField(p.device),
                           p.seconds(), p.traceSeconds, p.reconstructSeconds, p.runs, p.mse, p.relMse, p.flip,
                           p.drift);
    return csv;
}

} // namespace slant
