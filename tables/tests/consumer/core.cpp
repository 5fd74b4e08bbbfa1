// Uses hts::core as installed: roughened aluminium at one wavelength.
#include <cstdio>

#include <hts/hts.hpp>

int main() {
    const auto wavelength = hts::Wavelength::from_micrometres(0.5);
    const hts::HeTorrance model{{0.28, 1.77}, {wavelength, {0.769, 6.08}, 0}};
    const auto light = hts::Direction::from_degrees(30, 0);
    const hts::Draw drawn = model.sample(light, {0.3, 0.6, 0.9});
    std::printf("%s: %.6f /sr\n", name(drawn.lobe), model.brdf(light, drawn.out));
    return drawn.weight > 0 ? 0 : 1;
}
