#include "tables/table/between_wavelengths.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "hts/error.hpp"

namespace hts::tables {
namespace {

class BetweenWavelengths final : public spectral::Evaluator {
  public:
    BetweenWavelengths(const spectral::Reflectance& table, const spectral::WavelengthGrid& wavelengths)
        : spectral::Evaluator{table.name(), wavelengths}, table_{table} {
        for (const double um : wavelengths.micrometres())
            places_.push_back(place_among(table.wavelengths(), um));
    }
    [[nodiscard]] spectral::Properties properties() const override {
        return {.specular_term = table_.properties().specular_term,
                .isotropic = table_.properties().isotropic};
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        place(values, [&](std::span<double> own) { table_.evaluator().brdf(pair, own); });
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        place(values, [&](std::span<double> own) { table_.evaluator().uniform_diffuse(own); });
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        place(values, [&](std::span<double> own) { table_.evaluator().directional_diffuse(pair, own); });
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        place(values, [&](std::span<double> own) { table_.evaluator().specular_reflectance(in, own); });
    }

  private:
    template <class Read>
    void place(std::span<double> values, const Read& read) const noexcept {
        thread_local std::vector<double> own;
        own.resize(table_.size());
        read(own);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = places_[i](own);
    }

    spectral::Reflectance table_;
    std::vector<WavelengthPlace> places_;
};

}  // namespace

double WavelengthPlace::operator()(std::span<const double> values) const noexcept {
    const double a = values[low], b = values[high];
    if (low == high) return a;
    return a > 0 && b > 0 ? std::exp(std::lerp(std::log(a), std::log(b), share)) : std::lerp(a, b, share);
}

WavelengthPlace place_among(const spectral::WavelengthGrid& grid, double um) {
    constexpr double rounding = 1e-9;  // relative
    const auto all = grid.micrometres();
    const auto near =
        std::ranges::find_if(all, [&](double own) { return std::abs(own - um) <= rounding * own; });
    if (near != all.end()) {
        const auto place = static_cast<std::size_t>(near - all.begin());
        return {place, place, 0};
    }
    const auto above = std::ranges::upper_bound(all, um);
    if (above == all.begin() || above == all.end()) {
        throw out_of_range("wavelength", um, "um",
                           all.size() == 1 ? "that of the table, " + shortest(all.front()) + " um"
                                           : "within those of the table, from " + shortest(all.front()) +
                                                 " to " + shortest(all.back()) + " um");
    }
    const auto high = static_cast<std::size_t>(above - all.begin());
    return {high - 1, high, std::log(um / all[high - 1]) / std::log(all[high] / all[high - 1])};
}

std::optional<spectral::WavelengthGrid> half_way(const spectral::WavelengthGrid& grid) {
    const auto all = grid.micrometres();
    std::vector<double> middles;
    for (std::size_t i = 1; i < all.size(); ++i) middles.push_back(std::sqrt(all[i - 1] * all[i]));
    if (middles.empty()) return std::nullopt;
    return spectral::WavelengthGrid::from_micrometres(std::move(middles));
}

spectral::Reflectance at_wavelengths(const spectral::Reflectance& table,
                                     const spectral::WavelengthGrid& wavelengths) {
    return spectral::Reflectance{std::make_shared<const BetweenWavelengths>(table, wavelengths)};
}

}  // namespace hts::tables
