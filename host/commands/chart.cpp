// slant chart: speed against error, methods x settings x scenes, measured and drawn.
#include "report/chart.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/read_file.h"
#include "base/suggest.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "commands/picture_job.h"
#include "commands/stats_file.h"
#include "commands/terminal_monitor.h"
#include "reconstruct/output_pattern.h"
#include "report/gnuplot.h"
#include "report/machine.h"
#include "report/page.h"
#include "report/sweep.h"
#include "report/timing.h"
#include "report/truth.h"

#include <algorithm>
#include <filesystem>
#include <memory>

namespace slant::commands {
namespace {

namespace fs = std::filesystem;

struct ChartOptions {
    SweepOptions sweep;
    CommonOptions common; ///< of these: seed, threads, quiet, stats
    std::string directory;
    bool quick = false, fresh = false;

    std::string file(const std::string& name) const { return (fs::path(directory) / name).string(); }
};

/// Splits `text` at its commas; throws CLI::ValidationError if a word is empty or occurs twice.
std::vector<std::string> wordsOf(const std::string& option, const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (word.empty())
            throw CLI::ValidationError(option, fmt::format("'{}' is not a list such as A,B,C", text));
        if (std::ranges::find(words, word) != words.end())
            throw CLI::ValidationError(option, fmt::format("'{}' names {} twice", text, word));
        words.push_back(word);
        begin = end + 1;
    }
    return words;
}

/// The numbers of a list, ascending, each of which satisfies `isRight`; `what` names what would be right.
template <typename Check>
std::vector<int> numbersOf(const std::string& option, const std::string& text, const std::string& what,
                           const Check& isRight) {
    std::vector<int> numbers;
    for (const std::string& word : wordsOf(option, text)) {
        const auto number = parseNumber<int>(word);
        if (!number || !isRight(*number))
            throw CLI::ValidationError(option, fmt::format("'{}' is not {}", word, what));
        numbers.push_back(*number);
    }
    std::ranges::sort(numbers);
    return numbers;
}

std::vector<Method> methodsOf(const std::string& text) {
    std::vector<Method> methods;
    for (const std::string& word : wordsOf("--methods", text)) {
        const auto method = parseMethod(word);
        if (!method)
            throw CLI::ValidationError("--methods", fmt::format("'{}' is none of {}{}", word,
                                                                fmt::join(methodNames(), ", "),
                                                                didYouMean(word, methodNames())));
        methods.push_back(*method);
    }
    return methods;
}

void writeFile(const std::string& path, const std::string& text) {
    AtomicFile file(path);
    file.write(text);
    file.commit();
}

std::string jsonText(const Results& results) {
    return toJson(results).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// The points of an earlier run; none if there was no such run.
std::vector<Point> knownPoints(const ChartOptions& options) {
    const std::string path = options.file("results.json");
    if (options.fresh || !fs::exists(path)) return {};
    try {
        return pointsFromJson(nlohmann::ordered_json::parse(readFile(path)));
    } catch (const nlohmann::json::exception&) {
        throw badInput({path}, "is not a results file of slant chart (--fresh starts anew)");
    }
}

Circumstances circumstancesOf(const ChartOptions& options) {
    Circumstances c;
    c.date = dateNow();
    c.command = commandLine();
    c.program = "slant, build " + programDigest();
    c.machine = fmt::format("{}; {} threads", machineName(), threadCount());
    c.settings =
        fmt::format("median of {} timed runs after one to warm up (a run of {} s or more counts alone); "
                    "reading the scene and building its hierarchy are left out; seed {}, FLIP at "
                    "{:+g} stops",
                    options.sweep.repeat, kLongRunSeconds, options.sweep.seed, options.sweep.exposure);
    return c;
}

void writeCharts(const ChartOptions& options, const Results& results) {
    std::vector<SceneCharts> charts;
    for (const SceneSummary& scene : results.scenes) {
        const std::vector<Point> points = results.of(scene);
        charts.push_back({runGnuplot(chartScript(scene, points, Figure::relMse)),
                          runGnuplot(chartScript(scene, points, Figure::flip))});
        writeFile(options.file(scene.name + ".svg"), charts.back().relMse);
        writeFile(options.file(scene.name + "-flip.svg"), charts.back().flip);
    }
    writeFile(options.file("results.csv"), toCsv(results.points));
    writeFile(options.file("index.html"), pageOf(results, charts, options.directory));
}

void printGains(const Results& results) {
    for (const SceneSummary& scene : results.scenes)
        for (const MethodGain& g : gainsOf(results.of(scene)))
            if (g.gain.equalError)
                fmt::print("{}: {} on {}, relMSE {:g}: speed {}, accuracy {} (reference 1)\n", scene.name,
                           g.method, shortDevice(g.device), g.error, factorText(g.gain.equalError),
                           factorText(g.gain.equalTime));
}

void runChart(ChartOptions options) {
    const Stopwatch watch;
    const ThreadLimit threads(options.common.threads);
    TerminalMonitor monitor(TerminalMonitor::styleOfStderr(options.common.quiet));
    checkGnuplot();
    makeDirectory(options.file("images"));
    for (const char* name : {"results.json", "results.csv", "index.html"}) checkWritable(options.file(name));
    if (!options.common.statsPath.empty()) checkWritable(options.common.statsPath);
    if (options.sweep.cacheDirectory.empty()) options.sweep.cacheDirectory = defaultCacheDirectory();
    makeDirectory(options.sweep.cacheDirectory);

    options.sweep.seed = options.common.seed;
    options.sweep.threads = options.common.threads;
    options.sweep.pictureDirectory = options.directory;
    const Circumstances circumstances = circumstancesOf(options);
    const auto keep = [&](Results results) {
        results.circumstances = circumstances;
        writeFile(options.file("results.json"), jsonText(results));
    };
    Results results = runSweep(options.sweep, knownPoints(options), keep, monitor);
    results.circumstances = circumstances;
    keep(results);
    writeCharts(options, results);
    if (!options.common.statsPath.empty())
        writeStats(options.common.statsPath, monitor.stages(), watch.seconds(),
                   {{"command", circumstances.command}, {"points", results.points.size()}});
    printGains(results);
    fmt::print("{}\n", options.file("index.html"));
}

/// Defaults of the settings that were not given.
void fillDefaults(ChartOptions& options, const CLI::App& command) {
    const auto given = [&](const char* name) { return command.count(name) > 0; };
    SweepOptions& sweep = options.sweep;
    sweep.halfSize = options.quick;
    // `window` alone would take longer than a quick sweep may.
    if (!given("--methods"))
        sweep.methods =
            methodsOf(options.quick ? "box,full,auto" : fmt::format("{}", fmt::join(methodNames(), ",")));
    if (!given("--spp")) sweep.samples = options.quick ? std::vector{2, 8} : std::vector{1, 2, 4, 8, 16};
    if (!given("--outputs")) sweep.outputs = {options.quick ? 64 : 128};
    if (!given("--devices")) sweep.devices = {"auto"};
    if (!given("--repeat")) sweep.repeat = options.quick ? 1 : 3;
    if (!given("--truth-spp")) sweep.truthSpp = options.quick ? 256 : 4096;
}

/// An option that `parse` turns from text into a value.
template <typename Value, typename Parse>
void addList(CLI::App& command, const std::string& name, Value& value, const std::string& type,
             const std::string& help, const Parse& parse) {
    command
        .add_option_function<std::string>(
            name, [&value, parse](const std::string& text) { value = parse(text); }, help)
        ->type_name(type);
}

} // namespace

void addChart(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("chart", "Measure and draw speed against error, methods beside brute force");
    const auto options = std::make_shared<ChartOptions>();
    SweepOptions& sweep = options->sweep;
    command->add_option("SCENES", sweep.scenes, "pbrt scene files")->required()->type_name("");
    addLenientOption(*command, sweep.reading);
    command->add_option("-o,--output", options->directory, "directory to write to")
        ->required()
        ->type_name("DIR");
    addList(*command, "--methods", sweep.methods, "A,B,...",
            fmt::format("any of {} (default all)", fmt::join(methodNames(), ", ")), methodsOf);
    addList(*command, "--spp", sweep.samples, "N,N,...", "input samples per pixel (default 1,2,4,8,16)",
            [](const std::string& text) {
                return numbersOf("--spp", text, fmt::format("a number from 1 to {}", kMaxSamplesPerPixel),
                                 [](int n) { return n >= 1 && n <= kMaxSamplesPerPixel; });
            });
    addList(*command, "--outputs", sweep.outputs, "N,N,...", "output samples per pixel (default 128)",
            [](const std::string& text) {
                return numbersOf("--outputs", text,
                                 fmt::format("a power of two from 1 to {}", kMaxOutputsPerPixel),
                                 [](int n) { return isOutputCount(n); });
            });
    addList(*command, "--devices", sweep.devices, "A,B,...",
            "any of auto, cpu, parts of Vulkan device names (default auto)",
            [](const std::string& text) { return wordsOf("--devices", text); });
    addNumber<double>(
        *command, "--adaptive", sweep.placedShare, 0, 0.95,
        "measure each method also with this share of its samples traced where its picture has most "
        "error (default 0)");
    addNumber<int>(*command, "--repeat", sweep.repeat, 1, 1000, "timed runs per point (default 3)");
    addNumber<int>(*command, "--truth-spp", sweep.truthSpp, 64, kMaxSamplesPerPixel,
                   "samples per pixel of the ground truth (default 4096)");
    addNumber<float>(*command, "--exposure", sweep.exposure, -30, 30,
                     "exposure of pictures and FLIP in stops (default 0)");
    command->add_flag("--quick", options->quick,
                      "half the resolution, fewer and smaller settings: minutes instead of an hour");
    command->add_flag("--fresh", options->fresh, "measure again what DIR/results.json holds already");
    command
        ->add_option("--cache", sweep.cacheDirectory,
                     "where ground truths are kept (default: slant in the user's cache directory)")
        ->type_name("DIR");
    addSeedOption(*command, options->common);
    addRunOptions(*command, options->common);
    command->callback([options, command] {
        fillDefaults(*options, *command);
        runChart(*options);
    });
}

} // namespace slant::commands
