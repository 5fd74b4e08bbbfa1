#include "tables/formats/radiance/klems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/text.hpp"

namespace hts::tables {
namespace {

constexpr double pi = std::numbers::pi;

double squared_sine(double degrees) {
    const double sine = std::sin(degrees * pi / 180);
    return sine * sine;
}

class KlemsBrdf final : public spectral::Evaluator {
  public:
    KlemsBrdf(const std::string& name, const spectral::WavelengthGrid& wavelength, KlemsBasis basis,
              std::vector<double> means)
        : spectral::Evaluator{name, wavelength}, basis_{std::move(basis)}, means_{std::move(means)} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const bool above = pair.in.cos_theta() > 0 && pair.out.cos_theta() > 0;
        values[0] =
            above ? means_[basis_.patch(pair.out) * basis_.size() + basis_.patch(pair.in.mirror())] : 0;
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        values[0] = 0;
    }

  private:
    KlemsBasis basis_;
    std::vector<double> means_;
};

/// Points of all patches by an even sequence (Roberts' R4): two of its four dimensions are for the light, two
/// for the view, so that a patch's are the same whatever the other. As many are kept as most pairs need.
class PatchPoints {
  public:
    static constexpr std::size_t block = 256, most = std::size_t{1} << 15;

    explicit PatchPoints(const KlemsBasis& basis)
        : basis_{basis}, each_{std::min(16 * block, (std::size_t{1} << 20) / basis.size() / block * block)} {
        for (std::size_t patch = 0; patch < basis.size(); ++patch) {
            for (std::size_t i = 0; i < each_; ++i) kept_.push_back({light(patch, i), view(patch, i)});
        }
    }
    /// Those of a block from `first` on.
    void fill(std::size_t of_light, std::size_t of_view, std::size_t first,
              std::vector<DirectionPair>& pairs) const {
        pairs.clear();
        for (std::size_t i = first; i < first + block; ++i) {
            if (i < each_) {
                pairs.push_back({kept_[of_light * each_ + i].in, kept_[of_view * each_ + i].out});
            } else {
                pairs.push_back({light(of_light, i), view(of_view, i)});
            }
        }
    }

  private:
    [[nodiscard]] Direction point(std::size_t patch, std::size_t i, double across, double along) const {
        const auto at = [&](double step) { return std::fmod(0.5 + static_cast<double>(i + 1) * step, 1.0); };
        return basis_.point(patch, at(across), at(along));
    }
    [[nodiscard]] Direction light(std::size_t patch, std::size_t i) const {
        return point(patch, i, 0.8566748838545029, 0.7338918566271260).mirror();
    }
    [[nodiscard]] Direction view(std::size_t patch, std::size_t i) const {
        return point(patch, i, 0.6287067210378087, 0.5385972572236101);
    }

    const KlemsBasis& basis_;
    std::size_t each_;                 // points kept of each patch
    std::vector<DirectionPair> kept_;  // as light and as view
};

/// Means over a pair of patches, one per channel, each of twice as many points until it changes by 1 % at
/// most.
std::vector<double> means_of(const spectral::Reflectance& brdf, const PatchPoints& points, std::size_t light,
                             std::size_t view) {
    const std::size_t channels = brdf.size();
    std::vector<double> sums(channels, 0), means(channels, -1), values(PatchPoints::block * channels);
    std::vector<bool> settled(channels, false);
    std::vector<DirectionPair> pairs;
    for (std::size_t count = 0, next = PatchPoints::block;; next *= 2) {
        for (; count < next; count += PatchPoints::block) {
            points.fill(light, view, count, pairs);
            brdf.evaluator().brdf_batch(pairs, values);
            for (std::size_t i = 0; i < values.size(); ++i) sums[i % channels] += values[i];
        }
        for (std::size_t i = 0; i < channels; ++i) {
            if (settled[i]) continue;
            const double mean = sums[i] / static_cast<double>(count);
            settled[i] = next >= PatchPoints::most || std::abs(mean - means[i]) <= 0.01 * mean;
            means[i] = mean;
        }
        if (std::ranges::find(settled, false) == settled.end()) return means;
    }
}

/// Means of the specular reflectance over a patch of light, one per channel.
std::vector<double> means_mirrored(const spectral::Reflectance& brdf, const KlemsBasis& basis,
                                   std::size_t light) {
    constexpr int across = 64, along = 8;
    std::vector<double> means(brdf.size(), 0), values(brdf.size());
    for (int i = 0; i < across * along; ++i) {
        const int circle = i / along, step = i % along;
        const double ring = (circle + 0.5) / across, turn = (step + 0.5) / along;
        brdf.specular_reflectance(basis.point(light, ring, turn).mirror(), values);
        for (std::size_t c = 0; c < means.size(); ++c) means[c] += values[c] / (across * along);
    }
    return means;
}

}  // namespace

KlemsBasis::KlemsBasis(std::string name, std::vector<Ring> rings)
    : name_{std::move(name)}, rings_{std::move(rings)} {
    double edge = 0;
    for (const Ring& ring : rings_) {
        if (!(std::abs(ring.low - edge) <= 1e-6 && ring.high > ring.low))
            throw Error{"angle basis " + spectral::in_quotes(name_) +
                        ": rings must follow each other, from 0 degrees on"};
        if (ring.patches < 1 || ring.patches > 10'000)
            throw out_of_range("number of patches of a ring", static_cast<double>(ring.patches), "",
                               "from 1 to 10000");
        size_ += ring.patches;
        edge = ring.high;
    }
    if (!(std::abs(edge - 90) <= 1e-6))
        throw out_of_range("last polar angle of the angle basis", edge, "deg", "90 deg");
}

const KlemsBasis& KlemsBasis::full() {
    static const KlemsBasis basis{"LBNL/Klems Full",
                                  {{0, 5, 1},
                                   {5, 15, 8},
                                   {15, 25, 16},
                                   {25, 35, 20},
                                   {35, 45, 24},
                                   {45, 55, 24},
                                   {55, 65, 24},
                                   {65, 75, 16},
                                   {75, 90, 12}}};
    return basis;
}

const KlemsBasis& KlemsBasis::half() {
    static const KlemsBasis basis{"LBNL/Klems Half",
                                  {{0, 6.5, 1},
                                   {6.5, 19.5, 8},
                                   {19.5, 32.5, 12},
                                   {32.5, 46.5, 16},
                                   {46.5, 61.5, 20},
                                   {61.5, 76.5, 12},
                                   {76.5, 90, 4}}};
    return basis;
}

const KlemsBasis& KlemsBasis::quarter() {
    static const KlemsBasis basis{"LBNL/Klems Quarter",
                                  {{0, 9, 1}, {9, 27, 8}, {27, 46, 12}, {46, 66, 12}, {66, 90, 8}}};
    return basis;
}

const KlemsBasis& KlemsBasis::named(std::string_view name) {
    for (const KlemsBasis* basis : {&full(), &half(), &quarter()}) {
        if (spectral::same_letters(basis->name(), name)) return *basis;
    }
    throw Error{"angle basis " + spectral::in_quotes(name.substr(0, 40)) +
                ": must be LBNL/Klems Full, LBNL/Klems Half or LBNL/Klems Quarter"};
}

std::size_t KlemsBasis::patch(const Direction& direction) const noexcept {
    const double theta = std::atan2(direction.sin_theta(), direction.cos_theta()) * 180 / pi;
    const double turn = std::atan2(direction.sin_phi(), direction.cos_phi()) / (2 * pi) + 1;
    std::size_t first = 0, ring = 0;
    for (; ring + 1 < rings_.size() && theta >= rings_[ring].high; ++ring) first += rings_[ring].patches;
    const std::size_t count = rings_[ring].patches;
    return first + static_cast<std::size_t>(std::lround(turn * static_cast<double>(count))) % count;
}

std::size_t KlemsBasis::ring_of(std::size_t patch, std::size_t& place) const {
    std::size_t ring = 0;
    for (; patch >= rings_.at(ring).patches; ++ring) patch -= rings_[ring].patches;
    place = patch;
    return ring;
}

double KlemsBasis::projected_solid_angle(std::size_t patch) const {
    std::size_t place = 0;
    const Ring& ring = rings_[ring_of(patch, place)];
    return pi * (squared_sine(ring.high) - squared_sine(ring.low)) / static_cast<double>(ring.patches);
}

Direction KlemsBasis::point(std::size_t patch, double across, double along) const {
    std::size_t place = 0;
    const Ring& ring = rings_[ring_of(patch, place)];
    const double sine = std::sqrt(std::lerp(squared_sine(ring.low), squared_sine(ring.high), across));
    const double phi =
        2 * pi * (static_cast<double>(place) + along - 0.5) / static_cast<double>(ring.patches);
    return Direction::from_angles(std::min(std::asin(sine), pi / 2), phi);
}

std::vector<std::vector<double>> klems_means(const spectral::Reflectance& brdf, const KlemsBasis& basis,
                                             bool specular) {
    const std::size_t size = basis.size();
    std::vector<std::vector<double>> means(brdf.size(), std::vector<double>(size * size, 0));
    const PatchPoints points{basis};
    const auto mean = [&](std::size_t pair) {
        const auto found = means_of(brdf, points, pair % size, pair / size);
        for (std::size_t c = 0; c < found.size(); ++c) means[c][pair] = found[c];
    };
    spectral::parallel_for(size * size, mean, 16);
    for (std::size_t patch = 0; specular && patch < size; ++patch) {
        const auto mirrored = means_mirrored(brdf, basis, patch);
        for (std::size_t c = 0; c < means.size(); ++c)
            means[c][patch * size + patch] += mirrored[c] / basis.projected_solid_angle(patch);
    }
    return means;
}

spectral::Reflectance klems_brdf(const std::string& name, const spectral::WavelengthGrid& wavelength,
                                 const KlemsBasis& basis, std::vector<double> means) {
    if (wavelength.size() != 1 || means.size() != basis.size() * basis.size()) {
        throw out_of_range("number of patches' means", static_cast<double>(means.size()), "",
                           std::to_string(basis.size() * basis.size()) + " at one wavelength");
    }
    return spectral::Reflectance{
        std::make_shared<const KlemsBrdf>(name, wavelength, basis, std::move(means))};
}

}  // namespace hts::tables
