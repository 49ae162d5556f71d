#include <image/image.h>
#include <lightfield/lightfield.h>

int main() {
    slant::LightField field;
    field.samples.resize(1);
    const bool counted = slant::sanitize(field).total() == 1; // depth 0 is a defect
    return counted && slant::Image::rgb(3, 2).pixels.size() == 18 ? 0 : 1;
}
