#include "tables/formats/measured_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "hts/microfacet/lobes.hpp"
#include "spectral/models/model_readers.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/brdf_file.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/coverage.hpp"
#include "tables/formats/lobe.hpp"

namespace hts::tables {
namespace {

using spectral::OutsideRange;

constexpr double pi = std::numbers::pi;

// A spectral BRDF at one wavelength, between two of its own.
class OneWavelength {
  public:
    ///   outside   what is reflected at wavelengths beyond those of the BRDF
    OneWavelength(spectral::Reflectance brdf, const Wavelength& wavelength, OutsideRange outside)
        : brdf_{std::move(brdf)} {
        const double wavelength_um = wavelength.micrometres();
        const auto nodes = brdf_.wavelengths().micrometres();
        const bool inside =
            wavelength_um >= nodes.front() * (1 - 1e-9) && wavelength_um <= nodes.back() * (1 + 1e-9);
        if (!inside && outside == OutsideRange::zero) factor_ = 0;
        if (!inside && outside == OutsideRange::error) {
            const spectral::WavelengthRange range{nodes.front(), nodes.back()};
            static_cast<void>(range.admit(wavelength, outside, brdf_.name()));
        }
        const auto above = std::upper_bound(nodes.begin(), nodes.end(), wavelength_um);
        const auto index = static_cast<std::size_t>(above - nodes.begin());
        low_ = index == 0 ? 0 : index - 1;
        high_ = std::min(index, nodes.size() - 1);
        if (index > 0 && high_ > low_) share_ = (wavelength_um - nodes[low_]) / (nodes[high_] - nodes[low_]);
    }

    using Spectrum = std::array<double, most_channels>;

    [[nodiscard]] bool knows(const DirectionPair& pair) const noexcept {
        return brdf_.evaluator().knows(pair);
    }

    /// At the wavelengths of the file.
    void spectrum(const Direction& in, const Direction& out, Spectrum& result) const noexcept {
        brdf_.evaluator().brdf({in, out}, std::span{result}.first(brdf_.wavelengths().size()));
    }
    [[nodiscard]] Mueller operator()(std::span<const Mueller> matrices) const noexcept {
        return factor_ * ((1 - share_) * matrices[low_] + share_ * matrices[high_]);
    }
    [[nodiscard]] double operator()(const Spectrum& spectrum) const noexcept {
        return factor_ * std::lerp(spectrum[low_], spectrum[high_], share_);
    }
    [[nodiscard]] double operator()(const Direction& in, const Direction& out) const noexcept {
        Spectrum all;
        spectrum(in, out, all);
        return (*this)(all);
    }

  private:
    spectral::Reflectance brdf_;
    std::size_t low_, high_;
    double share_ = 0, factor_ = 1;
};

Direction turned(double cosine, double azimuth, const Direction& from) {
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    const double x = sine * std::cos(azimuth), y = sine * std::sin(azimuth);
    return Direction::from_unit_vector(
        {x * from.cos_phi() - y * from.sin_phi(), x * from.sin_phi() + y * from.cos_phi(), cosine});
}

// Which cell of the hemisphere how much light goes to, per angle of incidence; azimuths
// are those from the light.
class CellDraws {
  public:
    explicit CellDraws(const OneWavelength& brdf) : running_(incidences * cells) {
        for (std::size_t i = 0; i < incidences; ++i) {
            double sum = 0;
            for (std::size_t cell = 0; cell < cells; ++cell) {
                const double cosine = (edge(cell / turns) + edge(cell / turns + 1)) / 2;
                for (const double phi : {0.0, 0.4, 1.7, 3.9}) {  // of the light, in case it matters
                    const Direction in = Direction::from_angles(angle_of(i), phi);
                    sum += brdf(in, turned(cosine, (static_cast<double>(cell % turns) + 0.5) * turn, in)) *
                           cosine * solid_angle(cell);
                }
                running_[i * cells + cell] = sum;
            }
            for (std::size_t cell = 0; cell < cells && sum > 0; ++cell) running_[i * cells + cell] /= sum;
        }
    }

    // Density in solid angle; 0 where there is no light.
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept {
        const double x = out.cos_phi() * in.cos_phi() + out.sin_phi() * in.sin_phi();
        const double y = out.sin_phi() * in.cos_phi() - out.cos_phi() * in.sin_phi();
        const double azimuth = std::atan2(y, x), theta = std::atan2(out.sin_theta(), out.cos_theta());
        const auto ring = std::min(static_cast<std::size_t>(theta / ring_width), rings - 1);
        const double in_turns = (azimuth < 0 ? azimuth + 2 * pi : azimuth) / turn;
        const std::size_t cell = ring * turns + std::min(static_cast<std::size_t>(in_turns), turns - 1);
        const auto [low, share] = incidence(in);
        return std::lerp(probability(low, cell), probability(low + 1, cell), share) / solid_angle(cell);
    }
    // Whether anything is drawn is up to pdf.
    [[nodiscard]] Vector3 draw(const Direction& in, double choice, double u1, double u2) const noexcept {
        const auto [low, share] = incidence(in);
        const bool upper = choice < share;
        const double u = upper ? choice / share : (choice - share) / (1 - share);
        const auto first = running_.begin() + static_cast<std::ptrdiff_t>((upper ? low + 1 : low) * cells);
        const auto found = std::upper_bound(first, first + cells, u);
        const auto cell = std::min(static_cast<std::size_t>(found - first), cells - 1);
        return turned(std::lerp(edge(cell / turns), edge(cell / turns + 1), u1),
                      (static_cast<double>(cell % turns) + u2) * turn, in)
            .vector();
    }

  private:
    static constexpr std::size_t incidences = 24, rings = 45, turns = 90, cells = rings * turns;
    static constexpr double ring_width = pi / 2 / rings, turn = 2 * pi / turns;

    static double angle_of(std::size_t incidence) {
        return static_cast<double>(incidence) * (89 * pi / 180) / (incidences - 1);
    }
    static double edge(std::size_t ring) noexcept {
        return ring == rings ? 0 : std::cos(static_cast<double>(ring) * ring_width);
    }
    static double solid_angle(std::size_t cell) noexcept {
        return (edge(cell / turns) - edge(cell / turns + 1)) * turn;
    }
    struct Incidence {
        std::size_t low;
        double share;
    };
    static Incidence incidence(const Direction& in) noexcept {
        const double at =
            std::min(std::atan2(in.sin_theta(), in.cos_theta()) / (89 * pi / 180), 1.0) * (incidences - 1);
        const auto low = std::min(static_cast<std::size_t>(at), incidences - 2);
        return {low, at - static_cast<double>(low)};
    }
    [[nodiscard]] double probability(std::size_t incidence, std::size_t cell) const noexcept {
        const std::size_t at = incidence * cells + cell;
        return running_[at] - (cell > 0 ? running_[at - 1] : 0);
    }

    std::vector<double> running_;  // sums of probability
};

// A hts::ReflectanceModel.
class MeasuredModel {
  public:
    ///   dark_outside   reflects nothing where nothing was measured
    MeasuredModel(const OneWavelength& brdf, bool dark_outside)
        : brdf_{brdf}, draws_{std::make_shared<const CellDraws>(brdf)}, dark_outside_{dark_outside} {}

    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        if (!above_horizon(in, out) || (dark_outside_ && !brdf_.knows({in, out}))) return 0;
        return brdf_(in, out);
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept {
        if (!above_horizon(in, out)) return 0;
        return diffuse_share * out.cos_theta() / pi + (1 - diffuse_share) * draws_->pdf(in, out);
    }
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& u) const noexcept {
        if (u[0] < diffuse_share) return weighted(*this, in, cosine_vector(u[1], u[2]));
        return weighted(*this, in,
                        draws_->draw(in, (u[0] - diffuse_share) / (1 - diffuse_share), u[1], u[2]));
    }

  private:
    static constexpr double diffuse_share = 0.1;

    OneWavelength brdf_;
    std::shared_ptr<const CellDraws> draws_;
    bool dark_outside_;
};

// Reads the file's spectrum once for all wavelengths.
class MeasuredEvaluator final : public spectral::Evaluator {
  public:
    MeasuredEvaluator(const std::string& name, const spectral::WavelengthGrid& wavelengths,
                      spectral::Reflectance brdf, std::vector<OneWavelength> each, OutsideRange outside)
        : spectral::Evaluator{name, wavelengths},
          brdf_{std::move(brdf)},
          each_{std::move(each)},
          outside_{outside} {}

    [[nodiscard]] spectral::Properties properties() const override {
        return {.polarised = brdf_.properties().polarised,
                .isotropic = brdf_.properties().isotropic,
                .partial = outside_ == OutsideRange::error};
    }
    [[nodiscard]] bool knows(const DirectionPair& pair) const noexcept override {
        return brdf_.evaluator().knows(pair);
    }
    [[nodiscard]] spectral::MeasuredDomain domain() const override { return brdf_.evaluator().domain(); }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const bool dark =
            !above_horizon(pair.in, pair.out) || (outside_ == OutsideRange::zero && !knows(pair));
        if (dark) return std::fill(values.begin(), values.end(), 0.0);
        OneWavelength::Spectrum spectrum;
        brdf_.evaluator().brdf(pair, std::span{spectrum}.first(brdf_.size()));
        for (std::size_t i = 0; i < each_.size(); ++i) values[i] = each_[i](spectrum);
    }
    [[nodiscard]] spectral::HemisphericalReflectance albedo(const Direction& in,
                                                            std::size_t wavelength) const override {
        if (!(in.cos_theta() > 0)) return {0, 0, 0};
        return {0, albedos_.at(in, [&] { return integrated(in); })[wavelength], 0};
    }
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        if (outside_ == OutsideRange::zero && !knows(pair))
            return std::ranges::fill(values, Mueller{}), void();
        static thread_local std::vector<Mueller> matrices;  // grows once
        matrices.resize(brdf_.size());
        brdf_.evaluator().mueller(pair, matrices);
        for (std::size_t i = 0; i < each_.size(); ++i) values[i] = each_[i](matrices);
    }
    [[nodiscard]] std::shared_ptr<const spectral::DirectionSampler> sampler(
        std::size_t wavelength) const override {
        if (outside_ == OutsideRange::error)
            require_whole(share_of_pairs(brdf_.evaluator()), "pairs of directions", "draws need");
        return spectral::sampler_of(MeasuredModel{each_[wavelength], outside_ == OutsideRange::zero});
    }

  private:
    // Directions that many wavelengths ask for, integrated once.
    class Albedos {
      public:
        template <class Compute>
        std::vector<double> at(const Direction& in, const Compute& compute) const {
            const Vector3 v = in.vector();
            const std::lock_guard lock{mutex_};
            const auto found = made_.find({v.x, v.y, v.z});
            if (found != made_.end()) return found->second;
            if (made_.size() >= 1024) made_.clear();
            return made_.emplace(std::array{v.x, v.y, v.z}, compute()).first->second;
        }

      private:
        mutable std::mutex mutex_;
        mutable std::map<std::array<double, 3>, std::vector<double>> made_;
    };
    [[nodiscard]] std::vector<double> integrated(const Direction& in) const {
        if (outside_ == OutsideRange::error) {
            const double theta = std::atan2(in.sin_theta(), in.cos_theta()) * 180 / pi;
            require_whole(share_of_views(brdf_.evaluator(), in),
                          "the hemisphere of views from theta_i " + spectral::brief(theta, 6) + " deg",
                          "the reflectance in all needs");
        }
        return measured_albedo(*this, in, lobe_slope(brdf_));
    }
    void require_whole(double share, const std::string& of, const std::string& who) const {
        if (share >= whole_share) return;
        throw Error{name() + ": measured in " + spectral::brief(100 * share, 3) + " % of " + of + " (" +
                    domain().axes + "): " + who + " " + spectral::brief(100 * whole_share) +
                    " %; --outside hold or zero answers beyond"};
    }

    spectral::Reflectance brdf_;
    std::vector<OneWavelength> each_;
    OutsideRange outside_;
    Albedos albedos_;
};

spectral::Material read_measured(const spectral::MaterialFile& file) {
    file.json.require_keys_among({"name", "model", "file", "format", "wavelengths_um", "mirror_azimuth_deg"});
    BrdfReading how;
    if (const auto format = file.json.find("format")) how.format = format->text();
    if (const auto list = file.json.find("wavelengths_um")) {
        std::vector<double> micrometres;
        for (const auto& item : list->items()) micrometres.push_back(item.number());
        how.wavelengths = spectral::located(list->place(), [&] {
            return spectral::WavelengthGrid::from_micrometres(std::move(micrometres));
        });
    }
    if (const auto azimuth = file.json.find("mirror_azimuth_deg")) {
        const double degrees = azimuth->number();
        if (degrees != 0 && degrees != 180) throw azimuth->error(shortest(degrees) + ": must be 0 or 180");
        how.mirror_azimuth = degrees;
    }
    const auto key = file.json["file"];
    BrdfFile found = spectral::located(key.place(), [&] { return read_brdf(file.folder / key.text(), how); });
    if (!found.material.empty())
        return spectral::material_from_text(found.material, file.folder / key.text());
    return material_of_file(found.brdf, std::move(found.notes), std::move(found.channels));
}

/// Between two channels of a colour there is nothing; beyond them what `outside` says.
void require_channels(const spectral::Reflectance& brdf, const std::vector<std::string>& channels,
                      const spectral::WavelengthGrid& wavelengths, OutsideRange outside) {
    const auto known = brdf.wavelengths().micrometres();
    for (const double um : wavelengths.micrometres()) {
        if (std::ranges::any_of(known,
                                [&](double channel) { return std::abs(um - channel) <= 1e-9 * channel; }))
            continue;
        if (outside != OutsideRange::error && (um < known.front() || um > known.back())) continue;
        throw Error{"wavelength " + shortest(um) + " um: must be one of " +
                    spectral::brief({known.begin(), known.end()}) + " um, where the channels " +
                    spectral::joined(channels) + " of " + brdf.name() + " stand"};
    }
}

}  // namespace

spectral::Material material_of_file(const spectral::Reflectance& brdf, std::vector<std::string> notes,
                                    std::vector<std::string> channels) {
    if (brdf.wavelengths().size() > most_channels) {
        throw out_of_range("number of wavelengths", static_cast<double>(brdf.wavelengths().size()), "",
                           "at most " + std::to_string(most_channels));
    }
    const auto prepare = [brdf, channels](const std::string& name,
                                          const spectral::WavelengthGrid& wavelengths,
                                          const spectral::EvaluationOptions& options) {
        if (!channels.empty()) require_channels(brdf, channels, wavelengths, options.outside);
        std::vector<OneWavelength> each;
        for (std::size_t i = 0; i < wavelengths.size(); ++i)
            each.emplace_back(brdf, wavelengths[i], options.outside);
        const spectral::Reflectance whole{std::make_shared<const MeasuredEvaluator>(
            name, wavelengths, brdf, std::move(each), options.outside)};
        return options.lobe == DiffuseLobe::none ? spectral::uniform_part_of(whole) : whole;
    };
    return spectral::Material{prepare,
                              {.polarised = brdf.properties().polarised, .channels = std::move(channels)},
                              std::move(notes)};
}

const std::vector<spectral::ModelEntry>& models_with_files() {
    static const std::vector<spectral::ModelEntry> models = [] {
        auto all = spectral::built_in_models();
        all.push_back({"measured", "the file it names", read_measured});
        return all;
    }();
    return models;
}

}  // namespace hts::tables
