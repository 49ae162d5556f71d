// Transform directives against matrices worked out by hand (pbrt-v4's definitions, column vectors).
#include "scene/transforms.h"
#include "support/scene_text.h"

#include <cmath>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::errorOf;
using test::sceneOf;
using test::worldOf;

/// Transform of a sphere after the directives.
glm::dmat4 matrixAfter(const std::string& directives) {
    return worldOf(directives + "\nShape \"sphere\"").shapes.at(0).worldFromObject.at[0];
}

/// `rows` is written as on paper.
void expectRows(const glm::dmat4& matrix, const double (&rows)[3][4]) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            EXPECT_NEAR(matrix[column][row], rows[row][column], 1e-12)
                << "row " << row << ", column " << column;
    for (int column = 0; column < 4; ++column) EXPECT_EQ(matrix[column][3], column == 3 ? 1 : 0);
}

TEST(SceneTransforms, multiplyFromTheRight) {
    expectRows(matrixAfter("Translate 1 2 3"), {{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}});
    expectRows(matrixAfter("Scale 2 3 -4"), {{2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, -4, 0}});
    expectRows(matrixAfter("Translate 1 2 3 Scale 2 2 2 Translate 1 0 0"),
               {{2, 0, 0, 3}, {0, 2, 0, 2}, {0, 0, 2, 3}});
    expectRows(matrixAfter("Translate [1 2 3] Identity"), {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}});
}

TEST(SceneTransforms, rotateAboutAnyAxis) {
    expectRows(matrixAfter("Rotate 90 0 0 1"), {{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}});
    expectRows(matrixAfter("Rotate 90 5 0 0"), {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}});
    expectRows(matrixAfter("Rotate 120 1 1 1"), {{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}});
}

TEST(SceneTransforms, readMatricesByColumns) {
    expectRows(matrixAfter("Translate 9 9 9 Transform [1 2 0 0  0 1 0 0  0 3 1 0  4 5 6 1]"),
               {{1, 0, 0, 4}, {2, 1, 3, 5}, {0, 0, 1, 6}});
    expectRows(matrixAfter("Translate 1 0 0 ConcatTransform [0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1]"),
               {{0, -1, 0, 1}, {1, 0, 0, 0}, {0, 0, 1, 0}});
    expectRows(matrixAfter("Transform [1 0 0 0  0 1 0 1e-9  0 0 1 0  0 0 0 0.9999999]"),
               {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}});
}

TEST(SceneTransforms, lookAtIsLeftHanded) {
    // From +x towards the origin with y up, the camera's right is +z: z forward, x = up x forward.
    const Scene scene = sceneOf("LookAt 5 0 0  0 0 0  0 1 0  Camera \"perspective\" WorldBegin");
    expectRows(scene.camera.worldFromCamera.at[0], {{0, 0, -1, 5}, {0, 1, 0, 0}, {1, 0, 0, 0}});
    // An up vector that leans is made upright.
    const double h = std::sqrt(0.5);
    const Scene tilted = sceneOf("LookAt 0 0 0  1 0 1  3 2 3  Camera \"perspective\" WorldBegin");
    expectRows(tilted.camera.worldFromCamera.at[0], {{h, 0, h, 0}, {0, 1, 0, 0}, {-h, 0, h, 0}});
    EXPECT_EQ(errorOf("LookAt 0 0 0  0 0 0  0 1 0"),
              "s.pbrt:1:1: LookAt needs a target apart from the eye and an up vector across the view");
    EXPECT_EQ(errorOf("\n LookAt 0 0 0  0 1 0  0 2 0"),
              "s.pbrt:2:2: LookAt needs a target apart from the eye and an up vector across the view");
}

TEST(SceneTransforms, nameCoordinateSystems) {
    // Before WorldBegin the matrix goes from world to camera; "camera" is the way back.
    const Scene scene = sceneOf("Scale -1 1 1 Translate 0 0 4 Camera \"perspective\"\nWorldBegin\n"
                                "Translate 1 0 0 CoordinateSystem \"here\" Identity\n"
                                "CoordSysTransform \"camera\" Shape \"sphere\"\n"
                                "CoordSysTransform \"here\" Shape \"sphere\"\n"
                                "CoordSysTransform \"world\" Shape \"sphere\"");
    expectRows(scene.camera.worldFromCamera.at[0], {{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -4}});
    EXPECT_EQ(scene.shapes.at(0).worldFromObject.at[0], scene.camera.worldFromCamera.at[0]);
    expectRows(scene.shapes.at(1).worldFromObject.at[0], {{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}});
    expectRows(scene.shapes.at(2).worldFromObject.at[0], {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}});
    EXPECT_EQ(errorOf("WorldBegin CoordSysTransform \"wrold\""),
              "s.pbrt:1:30: there is no coordinate system \"wrold\", did you mean 'world'?");
}

TEST(SceneTransforms, moveWhileTheShutterIsOpen) {
    const std::string move = "ActiveTransform EndTime Translate 8 0 0 ActiveTransform All ";
    const Scene scene =
        sceneOf("TransformTimes 0 2 " + move +
                "Camera \"perspective\" \"float shutterclose\" .5 TransformTimes 0 1 WorldBegin " + move +
                "Scale 2 2 2 Shape \"sphere\" ObjectBegin \"a\" Shape \"disk\" ObjectEnd " + move +
                "ObjectInstance \"a\"");
    const auto expectMotion = [](const MovingTransform& transform, double x, double endTime) {
        EXPECT_TRUE(transform.moves());
        EXPECT_EQ(transform.at[0][3].x, 0);
        EXPECT_EQ(transform.at[1][3].x, x);
        EXPECT_EQ(transform.times, (std::array<double, 2>{0, endTime}));
    };
    // The camera has the times that stood before it, and moves against what moves the world.
    expectMotion(scene.camera.worldFromCamera, -8, 4);
    expectMotion(scene.shapes.at(0).worldFromObject, 8, 2);
    expectMotion(scene.objects.at(0).shapes.at(0).worldFromObject, 8, 2);
    expectMotion(scene.instances.at(0).worldFromInstance, 24, 2);
    const Scene early = sceneOf("TransformTimes -2 0 WorldBegin " + move + "Shape \"sphere\"");
    EXPECT_FALSE(early.shapes.at(0).worldFromObject.moves());
    EXPECT_EQ(early.shapes.at(0).worldFromObject.at[0][3].x, 8);
}

TEST(SceneTransforms, thatFlattenShapesLeaveThemOut) {
    test::RecordingMonitor monitor;
    const Scene scene =
        readSceneText("WorldBegin ObjectBegin \"o\" Shape \"sphere\" ObjectEnd\n"
                      "AttributeBegin Scale 1 0 1 Shape \"sphere\" ObjectInstance \"o\" AttributeEnd\n"
                      "Shape \"disk\"",
                      "s.pbrt", monitor);
    EXPECT_EQ(scene.shapes.size(), 1u);
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_EQ(monitor.warnings,
              std::vector<std::string>{
                  "s.pbrt:2:28: the transform here is singular: what it flattens is left out (2 times)"});
}

TEST(SceneTransforms, areRefusedWhenTheyCannotBeInverted) {
    const std::string mirrors = "ActiveTransform EndTime Scale 1 -1 1 ActiveTransform All\n",
                      message = "the transform here mirrors at one of StartTime and EndTime, but not at the "
                                "other: it would be singular in between";
    EXPECT_EQ(errorOf("WorldBegin " + mirrors + "Shape \"sphere\""), "s.pbrt:2:1: " + message);
    EXPECT_EQ(errorOf(mirrors + "Camera \"perspective\""), "s.pbrt:2:1: " + message);
    EXPECT_EQ(errorOf("WorldBegin ObjectBegin \"a\" Shape \"sphere\" ObjectEnd " + mirrors +
                      "ObjectInstance \"a\""),
              "s.pbrt:2:1: " + message);
    const std::string singular = ": the transform here is singular: it cannot be inverted";
    EXPECT_EQ(errorOf("ActiveTransform EndTime Scale 1 0 1\nCamera \"perspective\" WorldBegin"),
              "s.pbrt:2:1" + singular);
    EXPECT_EQ(
        errorOf(
            "TransformTimes 0 1 ActiveTransform EndTime Translate 1 0 0 Identity ActiveTransform StartTime "
            "Identity WorldBegin Shape \"sphere\""),
        "");
    EXPECT_EQ(errorOf("WorldBegin Scale 1 0 1 LightSource \"point\""), "s.pbrt:1:24" + singular);
    EXPECT_EQ(errorOf("WorldBegin Scale 1 0 1 Texture \"t\" \"float\" \"windy\""), "s.pbrt:1:24" + singular);
    EXPECT_EQ(errorOf("Scale 1e-30 1e-30 1e-30 WorldBegin"), "");
    EXPECT_EQ(errorOf("Scale 1e30 1 1 Scale 1e30 1 1"),
              "s.pbrt:1:16: the transform here has numbers beyond the range of a float");
    EXPECT_EQ(errorOf("Transform [1 0 0 0  0 1 0 0  1 1 0 0  0 0 0 1] Camera \"perspective\" WorldBegin"),
              "s.pbrt:1:48" + singular);
    EXPECT_EQ(
        errorOf("Transform [1 0 0 .5  0 1 0 0  0 0 1 0  0 0 0 1]"),
        "s.pbrt:1:1: this matrix is not an affine transform: its 4th, 8th, 12th and 16th number must be 0, "
        "0, 0 and 1");
    EXPECT_EQ(errorOf("Transform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1 5]"),
              "s.pbrt:1:47: expected ']' after 16 numbers, found '5'");
    EXPECT_EQ(errorOf("Rotate 90 0 0 0"), "s.pbrt:1:1: Rotate needs an axis that is not 0 0 0");
    EXPECT_EQ(errorOf("Rotate 90 0 0"), "s.pbrt:1:14: expected a number, found the end of the file");
    EXPECT_EQ(errorOf("TransformTimes 1 1"), "s.pbrt:1:1: TransformTimes needs a start before the end");
    EXPECT_EQ(errorOf("TransformTimes 0 1e999"),
              "s.pbrt:1:18: '1e999' is not a finite number in the range of a float");
    EXPECT_EQ(errorOf("TransformTimes nan 1"),
              "s.pbrt:1:16: 'nan' is not a finite number in the range of a float");
    EXPECT_EQ(errorOf("ActiveTransform Al"),
              "s.pbrt:1:17: ActiveTransform takes All, StartTime or EndTime, not 'Al', did you mean 'All'?");
}

} // namespace
} // namespace slant
