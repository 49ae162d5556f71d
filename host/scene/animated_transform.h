// How a transform that is given at two times moves between them: pbrt-v4's AnimatedTransform.
#pragma once
#include "scene/scene.h"

#include <glm/gtc/quaternion.hpp>

namespace slant {

/// Each matrix is a translation, times a rotation, times a symmetric stretch (polar decomposition). The
/// translation and the stretch change evenly, and the rotation turns evenly the short way round. Before the
/// first time and after the last one nothing moves.
///
/// A mirrored matrix is a rotation times a stretch by negative factors. Between stretches of the same sign
/// none is singular, so all that can go wrong is a mirrored matrix at one end only; pbrt makes no good
/// rotation of mirrored ones.
class AnimatedTransform {
public:
    explicit AnimatedTransform(const MovingTransform& ends = {});

    bool moves() const { return moves_; }
    /// At a time of the shutter. Exactly the given matrices where nothing moves.
    glm::dmat4 at(double time) const;

private:
    struct Parts {
        glm::dvec3 translation;
        glm::dquat rotation;
        glm::dmat3 stretch;
    };
    static Parts partsOf(const glm::dmat4& matrix);

    MovingTransform ends_;
    bool moves_;
    std::array<Parts, 2> parts_;
    double angle_ = 0; ///< between the two quaternions
};

/// Whether AnimatedTransform passes from one matrix to the other without becoming singular; both are not.
bool canInterpolate(const MovingTransform& ends);

} // namespace slant
