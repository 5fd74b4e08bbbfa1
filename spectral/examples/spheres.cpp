// A row of spheres in a studio, one for each material file:  hts_example_spheres PICTURE.png MATERIAL.json …
#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <numbers>
#include <span>
#include <vector>

#include <spectral/spectral.hpp>

namespace {

using namespace hts::spectral;
using hts::Direction, hts::Vector3;

constexpr int size = 200;        // pixels of a sphere's square
constexpr double radius = 0.94;  // of a sphere, in half squares

/// Light from a small part of the sky; the viewer is far off along z, y is up.
struct Lamp {
    Vector3 towards;
    double irradiance;
};

/// A bright lamp on the upper left, a weaker one on the right, and a grey room.
std::vector<Lamp> studio() {
    constexpr int count = 600;
    std::vector<Lamp> lamps;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count, across = std::sqrt(1 - z * z);
        const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));  // spreads them evenly
        const Vector3 towards{across * std::cos(turn), across * std::sin(turn), z};
        double radiance = 0.15 + 0.1 * towards.y;
        if (dot(towards, {-0.48, 0.60, 0.64}) > 0.93) radiance = 4;
        if (dot(towards, {0.90, 0.10, 0.424}) > 0.96) radiance = 1.5;
        lamps.push_back({towards, radiance * 4 * std::numbers::pi / count});
    }
    return lamps;
}

/// Pairs of directions in the frames of the points of a row of the picture, and what each adds to a point.
struct Row {
    std::vector<hts::DirectionPair> pairs;
    std::vector<double> irradiances;
    std::vector<std::size_t> columns;

    /// The point where the sphere's normal is `normal`.
    void add(std::size_t column, Vector3 normal, const std::vector<Lamp>& lamps) {
        const Vector3 east = cross({0, 1, 0}, normal), x = 1 / std::sqrt(dot(east, east)) * east;
        const Vector3 y = cross(normal, x);
        const auto seen = [&](Vector3 v) { return Vector3{dot(v, x), dot(v, y), dot(v, normal)}; };
        const Direction out = Direction::from_vector(seen({0, 0, 1}));
        for (const Lamp& lamp : lamps) {
            const Vector3 in = seen(lamp.towards);
            if (in.z <= 0) continue;
            pairs.push_back({Direction::from_vector(in), out});
            irradiances.push_back(lamp.irradiance * in.z);
            columns.push_back(column);
        }
    }
};

/// Light towards the viewer from a row of points, one spectrum each.
std::vector<double> radiance(const Row& row, const Reflectance& reflectance) {
    const std::size_t wavelengths = reflectance.size();
    std::vector<double> brdf(row.pairs.size() * wavelengths);
    reflectance.brdf(row.pairs, brdf);  // on all cores
    std::vector<double> result(size * wavelengths, 0.0);
    for (std::size_t k = 0; k < brdf.size(); ++k) {
        const std::size_t pair = k / wavelengths;
        result[row.columns[pair] * wavelengths + k % wavelengths] += brdf[k] * row.irradiances[pair];
    }
    return result;
}

/// Colours sent to a screen, by rows from the top; black around the sphere.
std::vector<DisplayRgb> sphere(const Reflectance& reflectance) {
    const auto lamps = studio();
    const auto weights = tristimulus_weights(reflectance.wavelengths().micrometres(), Illuminant::D65);
    std::vector<DisplayRgb> pixels;
    for (int j = 0; j < size; ++j) {
        Row row;
        for (int i = 0; i < size; ++i) {
            const double x = ((2 * i + 1.0) / size - 1) / radius, y = (1 - (2 * j + 1.0) / size) / radius;
            const double across = x * x + y * y;
            if (across < 1) row.add(static_cast<std::size_t>(i), {x, y, std::sqrt(1 - across)}, lamps);
        }
        const auto spectra = radiance(row, reflectance);
        for (std::size_t i = 0; i < size; ++i) {
            const std::span spectrum{spectra.data() + i * reflectance.size(), reflectance.size()};
            pixels.push_back(DisplayRgb::from_linear(linear_srgb(weights(spectrum), Illuminant::D65)));
        }
    }
    return pixels;
}

void draw(const char* picture, const std::vector<const char*>& materials) {
    std::vector<std::vector<DisplayRgb>> spheres;
    spheres.reserve(materials.size());
    for (const char* path : materials)
        spheres.push_back(sphere(read_material(path).at(WavelengthGrid::linear(0.4, 0.7, 7))));
    std::vector<std::uint8_t> rgb;
    for (std::size_t row = 0; row < size; ++row) {
        for (const auto& pixels : spheres) {
            for (std::size_t column = 0; column < size; ++column)
                std::ranges::copy(pixels[row * size + column].eight_bit(), std::back_inserter(rgb));
        }
    }
    std::ofstream{picture, std::ios::binary} << png_bytes(size * spheres.size(), size, rgb);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc < 3) throw hts::Error{"usage: hts_example_spheres PICTURE.png MATERIAL.json ..."};
        draw(argv[1], {argv + 2, argv + argc});
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
