#include <cstdio>

#include <spectral/spectral.hpp>

int main() {
    using namespace hts::spectral;
    const auto aluminium =
        he_torrance_material("rough aluminium", {0.28, 1.77}, built_in_optical_constants("Al"));
    const Reflectance reflectance = aluminium.at(WavelengthGrid::linear(0.4, 0.7, 4));  // um

    const auto light = hts::Direction::from_degrees(30, 0), view = hts::Direction::from_degrees(40, 180);
    const auto brdf = reflectance.brdf({light, view});            // 1/sr
    const auto mirror = reflectance.specular_reflectance(light);  // 0 ... 1
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        const double um = reflectance.wavelengths().micrometres()[i];
        std::printf("%.1f um  %.6f /sr  %.3e\n", um, brdf[i], mirror[i].value());
    }
}
