#include "render/field_pictures.h"

#include "base/error.h"
#include "reconstruct/cpu_reconstructor.h"
#include "render/auxiliary.h"

#include <bit>
#include <utility>

namespace slant {
namespace {

std::string describe(const IntermediateDifference& d, const std::vector<uint>& expected) {
    if (d.got.empty())
        return fmt::format("intermediate {} '{}' has {} words on the CPU and {} on the device", d.index,
                           d.name, d.expectedWords, d.gotWords);
    std::size_t i = 0;
    while (i + 1 < d.got.size() && i < expected.size() && expected[i] == d.got[i]) ++i;
    return fmt::format(
        "intermediate {} '{}' differs first at word {} of {}: cpu {:#010x} ({:.9g}), device {:#010x} "
        "({:.9g})",
        d.index, d.name, d.firstWord + i, d.gotWords, expected.at(i), std::bit_cast<float>(expected[i]),
        d.got[i], std::bit_cast<float>(d.got[i]));
}

} // namespace

FieldPictures::FieldPictures(Backend& backend, const LightField& field, const ReconstructOptions& options,
                             bool compareWithCpu)
    : field_(field), prepared_(backend.reconstructor().prepare(field, options)) {
    if (compareWithCpu) onCpu_ = CpuReconstructor().prepare(field, options);
}

FieldPictures::~FieldPictures() = default;

Image FieldPictures::colours(const LensView& view, Monitor& monitor, ReconstructReport& report) {
    return picture(view, ValuePlane::radiance, monitor, report);
}

void FieldPictures::addAuxiliary(Image& image, const LensView& view, Monitor& monitor,
                                 ReconstructReport& report) {
    if (!field_.hasGuides())
        monitor.warn("the samples have neither albedo nor normals: these channels are left out");
    ReconstructReport ofSets;
    const Stopwatch watch;
    for (const AuxiliarySet& set : auxiliarySets(field_.hasGuides(), field_.moves()))
        addChannels(image, set, picture(view, set.plane, monitor, ofSets));
    StageStats& stage = report.stage("auxiliary", "outputs");
    stage.seconds = watch.seconds();
    stage.items = ofSets.outputs;
}

std::vector<Agreement> FieldPictures::takeAgreements() {
    return std::exchange(agreements_, {});
}

Image FieldPictures::picture(const LensView& view, ValuePlane plane, Monitor& monitor,
                             ReconstructReport& report) {
    return onCpu_ ? pictureAndCompare(view, plane, monitor, report)
                  : prepared_->picture(view, plane, monitor, report, nullptr);
}

Image FieldPictures::pictureAndCompare(const LensView& view, ValuePlane plane, Monitor& monitor,
                                       ReconstructReport& report) {
    ReconstructReport cpuReport;
    IntermediateRecorder expected;
    onCpu_->picture(view, plane, monitor, cpuReport, &expected);
    IntermediateComparer comparer(expected);
    Image image = prepared_->picture(view, plane, monitor, report, &comparer);
    if (const auto difference = comparer.difference()) {
        IntermediateReader reader(difference->index, difference->firstWord, difference->got.size());
        if (!difference->got.empty()) onCpu_->picture(view, plane, monitor, cpuReport, &reader);
        throw Error(ErrorCode::outOfBounds, describe(*difference, reader.words()));
    }
    Agreement agreement{expected.all().size()};
    for (const auto& recorded : expected.all()) agreement.words += recorded.words;
    agreements_.push_back(agreement);
    return image;
}

} // namespace slant
