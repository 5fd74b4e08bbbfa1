#include "validation/scattering/vector/plane_wave_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/polarisation.hpp"

namespace hts::validation {
namespace {

constexpr double k = 2 * std::numbers::pi;

}  // namespace

PlaneWaveBeam::PlaneWaveBeam(double theta, double azimuth, double width, double period, double least)
    : azimuth_{azimuth} {
    const double step = k / period, cosine = std::cos(theta);
    // power goes with exp(-(width kappa)^2/2) cos^3 about the centre
    const double centre = k * std::sin(theta) * (1 + 3 / (k * width * cosine * k * width * cosine));
    const int reach = static_cast<int>(std::ceil(2 * std::sqrt(-std::log(least)) / (width * step)));
    double all = 0;
    for (int m = -reach; m <= reach; ++m) {
        for (int n = -reach; n <= reach; ++n) {
            const double along = (centre + m * step) / k, across = n * step / k;
            const double square = along * along + across * across;
            const double away = (m * m + n * n) * step * step * width * width / 4;
            if (square >= 1 || away > -std::log(least)) continue;
            const double down = std::sqrt(1 - square);
            const double c = std::cos(azimuth), s = std::sin(azimuth);
            const double amplitude = std::exp(-away) * down / cosine;
            waves_.push_back({{along * c - across * s, along * s + across * c, -down},
                              amplitude,
                              amplitude * amplitude * down});
            all += waves_.back().weight;
        }
    }
    for (BeamWave& wave : waves_) {
        wave.weight /= all;
        s_.push_back(s_vector_of_incident(wave.in()));
    }
    power_ = period * period * all;
}

std::array<ComplexVector, 2> PlaneWaveBeam::magnetic_field(Vector3 point) const noexcept {
    std::array<ComplexVector, 2> field{};
    for (std::size_t i = 0; i < waves_.size(); ++i) {
        const std::complex<double> value = std::polar(waves_[i].amplitude, k * dot(waves_[i].along, point));
        const Vector3 of_s = cross(waves_[i].along, s_[i]);  // H = k x E, and k x p = s
        field[0][0] += value * of_s.x;
        field[0][1] += value * of_s.y;
        field[0][2] += value * of_s.z;
        field[1][0] += value * s_[i].x;
        field[1][1] += value * s_[i].y;
        field[1][2] += value * s_[i].z;
    }
    return field;
}

}  // namespace hts::validation
