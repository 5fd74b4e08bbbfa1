#include "tables/formats/merl.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "tables/formats/little_endian.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array<std::size_t, 3> bins{90, 90, 180};  // theta_h, theta_d, phi_d
constexpr std::size_t plane = bins[0] * bins[1] * bins[2];
constexpr std::size_t header = 3 * sizeof(std::int32_t);
static_assert(merl_size == header + 3 * plane * sizeof(double));
// Of blue, green and red, in the order of wavelengths; their planes stand in the opposite order.
constexpr std::array<double, 3> scale{1.66 / 1500, 1.15 / 1500, 1.0 / 1500};
constexpr std::size_t plane_of(std::size_t channel) {
    return 2 - channel;
}

// Coordinates along the bins of the three angles, 0 ... number of bins.
using Coordinates = std::array<double, 3>;

Coordinates coordinates_of(const DirectionPair& pair) noexcept {
    const Vector3 in = pair.in.vector(), sum = in + pair.out.vector();
    const double across = std::hypot(sum.x, sum.y), length = std::hypot(across, sum.z);
    const double sine = across / length, cosine = sum.z / length;
    const double cos_phi = across > 0 ? sum.x / across : 1, sin_phi = across > 0 ? sum.y / across : 0;
    const Vector3 light{cosine * (cos_phi * in.x + sin_phi * in.y) - sine * in.z,
                        cos_phi * in.y - sin_phi * in.x,
                        sine * (cos_phi * in.x + sin_phi * in.y) + cosine * in.z};
    double phi = std::atan2(light.y, light.x);
    if (phi < 0) phi += pi;
    return {std::sqrt(std::atan2(across, sum.z) * 2 / pi) * 90,
            std::atan2(std::hypot(light.x, light.y), light.z) * 2 / pi * 90, phi / pi * 180};
}

// The pair of directions there; either may lie below the horizon.
struct VectorPair {
    Vector3 in, out;

    [[nodiscard]] bool above() const { return in.z > 0 && out.z > 0; }
};

VectorPair vectors_at(const Coordinates& at) {
    const double theta_h = at[0] / 90 * (at[0] / 90) * pi / 2, theta_d = at[1] / 90 * pi / 2,
                 phi_d = at[2] / 180 * pi;
    const Vector3 light{std::sin(theta_d) * std::cos(phi_d), std::sin(theta_d) * std::sin(phi_d),
                        std::cos(theta_d)};
    const Vector3 half{std::sin(theta_h), 0, std::cos(theta_h)};
    const Vector3 in{half.z * light.x + half.x * light.z, light.y, half.z * light.z - half.x * light.x};
    return {in, 2 * light.z * half - in};
}

std::optional<DirectionPair> pair_at(const Coordinates& at) {
    const auto [in, out] = vectors_at(at);
    if (!(in.z > 0 && out.z > 0)) return std::nullopt;
    return DirectionPair{Direction::from_unit_vector(in), Direction::from_unit_vector(out)};
}

Direction raised(Vector3 v) {
    constexpr double horizon = 1e-4;  // lobes are 0 on the horizon itself
    return Direction::from_vector({v.x, v.y, std::max(v.z, horizon)});
}

// That of the bin's centre, or of the point nearest to it (of 5 in each coordinate) that is above the
// horizon; of a bin below it beside such ones that of the centre, raised to the horizon.
std::optional<DirectionPair> pair_of_bin(const std::array<std::size_t, 3>& bin) {
    const auto offset_by = [&](const std::array<double, 3>& offset) {
        Coordinates at;
        for (std::size_t axis = 0; axis < 3; ++axis)
            at[axis] = static_cast<double>(bin[axis]) + 0.5 + offset[axis];
        return at;
    };
    const auto offset_pair = [&](const std::array<double, 3>& offset) { return pair_at(offset_by(offset)); };
    if (auto centre = offset_pair({0, 0, 0})) return centre;
    // both are above the horizon where tan theta_h tan theta_d |cos phi_d| < 1: the smaller each, the better
    const double upright = bin[2] < bins[2] / 2 ? 0.4 : -0.4;
    if (!offset_pair({-0.4, -0.4, upright})) {
        if (!vectors_at(offset_by({-1.4, -1.4, 3.5 * upright})).above()) return std::nullopt;
        const auto [in, out] = vectors_at(offset_by({0, 0, 0}));
        return DirectionPair{raised(in), raised(out)};
    }
    std::optional<DirectionPair> nearest;
    double least = 1;
    for (const double h : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
        for (const double d : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
            for (const double p : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
                const double distance = h * h + d * d + p * p;
                if (distance >= least) continue;
                if (auto pair = offset_pair({h, d, p})) {
                    nearest = pair;
                    least = distance;
                }
            }
        }
    }
    return nearest;
}

constexpr std::size_t position(std::size_t h, std::size_t d, std::size_t p) {
    return p + bins[2] * (d + bins[1] * h);
}

class MerlBrdf final : public spectral::Evaluator {
  public:
    MerlBrdf(const std::string& name, const spectral::WavelengthGrid& wavelengths, std::vector<double> values,
             MerlLookup lookup)
        : spectral::Evaluator{name, wavelengths}, values_{std::move(values)}, lookup_{lookup} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        for (double& value : values) value = 0;
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0)) return;
        const Coordinates at = coordinates_of(pair);
        if (lookup_ == MerlLookup::bins) {
            const auto bin = [&](std::size_t axis) {
                return std::min(static_cast<std::size_t>(at[axis]), bins[axis] - 1);
            };
            const std::size_t here = position(bin(0), bin(1), bin(2));
            for (std::size_t c = 0; c < 3; ++c) values[c] = std::max(0.0, values_[3 * here + c]);
            return;
        }
        interpolate(at, values);
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        for (double& value : values) value = 0;
    }

  private:
    // A pair of neighbouring centres and the share of the second.
    struct Neighbours {
        std::size_t low, high;
        double share;
    };
    static Neighbours neighbours(double at, std::size_t count) noexcept {
        const double from_centre = std::clamp(at - 0.5, 0.0, static_cast<double>(count - 1));
        const auto low = std::min(static_cast<std::size_t>(from_centre), count - 2);
        return {low, low + 1, from_centre - static_cast<double>(low)};
    }
    static Neighbours around(double at,
                             std::size_t count) noexcept {  // phi_d begins again after its last bin
        const double turned = at < 0.5 ? at - 0.5 + static_cast<double>(count) : at - 0.5;
        const auto low = std::min(static_cast<std::size_t>(turned), count - 1);
        return {low, (low + 1) % count, turned - static_cast<double>(low)};
    }
    // Of the four centres about a place, for a cubic through them (Catmull and Rom).
    static std::array<double, 4> cubic(double share) noexcept {
        const double s = share, r = 1 - share;
        return {-s * r * r / 2, 1 + s * s * (3 * s - 5) / 2, 1 + r * r * (3 * r - 5) / 2, -r * s * s / 2};
    }
    void interpolate(const Coordinates& at, std::span<double> values) const noexcept {
        const Neighbours h = neighbours(at[0], bins[0]), d = neighbours(at[1], bins[1]),
                         p = around(at[2], bins[2]);
        std::array<double, 3> share{};
        for (unsigned corner = 0; corner < 4; ++corner) {
            const bool up_h = (corner & 1) != 0, up_p = (corner & 2) != 0;
            const double weight = (up_h ? h.share : 1 - h.share) * (up_p ? p.share : 1 - p.share);
            const std::size_t row = position(up_h ? h.high : h.low, 0, up_p ? p.high : p.low);
            for (std::size_t c = 0; c < 3; ++c) add_row(row, d, c, weight, values[c], share[c]);
        }
        for (std::size_t c = 0; c < 3; ++c) values[c] = share[c] > 0 ? values[c] / share[c] : 0;
    }
    [[nodiscard]] double at_theta_d(std::size_t row, std::size_t d, std::size_t c) const noexcept {
        return values_[3 * (row + bins[2] * d) + c];
    }
    // Where four values in a row are positive, a cubic through their logarithms; else a
    // straight line between the two.
    void add_row(std::size_t row, const Neighbours& d, std::size_t c, double weight, double& sum,
                 double& share) const noexcept {
        const double before = d.low > 0 ? at_theta_d(row, d.low - 1, c) : 0, low = at_theta_d(row, d.low, c),
                     high = at_theta_d(row, d.high, c);
        if (before > 0 && low > 0 && high > 0) {
            double after = d.high + 1 < bins[1] ? at_theta_d(row, d.high + 1, c) : -1;
            if (after < 0)
                after = before * std::pow(high / low, 3);  // the horizon is near: the parabola goes on
            const auto weights = cubic(d.share);
            if (after > 0) {
                sum += weight * std::exp(weights[0] * std::log(before) + weights[1] * std::log(low) +
                                         weights[2] * std::log(high) + weights[3] * std::log(after));
                share += weight;
                return;
            }
        }
        for (const auto& [value, part] : {std::pair{low, 1 - d.share}, {high, d.share}}) {
            if (value < 0) continue;
            sum += weight * part * value;
            share += weight * part;
        }
    }

    std::vector<double> values_;  // bin by bin, blue, green and red together
    MerlLookup lookup_;
};

void require_three(const spectral::WavelengthGrid& wavelengths) {
    if (wavelengths.size() == 3) return;
    throw out_of_range("number of wavelengths", static_cast<double>(wavelengths.size()), "",
                       "3 in a MERL file, for blue, green and red");
}

}  // namespace

std::string merl_bytes(const spectral::Reflectance& brdf) {
    require_three(brdf.wavelengths());
    if (!brdf.properties().isotropic) {
        throw Error{brdf.name() + ": depends on the azimuth of the light, which a MERL file does not hold"};
    }
    std::vector<double> planes(3 * plane, -1);
    spectral::parallel_for(bins[0], [&](std::size_t h) {
        for (std::size_t i = 0; i < bins[1] * bins[2]; ++i) {
            const std::array<std::size_t, 3> bin{h, i / bins[2], i % bins[2]};
            const auto pair = pair_of_bin(bin);
            if (!pair) continue;
            std::array<double, 3> values;
            brdf.brdf(*pair, values);
            for (std::size_t c = 0; c < 3; ++c) {
                planes[plane_of(c) * plane + position(bin[0], bin[1], bin[2])] = values[c] / scale[c];
            }
        }
    });
    std::string bytes;
    bytes.reserve(merl_size);
    for (const std::size_t count : bins) append_little_endian(bytes, static_cast<std::int32_t>(count));
    for (const double value : planes) append_little_endian(bytes, value);
    return bytes;
}

spectral::Reflectance merl_brdf(std::string_view bytes, const std::string& name,
                                const spectral::WavelengthGrid& wavelengths, MerlLookup lookup) {
    require_three(wavelengths);
    if (bytes.size() != merl_size) {
        throw Error{name + ": " + std::to_string(bytes.size()) + " bytes: a MERL file has " +
                    std::to_string(merl_size)};
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t offset = axis * sizeof(std::int32_t);
        const auto count = from_little_endian<std::int32_t>(bytes.substr(offset));
        if (count != static_cast<std::int32_t>(bins[axis])) {
            throw Error{name + ": offset " + std::to_string(offset) + ": " + std::to_string(count) +
                        " bins: must be " + std::to_string(bins[axis])};
        }
    }
    std::vector<double> values(3 * plane);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t c = i % 3;
        const std::size_t offset = header + (plane_of(c) * plane + i / 3) * sizeof(double);
        values[i] = from_little_endian<double>(bytes.substr(offset)) * scale[c];
        if (std::abs(values[i]) <= largest_number) continue;
        throw Error{name + ": offset " + std::to_string(offset) + ": BRDF " + shortest(values[i]) +
                    " 1/sr: must be from -1e100 to 1e100"};
    }
    return spectral::Reflectance{
        std::make_shared<const MerlBrdf>(name, wavelengths, std::move(values), lookup)};
}

}  // namespace hts::tables
