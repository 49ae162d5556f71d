#include "trace/emitting_shapes.h"

#include "trace/interaction.h"

namespace slant {
namespace {

float meanLuminance(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            sum += double(luminance({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)}));
    return float(sum / (double(image.width()) * double(image.height())));
}

class Builder {
public:
    explicit Builder(const Scene& scene) : scene_(scene) {}

    void add(const Shape& shape) {
        shape_ = &shape;
        light_ = &scene_.areaLights[std::size_t(shape.areaLightIndex)];
        toWorld_ = AnimatedTransform(shape.worldFromObject).at(0);
        turned_ = shape.reverseOrientation != (glm::determinant(glm::dmat3(toWorld_)) < 0);
        bool patches = shape.kind == ShapeKind::mesh && mesh().kind == Mesh::Kind::bilinearPatches;
        if (shape.worldFromObject.moves()) result_.motions.emplace_back(shape.worldFromObject);
        image_ = light_->imageIndex < 0 ? nullptr : &scene_.images[std::size_t(light_->imageIndex)];
        result_.shapes.push_back({int(result_.emitters.size()), image_, patches});
        if (shape.kind != ShapeKind::mesh)
            addQuadric();
        else if (patches)
            for (std::size_t i = 0; i + 3 < mesh().indices.size(); i += 4) addPatch(&mesh().indices[i]);
        else
            for (std::size_t i = 0; i + 2 < mesh().indices.size(); i += 3) addTriangle(&mesh().indices[i]);
    }
    EmittingShapes take() { return std::move(result_); }

private:
    const Mesh& mesh() const { return scene_.meshes[std::size_t(shape_->meshIndex)]; }
    glm::vec3 vertex(std::uint32_t i) const { return transformPoint(toWorld_, mesh().positions[i]); }

    /// The sign that puts the normal n of a primitive on its emitting side: shading normals decide if there
    /// are any, else the orientation.
    float sideOf(glm::vec3 n, const std::uint32_t* index, int corners) const {
        if (mesh().normals.empty()) return turned_ ? -1.f : 1.f;
        glm::vec3 sum(0);
        for (int c = 0; c < corners; ++c) sum += mesh().normals[index[c]];
        glm::dvec3 shading = glm::transpose(glm::inverse(glm::dmat3(toWorld_))) * glm::dvec3(sum);
        if (shape_->reverseOrientation) shading = -shading;
        return glm::dot(glm::dvec3(n), shading) < 0 ? -1.f : 1.f;
    }
    /// A piece of a primitive of area `primitiveArea`.
    Emitter piece(Emitter::Shape shape, float primitiveArea) const {
        Emitter e;
        e.shape = shape;
        e.twoSided = light_->twoSided;
        if (shape_->worldFromObject.moves()) e.motion = int(result_.motions.size()) - 1;
        e.radiance = (image_ ? glm::vec3(1) : light_->radiance) * light_->scale;
        if (light_->power) e.radiance *= *light_->power / ((e.twoSided ? 2 : 1) * primitiveArea * kPi);
        if (image_ && light_->power) e.radiance /= std::max(meanLuminance(*image_), 1e-30f);
        // What depends on u and v is left to the rays that meet it.
        const Texture* alpha = shape_->alpha < 0 ? nullptr : &scene_.textures[std::size_t(shape_->alpha)];
        e.invisible = alpha && alpha->kind == TextureKind::constant && alpha->value.x <= 0;
        e.sampled = !image_ && (!alpha || e.invisible);
        return e;
    }
    void pushTriangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 emittingSide, float primitiveArea) {
        glm::vec3 cross = glm::cross(b - a, c - a);
        float length = glm::length(cross);
        Emitter e = piece(Emitter::Shape::triangle, primitiveArea);
        e.origin = a;
        e.edge1 = b - a;
        e.edge2 = c - a;
        e.area = length / 2;
        e.size2 = std::max({glm::dot(b - a, b - a), glm::dot(c - a, c - a), glm::dot(c - b, c - b)});
        if (length > 0)
            e.normal = (glm::dot(cross, emittingSide) < 0 ? -1.f : 1.f) * cross / length;
        else
            e.sampled = false;
        result_.emitters.push_back(e);
    }
    void addTriangle(const std::uint32_t* index) {
        glm::vec3 a = vertex(index[0]), b = vertex(index[1]), c = vertex(index[2]);
        glm::vec3 n = glm::cross(b - a, c - a);
        pushTriangle(a, b, c, sideOf(n, index, 3) * n, glm::length(n) / 2);
    }
    void addPatch(const std::uint32_t* index) {
        glm::vec3 p00 = vertex(index[0]), p10 = vertex(index[1]), p01 = vertex(index[2]),
                  p11 = vertex(index[3]);
        glm::vec3 n = glm::cross(p10 - p00, p01 - p00), opposite = glm::cross(p01 - p11, p10 - p11);
        float size = std::max(glm::distance(p00, p11), glm::distance(p10, p01));
        bool flat =
            glm::dot(n, opposite) > 0 && std::abs(glm::dot(n, p11 - p00)) <= 1e-5f * size * glm::length(n);
        if (flat) {
            glm::vec3 side = sideOf(n, index, 4) * n;
            float area = (glm::length(n) + glm::length(opposite)) / 2;
            pushTriangle(p00, p10, p01, side, area);
            pushTriangle(p11, p01, p10, side, area);
            return;
        }
        glm::vec3 twist = p11 - p10 - p01 + p00;
        float area = 0;
        constexpr int kSteps = 32;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                glm::vec2 uv = (glm::vec2(i, j) + 0.5f) / float(kSteps);
                area += glm::length(glm::cross(p10 - p00 + uv.y * twist, p01 - p00 + uv.x * twist));
            }
        area /= kSteps * kSteps;
        Emitter e = piece(Emitter::Shape::patch, area);
        e.origin = p00;
        e.edge1 = p10 - p00;
        e.edge2 = p01 - p00;
        e.twist = twist;
        e.area = area;
        e.side = sideOf(glm::cross(e.edge1 + 0.5f * twist, e.edge2 + 0.5f * twist), index, 4);
        e.sampled = e.sampled && area > 0;
        result_.emitters.push_back(e);
        result_.emitters.push_back(e);
        result_.emitters.back().sampled = false; // stands for the same piece
    }
    void addQuadric() {
        EmitterQuadric q;
        q.worldFromObject = glm::mat4(toWorld_);
        q.objectFromWorld = glm::mat4(glm::inverse(toWorld_));
        q.radius = shape_->radius;
        q.innerRadius = shape_->innerRadius;
        q.height = shape_->height;
        q.phiMax = glm::radians(std::clamp(shape_->phiMaxDegrees, 0.f, 360.f));
        if (shape_->kind != ShapeKind::disk) q.profile.emplace(*shape_);
        const float area = quadricArea(q);
        const bool wholeSphere = shape_->kind == ShapeKind::sphere && shape_->phiMaxDegrees >= 360 &&
                                 q.profile->highZ() - q.profile->lowZ() == 2 * q.profile->radius;
        Emitter e = piece(Emitter::Shape::quadric, area);
        e.area = area;
        e.side = turned_ ? -1.f : 1.f;
        e.sampled = e.sampled && area > 0;
        e.origin = glm::vec3(toWorld_ * glm::dvec4(0, 0, 0, 1));
        e.radius = q.radius * float(std::cbrt(std::abs(glm::determinant(glm::dmat3(toWorld_)))));
        if (wholeSphere && keepsSpheres())
            e.shape = Emitter::Shape::sphere;
        else {
            e.quadric = int(result_.quadrics.size());
            result_.quadrics.push_back(q);
        }
        result_.emitters.push_back(e);
    }
    /// Between two similarities of the same handedness AnimatedTransform passes through others.
    bool keepsSpheres() const {
        return isSimilarity(shape_->worldFromObject.at[0]) && isSimilarity(shape_->worldFromObject.at[1]);
    }
    static bool isSimilarity(const glm::dmat4& matrix) {
        glm::dmat3 m(matrix), product = glm::transpose(m) * m;
        double scale2 = product[0][0], worst = 0;
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r)
                worst = std::max(worst, std::abs(product[c][r] - (c == r ? scale2 : 0)));
        return worst <= 1e-5 * scale2;
    }

    const Scene& scene_;
    const Shape* shape_ = nullptr;
    const AreaLight* light_ = nullptr;
    const Image* image_ = nullptr;
    glm::dmat4 toWorld_{1.0};
    bool turned_ = false;
    EmittingShapes result_;
};

} // namespace

EmittingShapes makeEmitters(const Scene& scene) {
    Builder builder(scene);
    for (const Shape& shape : scene.shapes)
        if (shape.areaLightIndex >= 0) builder.add(shape);
    return builder.take();
}

} // namespace slant
