#include "scene/older_pbrt.h"

#include "scene/spelling.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

/// The entity that is translated; parameters are replaced, never changed, as others may share them.
class Upgrade {
public:
    Upgrade(std::string_view directive, const Position& where, std::string& kind, ParameterVector& parameters,
            Issues& issues)
        : directive_(directive), where_(where), kind_(kind), parameters_(parameters), issues_(issues) {}

    bool run();

private:
    void film();
    void filter();
    void sampler();
    void integrator();
    void camera();
    void texture();
    void scaleTexture();
    void material();
    void uber();
    void plastic();
    void mix();
    void multiplyByScale(std::string_view name);
    void light();
    void shape();

    const Parameter* find(std::string_view name) const;
    void become(std::string_view kind);
    void rename(std::string_view from, std::string_view to);
    void remove(std::initializer_list<std::string_view> names);
    void replace(std::string_view name, Parameter with);
    void add(Parameter parameter);
    bool removeIf(std::string_view name, double neutral);
    void number(std::string_view from, std::string_view to, double factor);
    std::optional<double> grey(std::string_view name) const;
    void note(const std::string& message) { issues_.note(where_, message); }

    std::string_view directive_;
    const Position& where_;
    std::string& kind_;
    ParameterVector& parameters_;
    Issues& issues_;
    bool old_ = false;
};

const Parameter* Upgrade::find(std::string_view name) const {
    for (auto p = parameters_.rbegin(); p != parameters_.rend(); ++p)
        if ((*p)->name == name) return p->get();
    return nullptr;
}

void Upgrade::become(std::string_view kind) {
    kind_ = kind;
    old_ = true;
}

void Upgrade::remove(std::initializer_list<std::string_view> names) {
    const auto count = std::erase_if(parameters_, [&](const auto& p) {
        return std::find(names.begin(), names.end(), p->name) != names.end();
    });
    old_ = old_ || count > 0;
}

void Upgrade::add(Parameter parameter) {
    if (!parameter.position.file) parameter.position = where_;
    parameters_.push_back(std::make_shared<const Parameter>(std::move(parameter)));
}

void Upgrade::replace(std::string_view name, Parameter with) {
    with.position = find(name)->position;
    remove({name});
    add(std::move(with));
}

void Upgrade::rename(std::string_view from, std::string_view to) {
    const Parameter* old = find(from);
    if (!old) return;
    Parameter renamed = *old;
    renamed.name = to;
    replace(from, std::move(renamed));
}

/// A float of another name, in another unit.
void Upgrade::number(std::string_view from, std::string_view to, double factor) {
    const Parameter* old = find(from);
    if (old && old->type == "float" && old->numbers.size() == 1)
        replace(from, {.type = "float", .name = std::string(to), .numbers = {factor * old->numbers[0]}});
}

/// The one value of an rgb that is grey.
std::optional<double> Upgrade::grey(std::string_view name) const {
    const Parameter* p = find(name);
    if (!p || p->type != "rgb" || p->numbers.size() != 3) return {};
    if (p->numbers[0] != p->numbers[1] || p->numbers[1] != p->numbers[2]) return {};
    return p->numbers[0];
}

/// Drops a parameter that pbrt-v4 lacks, with a note unless it has the value at which it does nothing. True
/// if it has.
bool Upgrade::removeIf(std::string_view name, double neutral) {
    const Parameter* p = find(name);
    if (!p) return false;
    const bool nothing = grey(name) == neutral;
    if (!nothing) note(fmt::format("'{}' of the older material \"{}\" is dropped", name, printable(kind_)));
    remove({name});
    return nothing;
}

void Upgrade::film() {
    if (kind_ == "image") become("rgb");
    rename("maxsampleluminance", "maxcomponentvalue");
    number("scale", "iso", 100);
    if (old_) remove({"filmdiag", "display"});
}

void Upgrade::filter() {
    rename("xwidth", "xradius");
    rename("ywidth", "yradius");
    const Parameter* alpha = kind_ == "gaussian" ? find("alpha") : nullptr;
    if (alpha && alpha->numbers.size() == 1 && alpha->numbers[0] > 0)
        replace("alpha",
                {.type = "float", .name = "sigma", .numbers = {1 / std::sqrt(2 * alpha->numbers[0])}});
}

void Upgrade::sampler() {
    if (const Parameter* centre = find("samplepixelcenter"); centre && centre->flags == std::vector{true})
        note("samples are spread over the pixel, not taken at its centre");
    remove({"samplepixelcenter"});
    if (kind_ == "lowdiscrepancy" || kind_ == "02sequence" || kind_ == "bestcandidate") become("paddedsobol");
    if (kind_ == "maxmindist") become("pmj02bn");
    if (kind_ == "random") become("independent");
    if (kind_ == "adaptive") {
        become("paddedsobol");
        rename("maxsamples", "pixelsamples");
        remove({"minsamples", "method"});
    }
}

void Upgrade::integrator() {
    remove({"rrthreshold", "lightsamplestrategy", "strategy", "pixelbounds"});
    if (kind_ != "directlighting") return;
    become("path");
    parameters_.clear();
    add({.type = "integer", .name = "maxdepth", .numbers = {1}});
}

void Upgrade::camera() {
    if (kind_ == "environment") {
        become("spherical");
        add({.type = "string", .name = "mapping", .strings = {"equirectangular"}});
    }
    if (kind_ == "realistic") {
        remove({"simpleweighting"});
        rename("specfile", "lensfile");
        rename("aperture_diameter", "aperturediameter");
    }
    remove({"hither", "yon"});
}

/// pbrt-v4 scales by a number only.
void Upgrade::scaleTexture() {
    if (!find("tex1") && !find("tex2")) return;
    const std::string_view factor = grey("tex1") && !grey("tex2") ? "tex1" : "tex2";
    if (const std::optional<double> value = grey(factor))
        replace(factor, {.type = "float", .name = "scale", .numbers = {*value}});
    else
        rename(factor, "scale");
    rename(factor == "tex1" ? "tex2" : "tex1", "tex");
}

void Upgrade::texture() {
    if (kind_ == "scale") scaleTexture();
    if (kind_ != "imagemap") return;
    if (const Parameter* trilinear = find("trilinear"); trilinear && trilinear->type == "bool")
        replace("trilinear", {.type = "string",
                              .name = "filter",
                              .strings = {trilinear->flags[0] ? "trilinear" : "bilinear"}});
    const Parameter* gamma = find("gamma");
    if (!gamma) return;
    const std::string encoding = gamma->type == "bool" ? (gamma->flags[0] ? "sRGB" : "linear")
                                 : gamma->numbers.size() == 1
                                     ? fmt::format("gamma {}", float(gamma->numbers[0]))
                                     : "";
    replace("gamma", {.type = "string", .name = "encoding", .strings = {encoding}});
}

void Upgrade::plastic() {
    const bool isDull = removeIf("Ks", 0);
    become(isDull ? "diffuse" : "coateddiffuse");
    if (isDull) remove({"roughness", "eta"});
    rename("Kd", "reflectance");
}

void Upgrade::uber() {
    const Parameter* opacity = find("opacity");
    if (opacity && grey("opacity") != 1)
        issues_.attempt("it is opaque", [&] {
            throw unsupported(opacity->position,
                              "an 'opacity' other than 1 of material \"uber\" is not supported");
        });
    remove({"opacity"});
    for (const std::string_view name : {"Kr", "Kt"}) removeIf(name, 0);
    plastic();
}

void Upgrade::mix() {
    if (!find("namedmaterial1") && !find("namedmaterial2")) return;
    const auto nameOf = [&](std::string_view parameter) {
        const Parameter* p = find(parameter);
        if (!p || p->strings.size() != 1)
            throw badInput(where_, "Material \"mix\" needs \"string {}\"", parameter);
        return p->strings[0];
    };
    // In the other order than pbrt-v3.
    add({.type = "string",
         .name = "materials",
         .strings = {nameOf("namedmaterial2"), nameOf("namedmaterial1")}});
    remove({"namedmaterial1", "namedmaterial2"});
    if (const Parameter* amount = find("amount"); amount && amount->type == "rgb") {
        double sum = 0;
        for (const double value : amount->numbers) sum += value;
        replace("amount",
                {.type = "float", .name = "amount", .numbers = {sum / double(amount->numbers.size())}});
    }
}

void Upgrade::material() {
    rename("bumpmap", "displacement");
    if (kind_ == "glass" || kind_ == "uber" || kind_ == "plastic") rename("index", "eta");
    if (kind_ == "matte") {
        become("diffuse");
        rename("Kd", "reflectance");
        remove({"sigma"});
    } else if (kind_ == "plastic") {
        plastic();
    } else if (kind_ == "uber") {
        uber();
    } else if (kind_ == "substrate") {
        removeIf("Ks", 1);
        become("coateddiffuse");
        rename("Kd", "reflectance");
    } else if (kind_ == "glass") {
        removeIf("Kr", 1);
        removeIf("Kt", 1);
        become("dielectric");
    } else if (kind_ == "metal") {
        removeIf("Kr", 1);
        become("conductor");
    } else if (kind_ == "mirror") {
        removeIf("Kr", 1);
        become("conductor");
        add({.type = "float", .name = "roughness", .numbers = {0}});
        add({.type = "spectrum", .name = "eta", .strings = {"metal-Ag-eta"}});
        add({.type = "spectrum", .name = "k", .strings = {"metal-Ag-k"}});
    } else if (kind_ == "shinymetal") {
        removeIf("Ks", 0);
        become("conductor");
        rename("Kr", "reflectance");
    } else if (kind_ == "translucent") {
        removeIf("reflect", 0);
        removeIf("transmit", 1);
        removeIf("Ks", 0);
        become("diffusetransmission");
        rename("Kd", "transmittance");
        remove({"roughness", "remaproughness"});
    } else if (kind_ == "kdsubsurface") {
        become("subsurface");
        rename("Kd", "reflectance");
    } else if (kind_ == "disney") {
        note("of the older material \"disney\" its colour alone is kept");
        become("diffuse");
        rename("color", "reflectance");
        std::erase_if(parameters_, [](const auto& p) { return p->name != "reflectance"; });
    } else if (kind_ == "mix") {
        mix();
    } else if (kind_.empty() || kind_ == "none") {
        become("interface");
    }
}

/// A colour by one that is not grey; pbrt-v4 scales by a number only.
void Upgrade::multiplyByScale(std::string_view name) {
    const Parameter *own = find(name), *factor = find("scale");
    if (!own || !factor || own->type != "rgb" || factor->type != "rgb" || grey("scale") || find("mapname"))
        return;
    Parameter product = *own;
    for (std::size_t i = 0; i < std::min(own->numbers.size(), factor->numbers.size()); ++i)
        product.numbers[i] *= factor->numbers[i];
    replace(name, std::move(product));
    remove({"scale"});
}

void Upgrade::light() {
    if (kind_ == "area") become("diffuse");
    if (kind_ == "exinfinite") become("infinite");
    remove({"samples", "nsamples"});
    if (const Parameter* map = find("mapname"); map && map->strings == std::vector<std::string>{""})
        remove({"mapname"});
    double scale = 1;
    const auto takeGrey = [&](std::string_view name) {
        const Parameter* p = find(name);
        if (!p || p->type != "rgb" || p->numbers.size() != 3) return;
        if (!grey(name))
            issues_.attempt("the mean of its colours is taken", [&] {
                throw unsupported(p->position, "a '{}' that is not grey is not supported here", name);
            });
        scale *= (p->numbers[0] + p->numbers[1] + p->numbers[2]) / 3;
        remove({name});
    };
    for (const std::string_view name : {"I", "L"}) multiplyByScale(name);
    takeGrey("scale");
    if (find("mapname")) {
        takeGrey("L");
        takeGrey("I");
        rename("mapname", "filename");
    }
    for (const std::string_view name : {"I", "L"})
        if (const Parameter* p = find(name); p && p->type == "blackbody" && p->numbers.size() == 2) {
            scale *= p->numbers[1];
            replace(name, {.type = "blackbody", .name = std::string(name), .numbers = {p->numbers[0]}});
        }
    if (scale == 1) return;
    if (const Parameter* p = find("scale"); p && p->type == "float") scale *= p->numbers[0];
    remove({"scale"});
    add({.type = "float", .name = "scale", .numbers = {scale}});
}

void Upgrade::shape() {
    rename("nlevels", "levels");
    remove({"discarddegenerateUVs", "shadowalpha"});
    rename("st", "uv");
    if (const Parameter* uv = find("uv"); uv && uv->type == "float") {
        Parameter pairs = *uv;
        pairs.type = "point2";
        if (pairs.numbers.size() % 2 != 0)
            throw badInput(uv->position, "'uv' has {} numbers, not a multiple of 2", uv->numbers.size());
        replace("uv", std::move(pairs));
    }
}

bool Upgrade::run() {
    using Step = void (Upgrade::*)();
    constexpr std::pair<std::string_view, Step> kSteps[] = {
        {"Film", &Upgrade::film},
        {"PixelFilter", &Upgrade::filter},
        {"Sampler", &Upgrade::sampler},
        {"Integrator", &Upgrade::integrator},
        {"Camera", &Upgrade::camera},
        {"Texture", &Upgrade::texture},
        {"Material", &Upgrade::material},
        {"LightSource", &Upgrade::light},
        {"AreaLightSource", &Upgrade::light},
        {"Shape", &Upgrade::shape},
    };
    for (const auto& [directive, step] : kSteps)
        if (directive == directive_) (this->*step)();
    return old_;
}

} // namespace

bool upgradeEntity(std::string_view directive, const Position& where, std::string& kind,
                   ParameterVector& parameters, Issues& issues) {
    return Upgrade(directive, where, kind, parameters, issues).run();
}

} // namespace slant
