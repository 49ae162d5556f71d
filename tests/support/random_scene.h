// Scenes drawn at random: any camera, lens, film, filter, light, material and motion, as pbrt text.
#pragma once
#include "support/draw.h"

#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace slant::test {

class RandomScene {
public:
    explicit RandomScene(Draw& draw) : draw_(draw) {}

    std::string text() {
        std::string text = film() + filter() +
                           fmt::format("Integrator \"path\" \"integer maxdepth\" {}\n", 1 + draw_.below(4));
        const bool spherical = draw_.chance(0.04f);
        moves_ = !spherical && draw_.chance(0.4f);
        if (moves_ && draw_.chance(0.3f)) text += moved();
        text += spherical ? "Camera \"spherical\"\n" : draw_.chance(0.2f) ? realistic() : thinLens();
        text += "WorldBegin\n";
        for (int lights = 1 + draw_.below(3); lights > 0; --lights) text += light();
        for (int shapes = draw_.below(2) ? draw_.below(8) : draw_.below(60); shapes > 0; --shapes)
            text += shape();
        return text;
    }

private:
    /// 1 to `most`, small numbers as often as large ones.
    int sizeUpTo(int most) { return int(std::exp(draw_(0, std::log(float(most) + 1)))); }
    std::string pick(const std::vector<std::string>& words) {
        return words[std::size_t(draw_.below(int(words.size())))];
    }
    std::string colour(float most) {
        const float red = draw_(0, most), green = draw_(0, most);
        return fmt::format("[{} {} {}]", red, green, draw_(0, most));
    }
    std::string vector(float low, float high) {
        const glm::vec2 xy = draw_.place(low, high);
        return fmt::format("{} {} {}", xy.x, xy.y, draw_(low, high));
    }

    std::string film() {
        const int width = sizeUpTo(257), height = sizeUpTo(129);
        std::string text = fmt::format("Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {} "
                                       "\"float diagonal\" 24",
                                       width, height);
        if (draw_.chance(0.2f)) {
            const int x = draw_.below(width), y = draw_.below(height);
            text += fmt::format(" \"integer pixelbounds\" [{} {} {} {}]", x, x + 1 + draw_.below(width - x),
                                y, y + 1 + draw_.below(height - y));
        }
        return text + "\n";
    }

    std::string filter() {
        const std::string kind = pick({"box", "box", "triangle", "gaussian", "mitchell", "sinc"});
        if (kind == "box") return "PixelFilter \"box\"\n";
        return fmt::format("PixelFilter \"{}\" \"float xradius\" {} \"float yradius\" {}\n", kind,
                           draw_(0.3f, 4), draw_(0.3f, 4));
    }

    std::string aperture() {
        if (draw_.chance(0.6f)) return "";
        return fmt::format(" \"string aperture\" \"{}\"",
                           pick({"disc", "gaussian", "square", "pentagon", "star",
                                 fmt::format("polygon {} {}", 3 + draw_.below(9), draw_.below(90))}));
    }

    std::string thinLens() {
        if (draw_.chance(0.08f)) return "Camera \"orthographic\"\n";
        const float radius = draw_.chance(0.15f) ? 0 : std::exp(draw_(-6, -1)), distance = draw_(0.5f, 20);
        return fmt::format(
            "Camera \"perspective\" \"float fov\" {} \"float lensradius\" {} \"float focaldistance\" {}{}\n",
            draw_(5, 110), radius, distance, aperture());
    }

    std::string realistic() {
        struct Lens {
            const char* name;
            float diameter;
        };
        constexpr Lens kLenses[] = {
            {"dgauss-50mm", 17.1f}, {"wide-22mm", 8.7f}, {"telephoto-250mm", 40.5f}, {"fisheye-10mm", 6}};
        const Lens& lens = kLenses[draw_.below(4)];
        return fmt::format(
            "Camera \"realistic\" \"string lensfile\" \"" SLANT_SOURCE_DIR
            "/scenes/lenses/{}.dat\" \"float aperturediameter\" {} \"float focusdistance\" {}{}\n",
            lens.name, lens.diameter * draw_(0.2f, 1), draw_(3, 20), aperture());
    }

    /// Moves what follows while the shutter is open, if anything does.
    std::string moved() {
        if (!moves_ || draw_.chance(0.4f)) return "";
        std::string text = "ActiveTransform EndTime ";
        if (draw_.chance(0.4f)) text += fmt::format("Rotate {} {} ", draw_(-60, 60), vector(0.1f, 1));
        return text + "Translate " + vector(-1, 1) + " ActiveTransform All\n";
    }

    std::string light() {
        const std::string kind = pick({"point", "distant", "infinite", "spot", "area", "area"});
        if (kind == "infinite") return "LightSource \"infinite\" \"rgb L\" " + colour(1) + "\n";
        if (kind == "distant")
            return "LightSource \"distant\" \"point3 from\" [" + vector(-1, 1) + "] \"rgb L\" " + colour(4) +
                   "\n";
        if (kind != "area")
            return fmt::format("LightSource \"{}\" \"point3 from\" [{}] \"rgb I\" {}\n", kind, vector(-3, 3),
                               colour(40));
        return "AttributeBegin\n" + fmt::format("Translate {}\n", vector(-3, 4)) +
               "AreaLightSource \"diffuse\" \"bool twosided\" true \"rgb L\" " + colour(10) +
               fmt::format("Shape \"{}\" \"float radius\" {}\nAttributeEnd\n", pick({"sphere", "disk"}),
                           draw_(0.05f, 1));
    }

    std::string material() {
        const std::string kind =
            pick({"diffuse", "diffuse", "diffuse", "coateddiffuse", "conductor", "coatedconductor",
                  "dielectric", "thindielectric", "diffusetransmission"});
        if (kind == "diffuse" && draw_.chance(0.3f))
            return fmt::format("Texture \"t{0}\" \"spectrum\" \"checkerboard\" \"float uscale\" {1} \"float "
                               "vscale\" {1} \"rgb tex1\" {2} \"rgb tex2\" {3}\nMaterial \"diffuse\" "
                               "\"texture reflectance\" \"t{0}\"\n",
                               textures_++, 1 + draw_.below(30), colour(1), colour(1));
        if (kind == "conductor")
            return fmt::format("Material \"conductor\" \"float roughness\" {}\n", draw_(0, 0.5f));
        if (kind == "coatedconductor" || kind.ends_with("dielectric")) return "Material \"" + kind + "\"\n";
        return "Material \"" + kind + "\" \"rgb reflectance\" " +
               colour(kind == "diffusetransmission" ? 0.5f : 1) + "\n";
    }

    std::string shape() {
        const float depth = std::exp(draw_(-1, 3.5f)); // from near the lens to far away
        const glm::vec2 xy = depth * draw_.place(-0.8f, 0.8f);
        std::string text = "AttributeBegin\n" + material() + moved() +
                           fmt::format("Translate {} {} {}\nRotate {} {}\n", xy.x, xy.y, depth, draw_(0, 360),
                                       vector(0.1f, 1));
        const float size = depth * std::exp(draw_(-4, 0));
        switch (draw_.below(5)) {
        case 0:
            text += fmt::format("Shape \"sphere\" \"float radius\" {}\n", size);
            break;
        case 1:
            text += fmt::format("Shape \"disk\" \"float radius\" {}\n", size);
            break;
        case 2:
            text +=
                fmt::format("Shape \"cylinder\" \"float radius\" {} \"float zmin\" {} \"float zmax\" {}\n",
                            size / 8, -size, size);
            break;
        case 3:
            text += fmt::format("Scale {0} {0} {0}\nShape \"trianglemesh\" \"point3 P\" [{1} {2} {3}]\n",
                                size, vector(-1, 1), vector(-1, 1), vector(-1, 1));
            break;
        default: // a wall
            text +=
                fmt::format("Scale {0} {0} {0}\nShape \"bilinearmesh\" \"point3 P\" [-3 -3 0  3 -3 0  -3 3 "
                            "0  3 3 0]\n",
                            depth);
        }
        return text + "AttributeEnd\n";
    }

    Draw& draw_;
    bool moves_ = false;
    int textures_ = 0;
};

} // namespace slant::test
