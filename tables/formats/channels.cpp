#include "tables/formats/channels.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "hts/error.hpp"
#include "spectral/colour/display_colour.hpp"

namespace hts::tables {
namespace {

// What a source's spectra become: a value per channel.
template <class Combine>
class Channels final : public spectral::Evaluator {
  public:
    Channels(spectral::Reflectance source, const spectral::WavelengthGrid& channels, Combine combine)
        : spectral::Evaluator{source.name(), channels},
          source_{std::move(source)},
          combine_{std::move(combine)} {
        if (source_.wavelengths().size() > most_channels) {
            throw out_of_range("number of wavelengths", static_cast<double>(source_.wavelengths().size()), "",
                               "at most " + std::to_string(most_channels));
        }
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        std::array<double, most_channels> spectrum;
        const auto all = std::span{spectrum}.first(source_.wavelengths().size());
        source_.evaluator().brdf(pair, all);
        combine_(all, values);
    }
    void brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept override {
        constexpr std::size_t most = 4096;
        std::array<double, most> spectra;
        const std::size_t in = source_.wavelengths().size(), out = wavelengths().size();
        const std::size_t block = most / in;  // >= 4
        for (std::size_t first = 0; first < pairs.size(); first += block) {
            const std::size_t count = std::min(block, pairs.size() - first);
            source_.evaluator().brdf_batch(pairs.subspan(first, count), std::span{spectra}.first(count * in));
            for (std::size_t i = 0; i < count; ++i)
                combine_(std::span<const double>{spectra}.subspan(i * in, in),
                         values.subspan((first + i) * out, out));
        }
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        std::array<double, most_channels> spectrum;
        const auto all = std::span{spectrum}.first(source_.wavelengths().size());
        source_.evaluator().specular_reflectance(in, all);
        combine_(all, values);
    }
    [[nodiscard]] bool knows(const DirectionPair& pair) const noexcept override {
        return source_.evaluator().knows(pair);
    }
    [[nodiscard]] spectral::MeasuredDomain domain() const override { return source_.evaluator().domain(); }

  private:
    spectral::Reflectance source_;
    Combine combine_;
};

// One part per wavelength.
class Joined final : public spectral::Evaluator {
  public:
    Joined(const std::string& name, const spectral::WavelengthGrid& wavelengths,
           std::vector<spectral::Reflectance> parts)
        : spectral::Evaluator{name, wavelengths}, parts_{std::move(parts)} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            parts_[i].evaluator().brdf(pair, values.subspan(i, 1));
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            parts_[i].evaluator().specular_reflectance(in, values.subspan(i, 1));
    }
    [[nodiscard]] bool knows(const DirectionPair& pair) const noexcept override {
        return std::ranges::all_of(parts_, [&](const auto& part) { return part.evaluator().knows(pair); });
    }
    [[nodiscard]] spectral::MeasuredDomain domain() const override {
        return parts_.front().evaluator().domain();
    }

  private:
    std::vector<spectral::Reflectance> parts_;
};

template <class Combine>
spectral::Reflectance channels_of(spectral::Reflectance source, const spectral::WavelengthGrid& channels,
                                  Combine combine) {
    return spectral::Reflectance{
        std::make_shared<const Channels<Combine>>(source, channels, std::move(combine))};
}

}  // namespace

void require_three_channels(const spectral::Reflectance& brdf) {
    if (brdf.size() != 3)
        throw out_of_range("number of channels", static_cast<double>(brdf.size()), "", "3 of a colour");
}

spectral::Reflectance tristimulus_brdf(spectral::Reflectance source, spectral::Illuminant illuminant) {
    const auto weights = spectral::tristimulus_weights(source.wavelengths().micrometres(), illuminant);
    return channels_of(std::move(source), rgb_wavelengths(),
                       [weights](std::span<const double> spectrum, std::span<double> values) {
                           const auto [X, Y, Z] = weights(spectrum);
                           values[0] = Z;
                           values[1] = Y;
                           values[2] = X;
                       });
}

spectral::Reflectance tristimulus_of_srgb(spectral::Reflectance rgb) {
    require_three_channels(rgb);
    return channels_of(
        std::move(rgb), rgb_wavelengths(), [](std::span<const double> all, std::span<double> values) {
            const auto [X, Y, Z] = spectral::tristimulus({all[2], all[1], all[0]}, spectral::Illuminant::D65);
            values[0] = std::max(0.0, Z);
            values[1] = std::max(0.0, Y);
            values[2] = std::max(0.0, X);
        });
}

spectral::Reflectance srgb_of_tristimulus(spectral::Reflectance zyx) {
    require_three_channels(zyx);
    return channels_of(
        std::move(zyx), rgb_wavelengths(), [](std::span<const double> all, std::span<double> values) {
            const auto rgb = spectral::linear_srgb({all[2], all[1], all[0]}, spectral::Illuminant::D65);
            values[0] = std::max(0.0, rgb.blue);
            values[1] = std::max(0.0, rgb.green);
            values[2] = std::max(0.0, rgb.red);
        });
}

spectral::Reflectance chromaticity_of_tristimulus(spectral::Reflectance zyx) {
    require_three_channels(zyx);
    static const auto names = spectral::WavelengthGrid::from_micrometres({0.46, 0.55});
    return channels_of(std::move(zyx), names, [](std::span<const double> all, std::span<double> values) {
        const double sum = all[2] + 15 * all[1] + 3 * all[0];
        values[0] = sum > 0 ? 4 * all[2] / sum : 0.19783;
        values[1] = sum > 0 ? 9 * all[1] / sum : 0.46834;
    });
}

spectral::Reflectance tristimulus_of_chromaticity(spectral::Reflectance uyv) {
    require_three_channels(uyv);
    return channels_of(std::move(uyv), rgb_wavelengths(),
                       [](std::span<const double> all, std::span<double> values) {
                           const double u = all[0], Y = all[1], v = all[2];
                           const double scale = v > 0 ? Y / (4 * v) : 0;
                           values[0] = std::max(0.0, scale * (12 - 3 * u - 20 * v));
                           values[1] = Y;
                           values[2] = scale * 9 * u;
                       });
}

const spectral::WavelengthGrid& rgb_wavelengths() {
    static const auto grid = spectral::WavelengthGrid::from_micrometres({0.46, 0.55, 0.62});
    return grid;
}

const std::vector<std::string>& rgb_channels() {
    static const std::vector<std::string> names{"B", "G", "R"};
    return names;
}

const std::vector<std::string>& xyz_channels() {
    static const std::vector<std::string> names{"Z", "Y", "X"};
    return names;
}

const std::vector<std::string>& luminance_channel() {
    static const std::vector<std::string> names{"Y"};
    return names;
}

const spectral::WavelengthGrid& luminance_wavelength() {
    static const auto grid = spectral::WavelengthGrid::from_micrometres({0.55});
    return grid;
}

spectral::Reflectance linear_srgb_brdf(spectral::Reflectance source, spectral::Illuminant illuminant) {
    const auto weights = spectral::tristimulus_weights(source.wavelengths().micrometres(), illuminant);
    return channels_of(std::move(source), rgb_wavelengths(),
                       [weights](std::span<const double> spectrum, std::span<double> values) {
                           const auto rgb = spectral::linear_srgb(weights(spectrum), weights.illuminant());
                           values[0] = std::max(0.0, rgb.blue);
                           values[1] = std::max(0.0, rgb.green);
                           values[2] = std::max(0.0, rgb.red);
                       });
}

spectral::Reflectance luminance_brdf(spectral::Reflectance source, spectral::Illuminant illuminant) {
    const auto weights = spectral::tristimulus_weights(source.wavelengths().micrometres(), illuminant);
    return channels_of(std::move(source), luminance_wavelength(),
                       [weights](std::span<const double> spectrum, std::span<double> values) {
                           values[0] = weights(spectrum).Y;
                       });
}

spectral::Reflectance brdf_at(spectral::Reflectance source, std::size_t index) {
    const auto all = source.wavelengths().micrometres();
    if (index >= all.size()) {
        throw out_of_range("index of a wavelength", static_cast<double>(index), "",
                           "below " + std::to_string(all.size()));
    }
    auto one = spectral::WavelengthGrid::from_micrometres({all[index]});
    return channels_of(
        std::move(source), one,
        [index](std::span<const double> spectrum, std::span<double> values) { values[0] = spectrum[index]; });
}

spectral::Reflectance with_channels_named(spectral::Reflectance source,
                                          const spectral::WavelengthGrid& names) {
    if (names.size() != source.wavelengths().size()) {
        throw out_of_range("number of channels", static_cast<double>(names.size()), "",
                           std::to_string(source.wavelengths().size()));
    }
    return channels_of(std::move(source), names,
                       [](std::span<const double> spectrum, std::span<double> values) {
                           std::ranges::copy(spectrum, values.begin());
                       });
}

spectral::Reflectance joined(const std::string& name, std::vector<spectral::Reflectance> parts) {
    std::vector<double> micrometres;
    for (const auto& part : parts) {
        if (part.wavelengths().size() != 1)
            throw Error{name + ": a part with " + std::to_string(part.wavelengths().size()) +
                        " wavelengths: must have 1"};
        micrometres.push_back(part.wavelengths().micrometres()[0]);
    }
    auto all = spectral::WavelengthGrid::from_micrometres(std::move(micrometres));
    return spectral::Reflectance{std::make_shared<const Joined>(name, all, std::move(parts))};
}

}  // namespace hts::tables
