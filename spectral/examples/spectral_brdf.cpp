#include <cstdio>

#include <hts/direction.hpp>
#include <spectral/materials/optical_constants_files.hpp>
#include <spectral/models/reflectance.hpp>

int main() {
    using namespace hts::spectral;
    const Reflector aluminium{"rough aluminium", {0.28, 1.77}, built_in_optical_constants("Al"), DiffuseAlbedo{0}};
    const auto wavelengths = WavelengthGrid::linear(0.4, 0.7, 4);  // um
    const SpectralReflectance reflectance{aluminium, wavelengths};

    const auto light = hts::Direction::from_degrees(30, 0), view = hts::Direction::from_degrees(40, 180);
    const auto brdf = reflectance.brdf({light, view});            // 1/sr
    const auto mirror = reflectance.specular_reflectance(light);  // 0 ... 1
    for (std::size_t i = 0; i < brdf.size(); ++i)
        std::printf("%.1f um  %.6f /sr  %.3e\n", wavelengths.micrometres()[i], brdf[i], mirror[i].value());
}
