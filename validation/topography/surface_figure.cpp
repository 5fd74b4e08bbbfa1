#include <algorithm>
#include <cmath>

#include "spectral/output/script.hpp"
#include "spectral/text/text.hpp"
#include "validation/topography/surface_report.hpp"

namespace hts::validation {
namespace {

using output::Rows;

/// The first map, thinned out to some 128 points a side: x, y [um], height [um].
Rows map_rows(const HeightMap& map) {
    const std::size_t every = (std::max(map.columns(), map.rows()) + 127) / 128;
    Rows rows;
    for (std::size_t j = 0; j < map.rows(); j += every) {
        for (std::size_t i = 0; i < map.columns(); i += every) {
            rows.push_back({static_cast<double>(i) * map.step_x(),
                            static_cast<double>(map.rows() - 1 - j) * map.step_y(), map.at(i, j)});
        }
        rows.emplace_back();
    }
    return rows;
}

/// Density of heights over height [rms], and the Gaussian's.
Rows height_rows(const SurfaceStudy& study) {
    constexpr int bins = 60;
    constexpr double farthest = 5;
    std::vector<double> counts(bins);
    double points = 0;
    for (const StudiedMap& map : study.maps) {
        for (const double z : map.levelled.map.heights()) {
            const double u = z / study.statistics.rms;
            if (std::isnan(u)) continue;
            ++points;
            const auto bin = static_cast<int>(std::floor((u + farthest) / (2 * farthest) * bins));
            if (bin >= 0 && bin < bins) ++counts[static_cast<std::size_t>(bin)];
        }
    }
    Rows rows;
    for (int k = 0; k < bins; ++k) {
        const double u = -farthest + 2 * farthest * (k + 0.5) / bins;
        const double density = counts[static_cast<std::size_t>(k)] / points * bins / (2 * farthest);
        rows.push_back(
            {u, density > 0 ? density : std::nan(""), std::exp(-u * u / 2) / std::sqrt(2 * std::acos(-1.0))});
    }
    return rows;
}

std::vector<std::string> with_fits(const SurfaceStudy& study, std::vector<std::string> columns,
                                   const std::string& unit) {
    for (const SpectrumFit& fit : study.fits) columns.push_back(std::string{fit.model} + unit);
    return columns;
}

}  // namespace

output::FigureTable radial_table(const SurfaceStudy& study) {
    output::FigureTable table{
        "radial-spectrum", with_fits(study, {"frequency_per_um", "cells", "measured_um4"}, "_um4"), {}};
    for (const RadialBin& ring : study.radial) {
        std::vector<double> row{ring.frequency, ring.cells, ring.power};
        for (const SpectrumFit& fit : study.fits) row.push_back(fit.power(ring.frequency));
        table.rows.push_back(std::move(row));
    }
    return table;
}

output::FigureTable profile_table(const SurfaceStudy& study, bool along_x) {
    output::FigureTable table{
        along_x ? "profile-spectrum-x" : "profile-spectrum-y", {"frequency_per_um", "one_sided_um3"}, {}};
    const ProfileSpectrum profile = profile_spectrum(study.maps.front().spectrum, along_x);
    for (std::size_t i = 0; i < profile.frequency.size(); ++i)
        table.rows.push_back({profile.frequency[i], profile.power[i]});
    return table;
}

output::FigureTable autocorrelation_table(const SurfaceStudy& study) {
    output::FigureTable table{"autocorrelation", with_fits(study, {"distance_um", "measured"}, ""), {}};
    for (std::size_t i = 0; i < study.autocorrelation.distance.size(); ++i) {
        const double r = study.autocorrelation.distance[i];
        std::vector<double> row{r, study.autocorrelation.value[i]};
        for (const SpectrumFit& fit : study.fits) row.push_back(correlation(fit.scales, r));
        table.rows.push_back(std::move(row));
    }
    return table;
}

output::Figure surface_figure(const SurfaceStudy& study) {
    output::Figure figure{"surface",
                          {radial_table(study), profile_table(study, true), profile_table(study, false),
                           autocorrelation_table(study)},
                          {}};
    std::vector<std::string> titles;
    for (const SpectrumFit& fit : study.fits) titles.emplace_back(fit.title);
    const HeightMap& map = study.maps.front().levelled.map;
    output::Script script;
    script.set("name",
               map.name() +
                   (study.maps.size() > 1 ? " and " + std::to_string(study.maps.size() - 1) + " more" : ""));
    script.set("rms", study.statistics.rms).set("lowest", study.known.first).set("highest", study.known.last);
    script.set("width", map.width()).set("height_um", map.height());
    script.set("length", study.autocorrelation.length())
        .set("farthest", study.autocorrelation.distance.back());
    script.set("fit", titles).data("map", map_rows(map)).data("heights", height_rows(study));
    figure.script = script.with("surface");
    figure.caption =
        "Heights, their distribution, spectrum and autocorrelation, with the descriptions fitted.";
    return figure;
}

}  // namespace hts::validation
