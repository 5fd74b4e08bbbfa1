#include "validation/topography/surface_study.hpp"

#include <algorithm>
#include <cmath>

#include "spectral/parallel.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

/// Mean of the maps, by the distances of the first, as far as all of them reach.
Autocorrelation mean_autocorrelation(const std::vector<StudiedMap>& maps) {
    Autocorrelation result = maps.front().autocorrelation;
    double farthest = HUGE_VAL;
    for (const StudiedMap& map : maps) farthest = std::min(farthest, map.autocorrelation.distance.back());
    while (result.distance.back() > farthest) result.distance.pop_back();
    result.value.assign(result.distance.size(), 0);
    for (std::size_t i = 0; i < result.distance.size(); ++i) {
        double points = 0;
        for (const StudiedMap& map : maps) {
            const auto& [r, c, cubes, fourths] = map.autocorrelation;
            const auto above =
                std::clamp<std::ptrdiff_t>(std::ranges::lower_bound(r, result.distance[i]) - r.begin(), 1,
                                           static_cast<std::ptrdiff_t>(r.size()) - 1);
            const auto k = static_cast<std::size_t>(above);
            const double share = (result.distance[i] - r[k - 1]) / (r[k] - r[k - 1]);
            const auto weight = static_cast<double>(map.statistics.points);
            result.value[i] += weight * (c[k - 1] + share * (c[k] - c[k - 1]));
            points += weight;
        }
        result.value[i] /= points;
    }
    return result;
}

}  // namespace

double SurfaceStudy::rms_of_spectra() const {
    double sum = 0, points = 0;
    for (const StudiedMap& map : maps) {
        const auto count = static_cast<double>(map.statistics.points);
        sum += count * map.spectrum.variance();
        points += count;
    }
    return std::sqrt(sum / points);
}

SurfaceStudy studied(std::vector<HeightMap> maps, const SurfaceRequest& request) {
    if (maps.empty()) throw Error{"no height map: must be one at least"};
    std::vector<std::optional<StudiedMap>> each(maps.size());
    std::vector<std::optional<MapWindow>> windows(maps.size());
    spectral::parallel_for(maps.size(), [&](std::size_t i) {
        each[i] = [&]() -> StudiedMap {
            try {
                LevelledMap level = levelled(maps[i], request.levelling);
                const MapWindow& window = windows[i].emplace(level.map, request.window);
                MapSpectrum spectrum = spectrum_of(level.map, window);
                Autocorrelation autocorrelation = autocorrelation_of(level.map);
                const HeightStatistics statistics = statistics_of(level.map, autocorrelation);
                return {std::move(level),           window.inflation, std::move(spectrum),
                        std::move(autocorrelation), statistics,       {}};
            } catch (const Error& error) {
                throw Error{maps[i].name() + ": " + error.what()};
            }
        }();
    });
    SurfaceStudy study{request, {}, {}, {}, {}, {}, {}, {}, {}};
    std::vector<HeightStatistics> statistics;
    std::vector<MapSpectrum> spectra;
    for (auto& map : each) {
        study.maps.push_back(std::move(*map));
        statistics.push_back(study.maps.back().statistics);
        spectra.push_back(study.maps.back().spectrum);
    }
    study.statistics = pooled(statistics);
    study.autocorrelation = mean_autocorrelation(study.maps);
    const HeightMap& first = study.maps.front().levelled.map;
    const auto about_maps = [&](const auto& action) { return spectral::located(first.name(), action); };
    study.anisotropy = about_maps([&] { return anisotropy_of(spectra, study.maps.front().inflation); });
    if (study.anisotropy.significant) study.ellipse = study.anisotropy.ellipse;
    std::vector<std::vector<RadialBin>> radial;
    std::vector<SeenSpectrum> seen;
    for (std::size_t i = 0; i < windows.size(); ++i) {
        StudiedMap& map = study.maps[i];
        seen.emplace_back(map.levelled.map, *windows[i], map.spectrum,
                          coefficient_count(request.levelling.level), study.ellipse, request.band);
        windows[i].reset();  // as large as the map
        map.known = seen.back().known();
        radial.push_back(radial_spectrum(map.spectrum, study.ellipse));
    }
    study.radial = merged(radial);
    study.known = study.maps.front().known;
    for (const StudiedMap& map : study.maps) {
        study.known.first = std::min(study.known.first, map.known.first);
        study.known.last = std::max(study.known.last, map.known.last);
    }
    if (request.band) {
        study.known.first = std::max(study.known.first, request.band->first);
        study.known.last = std::min(study.known.last, request.band->last);
    }
    const double length = study.autocorrelation.length();
    study.fits = about_maps([&] { return fits_of_spectra(seen, length > 0 ? length : first.width() / 10); });
    return study;
}

}  // namespace hts::validation
