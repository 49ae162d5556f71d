// Whether surfaces reflect other than diffusely, so that light has two parts (lib/shading.glsl).
layout(constant_id = 0) const bool kReflects = false;
